// SPDX-License-Identifier: MIT
// What all targets share. A target hands the fuzzer's bytes to one reader; the project's own errors
// are what it may throw, and all else is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "framework/core/error.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::fuzz {

inline std::string_view text(const std::uint8_t* bytes, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes), size};
}

// A file that holds the bytes, under a name that is the same for every input.
inline std::filesystem::path inputFile(const char* name, const std::uint8_t* bytes,
                                       std::size_t size) {
    static const test::TemporaryFolder folder;
    return folder.file(name, text(bytes, size));
}

template <class Read>
int tryToRead(const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        if (std::string_view(error.what()).empty()) std::abort();  // an error says what is wrong
    }
    return 0;
}

}  // namespace kaustik::fuzz

// libFuzzer calls it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
