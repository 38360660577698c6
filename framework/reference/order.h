// SPDX-License-Identifier: MIT
// A reference as people ask for it, in the words of a command line or of Python, and what that
// means; so that all ways in have the same limits and the same sentences.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "framework/reference/batches.h"
#include "framework/reference/path_census.h"
#include "framework/reference/reference.h"

namespace kaustik::reference {

// The photon count of a reference for which no stop was given.
inline constexpr long long kUsualPhotons = 1LL << 26;

struct Order {
    std::string estimator = "light";  // or sppm
    int width = 800;                  // pixels
    int height = 600;
    std::optional<long long> photons;     // where to stop: what is reached first
    std::optional<double> seconds;        //
    std::optional<double> relativeError;  // standard error over the mean
    long long seed = 1;
    int threads = 0;  // 0: all
    bool transmissionOnly = false;
    int interactions = 64;
    bool causticView = false;
    ClassOrder classes;  // none: paths are not told apart
};

// How whoever asks writes the name of a setting: "--caustic-view" for "caustic-view".
using Spelling = std::function<std::string(const std::string& name)>;

// Both throw ConfigError, by the setting's name, for what there is not or what is out of range.
[[nodiscard]] ReferenceRequest requestOf(const Order& order, const Spelling& spelled);
[[nodiscard]] RunOptions optionsOf(const Order& order, const Spelling& spelled);

// Chooses the classes of the request as the order has them, and tells `report` in a sentence which
// they are and how much memory they take, before it is taken. Throws ConfigError for classes that
// there cannot be, and where this machine has less memory.
void addClasses(const EmbreeScene& scene, const Order& order, const Spelling& spelled,
                const std::function<void(const std::string&)>& report, ReferenceRequest& request);

}  // namespace kaustik::reference
