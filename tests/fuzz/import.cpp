// SPDX-License-Identifier: MIT
// Scenes of other renderers: Tungsten's, which begin with a brace, and Mitsuba's. All is read in
// this process, where the fuzzer sees it, but for meshes that they name; what is written goes to
// the input's folder.
#include "framework/importers/foreign_file.h"
#include "framework/scene/foreign/foreign_export.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static reading::ReaderProcess reader;
    return fuzz::tryToRead([&] {
        const bool isJson = fuzz::text(bytes, size).starts_with('{');
        const auto file = fuzz::inputFile(isJson ? "input.json" : "input.xml", bytes, size);
        const scene::ForeignScene foreign = scene::readForeignFile(file);
        const auto out = file.parent_path() / "output.toml";
        static_cast<void>(scene::exportForeignScene(foreign, {out, file, true}, reader));
    });
}
