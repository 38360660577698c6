// SPDX-License-Identifier: MIT
// What techniques make of a scene's caustic light: a frame of each with few photons, its ledger,
// and by the paths that it says it models what it cannot form (path_account.h). What
// `kaustik census` prints.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/shard.h"
#include "framework/gl/context.h"
#include "framework/run/path_account.h"
#include "framework/run/settings.h"

namespace kaustik::run {

struct CensusRequest {
    int width = 200;
    int height = 150;
    std::uint64_t photons = 1u << 22;          // of the census of paths
    std::string techniquePhotons = "128x128";  // emit.photons of the frames
    int threads = 0;
    // Rows to account for; empty: all techniques, with their defaults and as published where they
    // have a row of their own.
    std::vector<std::string> techniques;
    std::vector<params::Assignment> assignments;  // for all of them
    std::optional<Shard> shard;                   // of the rows, dealt out one by one
};

struct TechniqueAccount {
    std::string technique;
    bool isAsPublished = false;
    std::string problem;  // "" where a frame was rendered
    ModelledPaths paths;
    double emittedWatts = 0.0;  // as the census has it
    double formedWatts = 0.0;   // that the ledger has as deposited
    reference::PathFlux unformed;
    std::vector<ClassFlux> classes;                          // with what is unformed of each
    std::vector<std::pair<std::string, double>> losses;      // W, by cause
    std::vector<std::pair<std::string, double>> unfollowed;  // W, as the ledger has them: also what
                                                             // would have reached no receiver
    [[nodiscard]] double lostWatts() const;
    // "planar, as published"
    [[nodiscard]] std::string rowName() const;
    // "transmission, 8 interactions"
    [[nodiscard]] std::string modelled() const;
};

struct SceneCensus {
    std::string scene;
    std::string device;
    reference::PathCensus light;
    std::vector<ClassFlux> classes;
    std::vector<ObjectFlux> objects;
    CensusRequest request;                     // by which it was made
    std::string settings;                      // of the techniques, as text
    std::vector<std::string> rows;             // of techniques, all that were asked for
    std::vector<TechniqueAccount> techniques;  // of those the shard's own
};

// Takes the census and renders the frames; `watch` is told how far it is, and may end it, as an
// Error. Throws ConfigError for techniques and settings that there are not.
[[nodiscard]] SceneCensus accountFor(gl::Context& context, const Registry& registry,
                                     scene::Scene& scene, const CensusRequest& request,
                                     const Watch& watch);

// Without techniques yet.
[[nodiscard]] SceneCensus censusOfPaths(const scene::Scene& scene, const CensusRequest& request,
                                        const Watch& watch);
// What of an account follows from the paths that its technique models.
void setLight(TechniqueAccount& account, const reference::PathCensus& light);

// Schema kaustik.census/1: scene, settings, photons, energy, arriving, classes, objects,
// techniques; of a shard also which, and what it was asked for (census_shards.h).
[[nodiscard]] nlohmann::json toJson(const SceneCensus& census);
// Rows of CSV, with their heads: of the classes, and of the techniques.
[[nodiscard]] std::string classesCsv(const SceneCensus& census);
[[nodiscard]] std::string techniquesCsv(const SceneCensus& census);
// For a terminal.
[[nodiscard]] std::string makeTable(const SceneCensus& census);

}  // namespace kaustik::run
