// SPDX-License-Identifier: MIT
// Parts of references. The head ends in a checksum, which no mutation would hit: the fuzzer's first
// line is what comes before it, and the sums are what follows.
#include "framework/reference/part_file.h"

#include "framework/core/content_hash.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    const std::string_view input = fuzz::text(bytes, size);
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string head(input.substr(0, end));
    const std::string content = "kaustik.part/1\n" + head + "\n" +
                                ContentHash().addBytes(head).hex() + "\n" +
                                std::string(input.substr(std::min(end + 1, input.size())));
    return fuzz::tryToRead([&] {
        const auto file = fuzz::inputFile(
            "input.part", reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
        const reference::PartHead read = reference::readPartHead(file);
        static_cast<void>(reference::readPartSums(file, read));
    });
}
