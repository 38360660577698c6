// SPDX-License-Identifier: MIT
// References by key in a folder: KEY.exr and its sidecar, and KEY.sums to go on from.
#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/reference/reference.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

// What is reached first ends a run; so one that is reached is enough.
bool isSufficient(const Reference& reference, const StopCondition& stop) {
    if (reference.photons == 0) return true;  // nothing is sent out: it is exact
    if (stop.batches && reference.batches >= *stop.batches) return true;
    if (stop.photons && reference.photons >= *stop.photons) return true;
    if (stop.relativeError && reference.relativeError <= *stop.relativeError) return true;
    return stop.seconds && reference.seconds >= *stop.seconds;
}

}  // namespace

std::optional<Reference> findCached(const scene::Scene& scene, const ReferenceRequest& request,
                                    const fs::path& cacheFolder) {
    const std::string key = referenceKey(scene, request);
    std::error_code error;
    if (!fs::exists(cacheFolder / (key + ".json"), error)) return {};
    try {
        return readReference(cacheFolder / (key + floatImageExtension()), key);
    } catch (const Error&) {
        return {};
    }
}

Reference loadOrCompute(const EmbreeScene& scene, const ReferenceRequest& request,
                        const fs::path& cacheFolder, const RunOptions& options,
                        const std::function<void(const std::string&)>& report) {
    const std::string key = referenceKey(scene.scene(), request);
    const fs::path path = cacheFolder / (key + floatImageExtension());
    const fs::path sumsPath = cacheFolder / (key + ".sums");
    double secondsBefore = 0.0;
    std::error_code error;
    if (fs::exists(cacheFolder / (key + ".json"), error)) {
        try {
            Reference cached = readReference(path, key);
            if (isSufficient(cached, options.stop)) return cached;
            secondsBefore = cached.seconds;
        } catch (const Error& damage) {
            report(
                fmt::format("A cached reference is damaged and is made again: {}", damage.what()));
        }
    }
    PixelSums sums = makeSums(scene, request);
    if (fs::exists(sumsPath, error)) {
        try {
            sums = PixelSums::fromBytes(readFile(sumsPath), key, sumsPath.string());
        } catch (const Error& damage) {
            report(fmt::format("A cached reference is begun again: {}", damage.what()));
            secondsBefore = 0.0;
        }
    }
    RunOptions saving = options;
    saving.save = [&](const PixelSums& state) {
        writeFileWhole(sumsPath, state.toBytes(key));
        if (options.save) options.save(state);
    };
    const auto start = std::chrono::steady_clock::now();
    addBatches(scene, request, saving, sums);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Reference reference = makeReference(scene.scene(), request, sums, secondsBefore + seconds);
    writeReference(path, reference);
    return reference;
}

}  // namespace kaustik::reference
