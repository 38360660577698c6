// SPDX-License-Identifier: MIT
// PFM and PPM, which the project reads itself.
#include "framework/image/pfm.h"

#include "framework/image/image.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    const std::string_view text = fuzz::text(bytes, size);
    return fuzz::tryToRead([&] {
        static_cast<void>(text.starts_with("P6") ? decodePpm(text, "input")
                                                 : decodePfm(text, "input"));
    });
}
