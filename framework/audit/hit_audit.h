// SPDX-License-Identifier: MIT
// The photon audit: for every photon that a tracer handled in a frame, the exact first hit by
// Embree from the same transfer map, and what became of it (framework/README.md, "The energy
// ledger" and "The report").
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/audit/photon_fate.h"
#include "framework/image/image.h"
#include "framework/pipeline/ledger.h"
#include "framework/pipeline/renderer.h"

namespace kaustik::audit {

// Median, 95th and 99th percentile by the nearest rank, and the maximum.
struct Quantiles {
    double median = 0.0;
    double percentile95 = 0.0;
    double percentile99 = 0.0;
    double maximum = 0.0;
};
// The quantiles do not exist without samples.
[[nodiscard]] std::optional<Quantiles> quantilesOf(std::vector<double> samples);

// A photon with the wrong fate, for the picture: where it should be, or is where it should not.
struct WrongPhoton {
    glm::dvec2 pixel{0.0};  // from the lower left corner
    Verdict verdict = Verdict::right;
};

struct HitAudit {
    std::uint64_t photons = 0;       // that were traced, of all tracings of the frame
    std::uint64_t notANumber = 0;    // photons that are none themselves; not among them
    std::uint64_t exactHits = 0;     // photons that have a first hit
    std::uint64_t visible = 0;       // photons whose first hit the screen could show
    std::uint64_t reachable = 0;     // photons whose first hit the tracer itself can find
    std::uint64_t right = 0;         // of all
    std::uint64_t rightVisible = 0;  // of those that are visible
    std::uint64_t rightReachable = 0;
    // Photons that were taken straight through a specular surface, to what lies beyond it.
    std::uint64_t throughSpecular = 0;
    std::optional<Quantiles> meters;  // from the exact hit, where there are both
    std::optional<Quantiles> pixels;
    std::uint64_t unplaced = 0;  // pairs of hits of which one is not before the eye: no pixels
    std::map<std::string, std::uint64_t> missed;     // by cause
    std::map<std::string, std::uint64_t> falseHits;  // by cause
    // Flux of photons that got no hit, by the ledger's account that it belongs to.
    std::array<double, transport::kAccountCount> missedWatts{};
    std::array<std::uint64_t, transport::kAccountCount> missedPhotons{};
    EnergyLedger booked;  // by the tracers themselves
    std::vector<WrongPhoton> wrong;

    // Shares of photons; they do not exist where there is no photon to judge.
    [[nodiscard]] std::optional<double> agreement() const;
    [[nodiscard]] std::optional<double> agreementVisible() const;
    [[nodiscard]] std::optional<double> agreementReachable() const;
};

// Judges the frame that `renderer` has rendered for Purpose::audit. `scene` must be made of the
// scene that was rendered.
[[nodiscard]] HitAudit auditHits(const Renderer& renderer, const reference::EmbreeScene& scene,
                                 int threads = 0);

// The `hits` of report.json; null, with a reason, for what there is not.
[[nodiscard]] nlohmann::json toJson(const HitAudit& audit);
[[nodiscard]] nlohmann::json hitsSchema();

// The ledger of that frame with what the tracers could not tell apart told apart, and with what the
// reference says that light emits in place of what the grid caught: the difference is the loss to
// emission sampling, negative where the grid caught too much.
[[nodiscard]] EnergyLedger resolveLedger(const Renderer& renderer, const HitAudit& audit,
                                         double emittedWatts);

// The wrong photons over `display` (display-encoded RGB, rows from the top), which is dimmed:
// missed in blue, false in orange, those next to their place in yellow. `samplesPerSide`: of the
// pixels of what was audited in one of the picture's.
[[nodiscard]] Image wrongPhotonsPicture(const HitAudit& audit, const Image& display,
                                        int samplesPerSide = 1);

}  // namespace kaustik::audit
