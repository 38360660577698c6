// SPDX-License-Identifier: MIT
// Scene files, with the shapes that they make and the meshes and scenes that they name.
#include "framework/scene/files/scene_file.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    return fuzz::tryToRead([&] {
        static_cast<void>(scene::loadSceneFile(fuzz::inputFile("input.toml", bytes, size)));
    });
}
