// SPDX-License-Identifier: MIT
// What the workbench keeps over a restart. A problem is a sentence next to the settings, no error.
#include "framework/gui/settings_file.h"
#include "tests/fuzz/params.h"
#include "tests/fuzz/target.h"

namespace {

kaustik::Registry makeRegistry() {
    kaustik::Registry registry;
    registry.sharedParams<kaustik::TraceStage, kaustik::fuzz::Params>();
    for (const char* name : {"screen_space_photons", "wyman2008"})
        registry.technique({name, "", "", {}, {}});
    return registry;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static const Registry registry = makeRegistry();
    const auto file = fuzz::inputFile("workbench.json", bytes, size);
    static_cast<void>(gui::readSettings(file.parent_path(), registry));
    return 0;
}
