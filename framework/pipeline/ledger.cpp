// SPDX-License-Identifier: MIT
#include "framework/pipeline/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/render/raster_views.h"
#include "framework/transport/primitives.h"
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

void EnergyLedger::judgeEmission(double emittedWatts) {
    watts[kAccountEmissionSampling] += emittedWatts - watts[kAccountEmitted];
    watts[kAccountEmitted] = emittedWatts;
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
        {kAccountUnresolved, "unresolved"},
        {kAccountAsPublished, "as_published"}};
    return causes;
}

float ledgerQuantum(const scene::Scene& scene) {
    const scene::Bounds bounds = sceneBounds(scene);
    const glm::dvec3 size = bounds.empty ? glm::dvec3(1.0) : bounds.maximum - bounds.minimum;
    double total = 1e-30;
    for (const scene::Light& light : scene.lights) {
        if (light.band > 0) continue;
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
                    .set("parts", map.sets.parts())
                    .dispatchOver(desc.width, 8, desc.height, 8);
            });
    }
    return ledger;
}

Ledger closeLedger(FrameBuilder& frame, const FrameOutputs& outputs) {
    // Without a map no photon was ever on its way.
    return sumMaps(frame, outputs.map.maps, outputs.ledger);
}

namespace {

// Texels along a side of a light's view, and of each face of a cube around one that sees too much
// for a view. A silhouette is off by no more than half a texel, to either side alike.
constexpr int kEmittableSide = 1024;
constexpr int kEmittableFaceSide = 512;
constexpr int kTexelsTogether = 4;  // along a side of what one thread adds up

// Flux that the light sends through a texel onto a specular surface, W, all channels together.
struct EmittableFlux {
    static constexpr Format format = Format::r32f;
};

struct LightsView {
    int light = 0;
    render::RasterView view;
};

std::vector<LightsView> viewsOfSpecular(const scene::Scene& scene) {
    const scene::Bounds target = specularBounds(scene);
    std::vector<LightsView> all;
    for (std::size_t i = 0; i < scene.lights.size() && !target.empty; ++i) {
        const scene::Light& light = scene.lights[i];
        if (light.band > 0) continue;  // what it sends is measured with the first
        const int number = static_cast<int>(i);
        const render::RasterView view = render::makeLightView(light, target, sceneBounds(scene));
        if (!view.isClipped) {
            all.push_back({number, view});
            all.back().view.width = all.back().view.height = kEmittableSide;
            continue;
        }
        for (const render::RasterView& face :
             render::makeCube(light.position, view.nearMeters, kEmittableFaceSide))
            all.push_back({number, face});
    }
    return all;
}

void drawEmittable(const FrameInputs& inputs, gl::PassContext& context, const LightsView& seen,
                   const render::ViewInstances& instances, const Geometry& geometry,
                   const graph::Texture<EmittableFlux>& flux,
                   const graph::Texture<DepthBuffer>& depth) {
    const render::RasterView& view = seen.view;
    gl::Command command =
        context.shaders({"raster_views/eye.vert", "framework/ledger_emittable.frag"});
    command.target(flux).clear().depth(depth, gl::DepthTest::nearerReversed).clear();
    command.set("projection", view.projection())
        .set("lightToEye", render::between(view, inputs.view))
        .set("lightIndex", seen.light)
        .set("texelSize", glm::vec2(2.0 * view.halfExtent) / glm::vec2(view.width, view.height));
    inputs.gpuScene.draw(command, context, geometry, instances, render::DrawSet::all);
}

}  // namespace

Ledger addEmittable(FrameBuilder& frame, const FrameOutputs& outputs, Ledger ledger) {
    if (outputs.map.maps.empty()) return ledger;
    const std::vector<LightsView> views = viewsOfSpecular(frame.scene());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const LightsView& seen = views[i];
        const std::string suffix = i == 0 ? "" : fmt::format("_{}", i + 1);
        const render::ViewInstances& instances =
            frame.keep(frame.gpuScene().makeInstances(seen.view.worldToView));
        using Flux = graph::Texture<EmittableFlux>;
        struct Data {
            Flux flux;
            graph::Texture<DepthBuffer> depth;
        };
        const Flux flux =
            frame
                .pass<Data>(
                    "ledger.emittable", "what lights send onto specular surfaces is measured",
                    [&](graph::PassSetup& setup, Data& data) {
                        if (outputs.geometry.heightFields.valid())
                            setup.read(outputs.geometry.heightFields);
                        data.flux = setup.create<EmittableFlux>("ledger.emittable" + suffix,
                                                                seen.view.width, seen.view.height);
                        data.depth = setup.create<DepthBuffer>("ledger.emittable_depth" + suffix,
                                                               seen.view.width, seen.view.height);
                    },
                    [&inputs = frame.inputs(), &instances, seen, geometry = outputs.geometry](
                        const Data& data, gl::PassContext& context) {
                        drawEmittable(inputs, context, seen, instances, geometry, data.flux,
                                      data.depth);
                    })
                .flux;
        ledger = frame.pass<Ledger>(
            "ledger.emission", "what should be emitted is accounted for",
            [&](graph::PassSetup& setup, Ledger& data) {
                setup.sample("emittable", flux);
                data = setup.storage("LedgerEntries", setup.write(ledger));
            },
            [side = seen.view.width](const Ledger&, gl::PassContext& context) {
                context.compute("framework/ledger_emittable.comp")
                    .set("side", kTexelsTogether)
                    .dispatchOver(side / kTexelsTogether, 8, side / kTexelsTogether, 8);
            });
    }
    return ledger;
}

EnergyLedger readLedger(const gl::Buffer& buffer, float quantumWatts) {
    EnergyLedger ledger;
    const std::vector<LedgerEntry> entries = buffer.read<LedgerEntry>();
    ledger.traced = entries.front().traced;
    const auto wattsOf = [&](std::size_t entry) {
        const double units = std::ldexp(static_cast<double>(entries[entry].high), 32) +
                             static_cast<double>(entries[entry].low);
        return units * static_cast<double>(quantumWatts) / kChannels;
    };
    for (std::size_t account = 0; account < kAccountCount; ++account) {
        ledger.watts[account] = wattsOf(account);
        ledger.events[account] = entries[account].events;
    }
    ledger.watts[kAccountDeposited] += wattsOf(kSumMapDeficit) - wattsOf(kSumMapExcess);
    return ledger;
}

}  // namespace kaustik
