// SPDX-License-Identifier: MIT
#include "framework/pipeline/ledger.h"

#include <algorithm>
#include <cmath>

#include "framework/render/raster_views.h"
#include "framework/transport/watts.h"

namespace kaustik {

using namespace transport;

double EnergyLedger::lostWatts() const {
    double lost = 0.0;
    for (const auto& [account, name] : lossCauses())
        lost += watts[account];
    return lost;
}

double EnergyLedger::balance() const {
    const double emitted = watts[kAccountEmitted];
    if (emitted <= 0.0) return 0.0;
    return (emitted - watts[kAccountDeposited] - watts[kAccountAbsorbed] -
            watts[kAccountLeftScene] - lostWatts()) /
           emitted;
}

const std::vector<std::pair<unsigned, std::string>>& lossCauses() {
    static const std::vector<std::pair<unsigned, std::string>> causes = {
        {kAccountUntracedBranch, "untraced_branch"},
        {kAccountEmissionSampling, "emission_sampling"},
        {kAccountOffScreen, "off_screen"},
        {kAccountBehindEye, "behind_eye"},
        {kAccountBeyondLastLayer, "beyond_layers"},
        {kAccountEdgeOn, "edge_on"},
        {kAccountMissedByTracer, "tracer"},
        {kAccountInternalReflectionLimit, "internal_reflection_limit"},
        {kAccountBounceLimit, "bounce_limit"},
        {kAccountNestingLimit, "nesting_limit"},
        {kAccountOccludedSplat, "occluded"},
        {kAccountOutsideMap, "outside_map"},
        {kAccountHiddenInMap, "hidden_in_map"},
        {kAccountDiscardedTriangle, "discarded_triangle"},
        {kAccountNotANumber, "not_a_number"},
        {kAccountUnresolved, "unresolved"}};
    return causes;
}

float ledgerQuantum(const scene::Scene& scene) {
    const scene::Bounds bounds = sceneBounds(scene);
    const glm::dvec3 size = bounds.empty ? glm::dvec3(1.0) : bounds.maximum - bounds.minimum;
    double total = 1e-30;
    for (const scene::Light& light : scene.lights) {
        const double power = static_cast<double>(light.power.r + light.power.g + light.power.b);
        // No rectangle around the bounds is larger than the square of their diagonal.
        const double spread = light.kind == scene::LightKind::directional
                                  ? glm::dot(size, size)
                                  : 4.0 * 3.14159265358979323846;
        total += power * spread;
    }
    return static_cast<float>(std::exp2(std::ceil(std::log2(total)) - 60.0));
}

Ledger closeBatch(FrameBuilder& frame, const Hits& hits, const Ledger& ledger) {
    return frame.pass<Ledger>(
        "reconstruct.left_over", "photons that are still on their way are counted",
        [&](graph::PassSetup& setup, Ledger& data) {
            hits.sample(setup);
            hits.incoming.sample(setup);
            data = setup.storage("LedgerEntries", setup.write(ledger));
            setup.bypass(data, ledger);
        },
        [photons = hits.incoming](const Ledger&, gl::PassContext& context) {
            dispatchOver(context.compute("framework/ledger_bounces.comp"), photons);
        });
}

Ledger sumMaps(FrameBuilder& frame, const std::vector<FluxMap>& maps, Ledger ledger) {
    for (const FluxMap& map : maps) {
        if (map.cascade > 0) continue;
        ledger = frame.pass<Ledger>(
            "ledger.close", "the report accounts for every watt",
            [&](graph::PassSetup& setup, Ledger& data) {
                setup.sample("fluxSums", map.flux);
                data = setup.storage("LedgerEntries", setup.write(ledger));
            },
            [map](const Ledger&, gl::PassContext& context) {
                const graph::TextureDesc& desc = context.texture(map.flux).desc();
                context.compute("framework/ledger_close.comp")
                    .set("mapCount", map.on.views->count())
                    .set("wordsPerMap", map.wordsPerView())
                    .set("parts", map.sets.parts)
                    .dispatchOver(desc.width, 8, desc.height, 8);
            });
    }
    return ledger;
}

Ledger closeLedger(FrameBuilder& frame, const FrameOutputs& outputs) {
    // Without a map no photon was ever on its way.
    return sumMaps(frame, outputs.map.maps, outputs.ledger);
}

EnergyLedger readLedger(const gl::Buffer& buffer, float quantumWatts) {
    EnergyLedger ledger;
    const std::vector<LedgerEntry> entries = buffer.read<LedgerEntry>();
    for (std::size_t account = 0; account < entries.size(); ++account) {
        const double units = std::ldexp(static_cast<double>(entries[account].high), 32) +
                             static_cast<double>(entries[account].low);
        ledger.watts[account] = units * static_cast<double>(quantumWatts) / kChannels;
        ledger.events[account] = entries[account].events;
    }
    return ledger;
}

}  // namespace kaustik
