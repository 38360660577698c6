// SPDX-License-Identifier: MIT
// The layered file of a reference's classes.
#include "framework/reference/class_file.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    return fuzz::tryToRead([&] {
        static_cast<void>(
            reference::readClasses(fuzz::inputFile("input.classes.exr", bytes, size)));
    });
}
