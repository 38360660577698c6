// SPDX-License-Identifier: MIT
// What a technique does with each class of a scene's caustic light: what it forms, what it cannot
// form by its structure, and what it loses. Classes and their watts are a census of light tracing
// (reference/path_census.h); what is formed and lost is the ledger of a frame.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/pipeline/ledger.h"
#include "framework/pipeline/photons.h"
#include "framework/reference/path_census.h"
#include "framework/run/progress.h"

namespace kaustik::run {

// Whether a technique that models these paths follows such a one.
[[nodiscard]] bool isModelled(const reference::ArrivedPath& path, const ModelledPaths& paths);

// The light of all paths with the same interactions, whatever they hit first.
struct ClassFlux {
    std::string name;  // "TT"; kOtherClass for those that are not listed
    std::optional<reference::PathWord> word;
    reference::PathFlux flux;
    // That of it which a technique cannot form; with the paths of unformedLight().
    reference::PathFlux unformed;
};

// The brightest classes that have at least `leastShare` of all the light, `maximum` at most, and
// the rest; of each what is not modelled by `paths`, where they are given.
[[nodiscard]] std::vector<ClassFlux> classFluxes(const reference::PathCensus& census,
                                                 std::size_t maximum, double leastShare,
                                                 const ModelledPaths* paths = nullptr);

// The light by the first specular object, the brightest first.
struct ObjectFlux {
    std::string name;
    reference::PathFlux flux;
};
[[nodiscard]] std::vector<ObjectFlux> objectFluxes(const reference::PathCensus& census,
                                                   const scene::Scene& scene);

// What arrives by paths that are not modelled.
[[nodiscard]] reference::PathFlux unformedLight(const reference::PathCensus& census,
                                                const ModelledPaths& paths);

// What of a ledger's losses is of light that a technique with these paths goes after: all but that
// beyond its last interaction, and, where it follows one branch alone, that of the other. Where it
// follows both, a branch that it leaves (`untraced_branch`) is a loss, with what of it would have
// reached no receiver. By cause, those that are not 0.
[[nodiscard]] std::vector<std::pair<std::string, double>> lossesOf(const EnergyLedger& ledger,
                                                                   const ModelledPaths& paths);

// A sentence for reports: "screen_space_photons cannot form 0.86 W, 1.6% of the caustic light
// (TRT 0.5 W, ...)"; "" where it forms all but 0.05%.
[[nodiscard]] std::string unformedSentence(const reference::PathCensus& census,
                                           const ModelledPaths& paths,
                                           const std::string& technique);

// The same as JSON: watts, standard errors and shares, by class.
[[nodiscard]] nlohmann::json unformedJson(const reference::PathCensus& census,
                                          const ModelledPaths& paths);
[[nodiscard]] nlohmann::json unformedSchema();

// The census that the cache has of a scene as it is at its time; the one of the most photons.
// Nothing where there is none, or where it is damaged.
[[nodiscard]] std::optional<reference::PathCensus> findCensus(const scene::Scene& scene);

// Takes it from the cache where it is of at least so many photons, or takes one and caches it, with
// progress on standard error. Throws Error when interrupted.
[[nodiscard]] reference::PathCensus obtainCensus(const scene::Scene& scene, int width, int height,
                                                 std::uint64_t photons, int threads);
// For a caller that shows the progress in a way of its own.
[[nodiscard]] reference::PathCensus obtainCensus(const scene::Scene& scene, int width, int height,
                                                 std::uint64_t photons, int threads,
                                                 const Watch& watch);

}  // namespace kaustik::run
