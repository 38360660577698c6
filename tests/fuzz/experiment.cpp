// SPDX-License-Identifier: MIT
// Experiments, and the runs that they ask for.
#include "framework/experiment/plan.h"
#include "tests/fuzz/params.h"
#include "tests/fuzz/target.h"

namespace {

kaustik::params::ParamSet makeParams(const std::string& technique, bool /*isAsPublished*/) {
    if (technique != "wyman2008") throw kaustik::ConfigError("There is no such technique.");
    kaustik::params::ParamSet set;
    set.declareChoice("trace", "Where do photons land?", {"lines", "march"}, "lines");
    for (const char* scope : {"trace", "emit.grid"})
        set.declare<kaustik::fuzz::Params>(scope);
    return set;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    const experiment::RunDefaults defaults{"smallest", "wyman2008", "64x48", 8, 1, 1, "none", 1000};
    return fuzz::tryToRead([&] {
        const auto spec = experiment::readSpec(fuzz::inputFile("input.toml", bytes, size));
        static_cast<void>(experiment::makePlan(spec, defaults, makeParams));
    });
}
