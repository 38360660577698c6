// SPDX-License-Identifier: MIT
// kaustik reference: computes the ray-traced reference of a scene, or goes on with it; computes one
// shard of it; merges the shards.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/shard.h"
#include "framework/run/output.h"

#ifdef KAUSTIK_HAS_EMBREE
#include "framework/reference/order.h"
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

Order orderOf(const ReferenceOptions& options) {
    const params::Extent size = params::parsePictureSize(options.size, "--size");
    return {.estimator = options.estimator,
            .width = size.width,
            .height = size.height,
            .photons = options.photons,
            .seconds = options.seconds,
            .relativeError = options.standardError,
            .seed = options.seed,
            .threads = options.threads,
            .transmissionOnly = options.transmissionOnly,
            .interactions = options.interactions,
            .causticView = options.causticView,
            .classes = {options.named, options.classes, options.byObject}};
}

std::string asOption(const std::string& name) {
    return "--" + name;
}

// What each class has of the picture's light.
void printClasses(const Reference& result) {
    if (result.classes.empty()) return;
    const auto sum = [](const Image& image) {
        double total = 0.0;
        for (const float value : image.values)
            total += static_cast<double>(value);
        return total;
    };
    const double all = sum(result.irradiance);
    fmt::print("share of the picture's irradiance by class:\n");
    for (const ClassImages& one : result.classes) {
        fmt::print("  {:<16} {:7.3f} %\n", one.name,
                   all > 0.0 ? 100.0 * sum(one.irradiance) / all : 0.0);
    }
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
    printClasses(result);
    if (result.rejectedValues > 0)
        fmt::print("warning: {} values were no numbers and were left out\n", result.rejectedValues);
    fmt::print("wrote {}\n", file.string());
}

// The file that is written, whose folder can be; throws ConfigError where it ends otherwise.
fs::path outputFile(const std::string& out, const std::string& fallback,
                    const std::vector<std::string>& endings) {
    const fs::path file = out.empty() ? fs::path("results/references") / fallback : fs::path(out);
    if (std::find(endings.begin(), endings.end(), file.extension()) == endings.end()) {
        throw ConfigError(
            fmt::format("--out: {} must end in {}.", file.string(), fmt::join(endings, " or ")));
    }
    run::requireWritable(file.parent_path().empty() ? fs::path(".") : file.parent_path(), "--out");
    return file;
}

const std::vector<std::string> kImageEndings = {".exr", ".pfm"};

std::string nameOf(const std::string& scene, const ReferenceRequest& request) {
    return fmt::format("{}-{}-{}x{}", scene,
                       request.estimator == Estimator::light ? "light" : "sppm", request.width,
                       request.height);
}

void merge(const ReferenceOptions& options) {
    const std::vector<fs::path> files(options.merged.begin(), options.merged.end());
    const Subject subject = readPartHead(files.front()).subject;
    const fs::path file = outputFile(
        options.out, nameOf(subject.scene, subject.request) + floatImageExtension(), kImageEndings);
    const Reference result = run::mergeShards(files, options.incomplete);
    writeReference(file, result);
    print(result, file);
}

void print(const ShardResult& result, const fs::path& file) {
    const PartHead& head = result.head;
    const BatchRange own = head.own();
    fmt::print("{}, {}x{}, shard {}/{}: {} of the reference's {} batches, {:.1f} s\n",
               head.subject.scene, head.subject.request.width, head.subject.request.height,
               head.shard.number, head.shard.count, own.end - own.first, head.batchesOfAll,
               head.seconds);
    fmt::print("{} {}\n", result.wasComplete ? "it was there already:" : "wrote", file.string());
}

}  // namespace

void referenceCommand(const ReferenceOptions& options) {
    if (!options.merged.empty()) return merge(options);
    if (options.scene.empty()) {
        throw ConfigError("reference: name a scene, or the parts of a reference with --merge.");
    }
    const Order order = orderOf(options);
    ReferenceRequest request = requestOf(order, asOption);
    reference::RunOptions run = optionsOf(order, asOption);
    std::optional<Shard> shard;
    if (!options.shard.empty()) {
        shard = parseShard(options.shard, "--shard");
        if (!options.photons || options.seconds || options.standardError) {
            throw ConfigError(
                "--shard: give --photons of the whole reference; a shard knows neither --error nor "
                "--seconds of the others.");
        }
    }
    if (!order.classes.isEmpty() && !hasImageModule()) {
        throw ConfigError(
            "--classes: are layers of an .exr, and this build has no module that writes one.");
    }
    const scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const std::string name = nameOf(scene.name, request);
    const fs::path file =
        shard ? outputFile(options.out,
                           fmt::format("{}-{}-of-{}.shard", name, shard->number, shard->count),
                           {".shard"})
              : outputFile(options.out, name + floatImageExtension(), kImageEndings);
    const EmbreeScene embree(scene);
    addClasses(
        embree, order, asOption, [](const std::string& text) { fmt::print(stderr, "{}\n", text); },
        request);
    if (shard) {
        run.stop = {};
        print(run::obtainShard(embree, request,
                               {*shard, static_cast<std::uint64_t>(*options.photons), file}, run),
              file);
        return;
    }
    const Reference result = run::obtainReference(embree, request, run);
    writeReference(file, result);
    print(result, file);
}

#endif

}  // namespace kaustik::app
