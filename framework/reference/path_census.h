// SPDX-License-Identifier: MIT
// The watts of every path of caustic light, by its interactions and its first specular object,
// whether seen or not: light tracing (light_tracing.h) without pixels. The result depends on the
// seed and the number of photons alone, not on the threads.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "framework/reference/embree_scene.h"
#include "framework/reference/path_classes.h"
#include "framework/reference/reference.h"

namespace kaustik::reference {

// What a path, or a class of them, brings to the receivers of the whole scene, and to the part of
// it that the picture shows: mean over the batches and its standard error, W, means of channels.
struct PathFlux {
    double watts = 0.0;
    double wattsError = 0.0;
    double visibleWatts = 0.0;
    double visibleError = 0.0;
};

struct CountedPath {
    ArrivedPath path;
    PathFlux flux;
};

struct PathCensus {
    std::vector<CountedPath> paths;  // the brightest first
    PathFlux all;                    // of all paths together
    Energy energy;                   // of the mean batch
    std::uint64_t photons = 0;
    double seconds = 0.0;

    // The flux of those paths that `belongs` says yes to, together: their error is that of the sum,
    // not a sum of errors.
    [[nodiscard]] PathFlux fluxOf(const std::function<bool(const ArrivedPath&)>& belongs) const;

    // What each batch has found, W: of all and of what the picture shows, by the place in `paths`.
    std::vector<std::vector<std::pair<double, double>>> byBatch;
};

inline constexpr int kCensusBatches = 32;

struct CensusOptions {
    std::uint64_t photons = 1u << 22;  // about; in kCensusBatches batches
    int threads = 0;
    // Told on any thread how many photons are traced; false ends it.
    std::function<bool(std::uint64_t photons)> progress;
};

// Of the request its size, which says what the picture shows, its seed and its filter count. Ended
// by `progress`, what it gives has no batches.
[[nodiscard]] PathCensus takeCensus(const EmbreeScene& scene, const ReferenceRequest& request,
                                    const CensusOptions& options);

// Whether light takes such a path where only those of the filter are followed. A path with a
// reflection at an interface that would have refracted it as well is none of transmission alone;
// mirrors and total reflection are.
[[nodiscard]] bool isFollowed(const ArrivedPath& path, const PathFilter& filter);

// Which classes a reference is to keep apart.
struct ClassOrder {
    std::vector<std::string> patterns;  // as pathClassOf() takes them
    int count = 0;                      // further ones, those with the most light in the picture
    bool byObject = false;              // further ones are by the first specular object, too
    [[nodiscard]] bool isEmpty() const { return patterns.empty() && count == 0; }
};

// The classes of an order: those that are named, then the brightest of the paths that none of them
// takes, as a census of a few photons finds it, the same for all shards. Fewer than asked for where
// there are no more. Throws ConfigError, by the settings' names `patternsPlace` and `countPlace`.
[[nodiscard]] std::vector<PathClass> chooseClasses(const EmbreeScene& scene,
                                                   const ReferenceRequest& request,
                                                   const ClassOrder& order,
                                                   const std::string& patternsPlace,
                                                   const std::string& countPlace);

// Bytes that sums of a request take in memory, with the batches that are computed at once.
[[nodiscard]] std::uint64_t bytesOfSums(const EmbreeScene& scene, const ReferenceRequest& request,
                                        int threads);

}  // namespace kaustik::reference
