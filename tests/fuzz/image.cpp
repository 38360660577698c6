// SPDX-License-Identifier: MIT
// Images of all kinds, by their first bytes.
#include "framework/image/image.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    return fuzz::tryToRead(
        [&] { static_cast<void>(decodeImage(fuzz::text(bytes, size), "input")); });
}
