// SPDX-License-Identifier: MIT
// References: the sidecar is the fuzzer's, next to images that are whole.
#include "framework/reference/reference.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static const auto image = [] {
        static const test::TemporaryFolder folder;
        reference::writeReference(folder / "input.pfm", fuzz::smallReference());
        return folder / "input.pfm";
    }();
    return fuzz::tryToRead([&] {
        std::ofstream(std::filesystem::path(image).replace_extension(".json"), std::ios::binary)
            << fuzz::text(bytes, size);
        static_cast<void>(reference::readReference(image));
    });
}
