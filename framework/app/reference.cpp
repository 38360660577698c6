// SPDX-License-Identifier: MIT
// kaustik reference: computes the ray-traced reference of a scene, or goes on with it.
#include <fmt/format.h>

#include <cmath>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/run/output.h"

#ifdef KAUSTIK_HAS_EMBREE
#include "framework/run/reference_work.h"
#endif

namespace kaustik::app {

#ifndef KAUSTIK_HAS_EMBREE

void referenceCommand(const ReferenceOptions&) {
    throw ConfigError("This program was built without Embree and cannot compute references.");
}

#else

namespace {

namespace fs = std::filesystem;
using namespace reference;

Estimator estimatorNamed(const std::string& name) {
    if (name == "light") return Estimator::light;
    if (name == "sppm") return Estimator::sppm;
    throw ConfigError(fmt::format("--estimator: '{}' is neither light nor sppm.", name));
}

StopWhen stopOf(const ReferenceOptions& options) {
    const auto check = [](const char* name, double value) {
        if (!(value > 0.0)) throw ConfigError(fmt::format("{}: must be above 0.", name));
    };
    StopWhen stop;
    if (options.photons) {
        check("--photons", static_cast<double>(*options.photons));
        stop.photons = static_cast<std::uint64_t>(*options.photons);
    }
    if (options.seconds) {
        check("--seconds", *options.seconds);
        stop.seconds = options.seconds;
    }
    if (options.standardError) {
        check("--error", *options.standardError);
        stop.relativeError = options.standardError;
    }
    if (!stop.photons && !stop.seconds && !stop.relativeError)
        stop.photons = static_cast<std::uint64_t>(app::RunOptions().referencePhotons);
    return stop;
}

ReferenceRequest requestOf(const ReferenceOptions& options) {
    ReferenceRequest request;
    request.estimator = estimatorNamed(options.estimator);
    const params::Extent size = parseSize(options.size);
    request.width = size.width;
    request.height = size.height;
    if (options.seed < 0) throw ConfigError("--seed: must not be negative.");
    request.seed = static_cast<std::uint64_t>(options.seed);
    request.filter.transmissionOnly = options.transmissionOnly;
    if (options.interactions < 1 || options.interactions > 1000) {
        throw ConfigError(
            fmt::format("--interactions: {} is not from 1 to 1000.", options.interactions));
    }
    request.filter.maximumInteractions = options.interactions;
    request.causticView = options.causticView;
    if (request.causticView && request.estimator != Estimator::sppm)
        throw ConfigError("--caustic-view: only --estimator sppm sees through specular surfaces.");
    return request;
}

void print(const Reference& result, const fs::path& file) {
    const auto& watts = result.energy.watts;
    fmt::print("{}, {}x{}, {} photons in {} batches, {:.1f} s\n", result.scene,
               result.request.width, result.request.height, result.photons, result.batches,
               result.seconds);
    if (std::isfinite(result.relativeError)) {
        fmt::print("standard error {:.3f} % of the mean of a lit pixel\n",
                   100.0 * result.relativeError);
    } else {
        fmt::print("no pixel is lit, so there is no standard error to give\n");
    }
    fmt::print("emitted {:.5g} W, deposited {:.5g} W ({:.5g} W in the picture), balance {:.1e}\n",
               watts[transport::kAccountEmitted], watts[transport::kAccountDeposited],
               result.energy.visibleWatts, result.energy.balance());
    if (result.rejectedValues > 0)
        fmt::print("warning: {} values were no numbers and were left out\n", result.rejectedValues);
    fmt::print("wrote {}\n", file.string());
}

}  // namespace

void referenceCommand(const ReferenceOptions& options) {
    const ReferenceRequest request = requestOf(options);
    reference::RunOptions run;
    run.stop = stopOf(options);
    if (options.threads < 0 || options.threads > 1024)
        throw ConfigError(fmt::format("--threads: {} is not from 0 to 1024.", options.threads));
    run.threads = options.threads;
    const scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const fs::path file =
        options.out.empty() ? fs::path("results/references") /
                                  fmt::format("{}-{}-{}x{}{}", scene.name, options.estimator,
                                              request.width, request.height, floatImageExtension())
                            : fs::path(options.out);
    const std::string extension = file.extension().string();
    if (extension != ".exr" && extension != ".pfm")
        throw ConfigError(fmt::format("--out: {} must end in .exr or .pfm.", file.string()));
    run::requireWritable(file.parent_path().empty() ? fs::path(".") : file.parent_path(), "--out");
    const EmbreeScene embree(scene);
    const Reference result = run::obtainReference(embree, request, run);
    writeReference(file, result);
    print(result, file);
}

#endif

}  // namespace kaustik::app
