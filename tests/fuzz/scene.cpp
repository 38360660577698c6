// SPDX-License-Identifier: MIT
// Scene files, with the shapes that they make and the meshes and scenes that they name. One reader
// process for all of them, in place of one each as scene::loadSceneFile has it.
#include "framework/scene/files/scene_file_parts.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static reading::ReaderProcess reader;
    return fuzz::tryToRead([&] {
        const auto file = fuzz::inputFile("input.toml", bytes, size);
        static_cast<void>(scene::makeScene(scene::readToml(file, reader), file, reader));
    });
}
