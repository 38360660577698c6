// SPDX-License-Identifier: MIT
#include "framework/run/reference_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/core/error.h"
#include "framework/run/progress.h"

namespace kaustik::run {
namespace {

namespace fs = std::filesystem;
using namespace reference;

// How much of the work is done: the furthest of what may stop it. The error falls with the root of
// the work.
double shareOf(const reference::Progress& progress, const StopCondition& stop) {
    double share = 0.0;
    const auto count = [&](double done, double wanted) {
        if (wanted > 0.0) share = std::max(share, done / wanted);
    };
    if (stop.batches) {
        count(static_cast<double>(progress.batches), static_cast<double>(*stop.batches));
    }
    if (stop.photons) {
        count(static_cast<double>(progress.photons), static_cast<double>(*stop.photons));
    }
    if (stop.seconds) count(progress.seconds, *stop.seconds);
    if (stop.relativeError && std::isfinite(progress.relativeError)) {
        share = std::max(share, std::pow(*stop.relativeError / progress.relativeError, 2.0));
    }
    return std::min(share, 1.0);
}

std::string progressText(const reference::Progress& progress) {
    std::string text =
        fmt::format("{:.1f} million photons", static_cast<double>(progress.photons) * 1e-6);
    if (std::isfinite(progress.relativeError)) {
        text += fmt::format(", standard error {:.2f} %", 100.0 * progress.relativeError);
    }
    return text;
}

void reportDamage(const std::string& damage) {
    fmt::print(stderr, "{}\n", damage);
}

[[noreturn]] void failInterrupted(std::uint64_t photons) {
    throw Error(
        fmt::format("Interrupted after {} photons; the same command goes on from there.", photons),
        kExitFailed);
}

}  // namespace

reference::PathFilter modelledFilter(reference::PathFilter all, const ModelledPaths& paths) {
    all.transmissionOnly = paths.transmissionOnly;
    all.reflectionOnly = paths.reflectionOnly;
    all.maximumInteractions = paths.interactions;
    return all;
}

Reference obtainReference(const EmbreeScene& scene, const ReferenceRequest& request,
                          RunOptions options) {
    catchInterrupts();
    Progress progress(request.filter.transmissionOnly || request.filter.reflectionOnly
                          ? "reference of the modelled paths:"
                          : "reference:");
    return obtainReference(
        scene, request, std::move(options),
        {[] { return !isInterrupted(); },
         [&](double share, const std::string& reached) { progress.updateShare(share, reached); }});
}

Reference obtainReference(const EmbreeScene& scene, const ReferenceRequest& request,
                          RunOptions options, const Watch& watch) {
    std::uint64_t photons = 0;
    options.progress = [&](const reference::Progress& now) {
        photons = now.photons;
        watch.tell(shareOf(now, options.stop), progressText(now));
        return watch.shouldContinue();
    };
    options.pulse = [&](std::uint64_t) { return watch.shouldContinue(); };
    const auto failIfInterrupted = [&] {
        if (!watch.shouldContinue()) failInterrupted(photons);
    };
    try {
        const Reference reference =
            loadOrCompute(scene, request, cacheFolder() / "references", options, reportDamage);
        failIfInterrupted();
        return reference;
    } catch (const ConfigError&) {
        failIfInterrupted();  // below two batches there is no reference to give
        throw;
    }
}

ViewReference obtainView(const EmbreeScene& scene, const ViewReferenceRequest& request) {
    return loadOrTraceView(scene, request, cacheFolder() / "references", reportDamage);
}

ShardResult obtainShard(const EmbreeScene& scene, const ReferenceRequest& request,
                        const ShardRequest& requested, RunOptions options) {
    catchInterrupts();
    Progress progress(fmt::format("shard {}/{}:", requested.shard.number, requested.shard.count));
    const auto [first, end] =
        rangeOf(requested.shard, batchesFor(scene, request, requested.photons));
    const double wanted = static_cast<double>(end - first);
    std::uint64_t photons = 0;
    options.progress = [&](const reference::Progress& now) {
        photons = now.photons;
        progress.updateShare(static_cast<double>(now.batches) / wanted, progressText(now));
        return !isInterrupted();
    };
    options.pulse = [](std::uint64_t) { return !isInterrupted(); };
    ShardResult result = computeShard(scene, request, requested, options, reportDamage);
    if (!result.head.isWhole()) failInterrupted(photons);
    return result;
}

Reference mergeShards(const std::vector<fs::path>& files, bool incomplete) {
    Progress progress("part", static_cast<int>(files.size()));
    return mergeParts(files,
                      {incomplete, [&](int done, int) { progress.update(done); }, reportDamage});
}

}  // namespace kaustik::run
