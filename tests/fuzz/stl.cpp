// SPDX-License-Identifier: MIT
// Meshes as STL.
#include "framework/importers/mesh_file.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    return fuzz::tryToRead(
        [&] { static_cast<void>(scene::readMeshFile(fuzz::inputFile("input.stl", bytes, size))); });
}
