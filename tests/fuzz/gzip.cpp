// SPDX-License-Identifier: MIT
// Meshes that are compressed, by the reader process.
#include "framework/scene/files/mesh_import.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static reading::ReaderProcess reader;
    return fuzz::tryToRead([&] {
        static_cast<void>(
            scene::importMeshWithWarnings(fuzz::inputFile("input.ply.gz", bytes, size), reader));
    });
}
