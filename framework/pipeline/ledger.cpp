// SPDX-License-Identifier: MIT
#include "framework/pipeline/ledger.h"

#include <algorithm>
#include <cmath>

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
        {kAccountBatchLimit, "batch_limit"},
        {kAccountOccludedSplat, "occluded"},
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

namespace {

// Of the map of flux, or of the photons that the last tracing has left on their way.
Ledger close(FrameBuilder& frame, const FrameOutputs& outputs, const Ledger& ledger, bool sumsMap) {
    struct Data {
        Ledger ledger;
    };
    const Photons& photons = outputs.hits.incoming;
    return frame
        .pass<Data>(
            "ledger.close", "the report accounts for every watt",
            [&](graph::PassSetup& setup, Data& data) {
                if (sumsMap) {
                    setup.sample("fluxSums", outputs.map.flux);
                } else {
                    outputs.hits.sample(setup);
                    photons.sample(setup);
                }
                data.ledger = setup.storage("LedgerEntries", setup.write(ledger));
            },
            [sumsMap, photons, map = outputs.map.flux](const Data&, gl::PassContext& context) {
                gl::Command command = context.compute("common/ledger_close.comp");
                if (!sumsMap) return dispatchOver(command, photons);
                const graph::TextureDesc& desc = context.texture(map).desc();
                constexpr int kRow = 32768;  // workgroups
                const int groups = (desc.width * desc.height + 63) / 64;
                command.define("SUMS_MAP")
                    .dispatch(std::min(groups, kRow), (groups + kRow - 1) / kRow);
            })
        .ledger;
}

}  // namespace

Ledger closeLedger(FrameBuilder& frame, const FrameOutputs& outputs) {
    Ledger ledger = outputs.ledger;
    if (outputs.map.flux.valid()) ledger = close(frame, outputs, ledger, true);
    if (outputs.hits.flux.valid()) ledger = close(frame, outputs, ledger, false);
    return ledger;
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
