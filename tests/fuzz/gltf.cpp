// SPDX-License-Identifier: MIT
// Scenes as glTF and GLB.
#include "framework/importers/gltf_file.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    return fuzz::tryToRead([&] {
        static_cast<void>(scene::readGltfFile(fuzz::inputFile("input.gltf", bytes, size)));
    });
}
