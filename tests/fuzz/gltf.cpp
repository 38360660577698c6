// SPDX-License-Identifier: MIT
// Scenes as glTF and GLB, by the reader process.
#include "framework/scene/files/gltf_import.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static reading::ReaderProcess reader;
    return fuzz::tryToRead([&] {
        static_cast<void>(scene::importGltf(fuzz::inputFile("input.gltf", bytes, size), reader));
    });
}
