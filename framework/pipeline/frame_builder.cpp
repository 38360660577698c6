// SPDX-License-Identifier: MIT
#include "framework/pipeline/frame_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "framework/pipeline/ledger.h"
#include "framework/pipeline/stage_params.h"
#include "framework/transport/photon_list.h"

namespace kaustik {

const Registry::Node& FrameBuilder::chosenNode(const std::string& stage) {
    stagesRun_.push_back(stage);
    return inputs_.registry.findNode(stage, inputs_.params.choice(stage));
}

Sees FrameBuilder::tracerSees() const {
    return inputs_.registry.findNode(TraceStage::name, inputs_.params.choice(TraceStage::name))
        .description.sees;
}

int FrameBuilder::runsOf(const std::string& stage) const {
    return static_cast<int>(std::count(stagesRun_.begin(), stagesRun_.end(), stage));
}

Hits FrameBuilder::recorded(const TraceStage::Build& build, const Photons& photons,
                            const Surfaces& surfaces) {
    const std::string name = fmt::format("audit.ledger_{}", runsOf(TraceStage::name));
    TraceRecord record;
    record.before = copyLedger(*this, photons.ledger, name + "_before");
    record.hits = build(*this, photons, surfaces);
    record.sees = tracerSees();
    record.after = copyLedger(*this, record.hits.incoming.ledger, name + "_after");
    traces_.push_back(record);
    return record.hits;
}

void FrameBuilder::request(const Photons& photons) {
    for (const graph::ResourceRef& handle : std::initializer_list<graph::ResourceRef>{
             photons.position, photons.direction, photons.flux, photons.origin, photons.list}) {
        graph_.request(handle);
    }
}

void FrameBuilder::request(const Hits& hits) {
    for (const graph::ResourceRef& handle :
         std::initializer_list<graph::ResourceRef>{hits.position, hits.surface, hits.flux}) {
        graph_.request(handle);
    }
    request(hits.incoming);
}

void dispatchOver(gl::Command& command, const Photons& photons) {
    command.dispatchIndirect(photons.list, offsetof(transport::PhotonList, groupsX));
}

void drawOver(gl::Command& command) {
    command.drawArrays(GL_TRIANGLE_STRIP, 4);
}

void fillList(gl::PassContext& context, const Photons& photons) {
    const transport::PhotonList list = transport::photonListOf(
        static_cast<unsigned>(photons.capacity()), static_cast<unsigned>(photons.width));
    context.buffer(photons.list).upload(0, sizeof(list), &list);
}

namespace {

// A path through still water hits it once. Where one can come back, the limit decides, and the
// ledger says what it cost.
int interactionCount(const FrameBuilder& frame, const ModelledPaths& paths) {
    const scene::HitsAgain& again = frame.needs().hitsAgain;
    const bool canRepeat = paths.transmissionOnly ? again.transmitted : again.reflected;
    return canRepeat ? frame.params<SpecularParams>("specular").bounces : 1;
}

// Why the frame has no caustic; "" if it may have one.
std::string whyNoCaustic(const FrameBuilder& frame) {
    const scene::SceneNeeds& needs = frame.needs();
    if (frame.skipsCaustic()) return "what the eye sees is judged without it";
    if (needs.lights == 0) return "the scene has no light";
    if (needs.specularInterfaces == 0) return "the scene has no specular surface";
    if (!needs.receivers) return "the scene has no receiver";
    return "";
}

// Irradiance of zero and an empty ledger, in place of all that follows photons.
IrradianceMap skipCaustic(FrameBuilder& frame, const std::string& why) {
    for (const char* stage :
         {EmitStage::name, SpecularStage::name, TraceStage::name, MediaStage::name, BlurStage::name,
          ReconstructStage::name, GatherStage::name}) {
        const std::string node = frame.chosenNode(stage).name;
        frame.skip(std::string(stage) + "." + node, why);
    }
    return frame.pass<IrradianceMap>(
        "reconstruct.nothing", "stands for a caustic that cannot be: " + why,
        [&](graph::PassSetup& setup, IrradianceMap& data) {
            data.irradiance =
                setup.create<IrradianceTexel>("caustic.irradiance", frame.width(), frame.height());
            data.ledger =
                setup.createBuffer<transport::LedgerEntry>("ledger", transport::kAccountCount);
        },
        [](const IrradianceMap& data, gl::PassContext& context) {
            context.texture(data.irradiance).clear({0, 0, 0, 0});
            context.buffer(data.ledger).clear();
        });
}

struct Caustic {
    Hits last;  // of the last tracing
    CausticMap map;
    InScattered inScattered;
};

// All photons at once, or, where they are more than a batch may hold, whole rows of one light's
// grid after the other.
std::vector<Samples> batchesOf(const FrameBuilder& frame) {
    const auto& emit = frame.params<EmitParams>("emit");
    const int lights = std::max(frame.needs().lights, 1);
    const std::int64_t all = std::int64_t{emit.photons.width} * emit.photons.height * lights;
    if (all <= emit.batch) return {{0, lights, 0, emit.photons.height, "", {}}};
    const int rows = std::clamp(emit.batch / emit.photons.width, 1, emit.photons.height);
    std::vector<Samples> batches;
    for (int light = 0; light < lights; ++light) {
        for (int row = 0; row < emit.photons.height; row += rows) {
            const std::string suffix =
                batches.empty() ? "" : fmt::format(".{}", batches.size() + 1);
            batches.push_back(
                {light, 1, row, std::min(rows, emit.photons.height - row), suffix, {}});
        }
    }
    return batches;
}

// From interaction to interaction: what arrives is deposited at once, and what hits another
// specular surface is the next list.
Caustic followPhotons(FrameBuilder& frame, const Surfaces& surfaces) {
    const bool scatters = frame.needs().scatteringMedium;
    Caustic caustic;
    for (Samples samples : batchesOf(frame)) {
        samples.ledger = caustic.map.ledger;
        Hits hits = frame.run<EmitStage>(surfaces, samples);
        int interactions = 1;
        for (int i = 0; i < interactions; ++i) {
            const Photons photons = frame.run<SpecularStage>(hits);
            interactions = interactionCount(frame, photons.paths);
            hits = frame.run<TraceStage>(photons, surfaces);
            caustic.map = frame.run<ReconstructStage>(hits, surfaces, caustic.map);
            hits.incoming.ledger = caustic.map.ledger;
            if (scatters) {
                caustic.inScattered =
                    frame.run<MediaStage>(hits, surfaces.eye, caustic.inScattered);
            }
        }
        // What is still on its way is counted at once, so that the batch need not be kept.
        caustic.map.ledger = closeBatch(frame, hits, caustic.map.ledger);
        caustic.last = hits;
    }
    if (scatters) {
        caustic.inScattered = frame.run<BlurStage>(caustic.inScattered);
    } else {
        for (const char* stage : {MediaStage::name, BlurStage::name}) {
            frame.skip(std::string(stage) + "." + frame.chosenNode(stage).name,
                       "the scene has no medium that scatters");
        }
    }
    return caustic;
}

}  // namespace

FrameOutputs buildFrame(FrameBuilder& frame) {
    const Geometry geometry = frame.run<GeometryStage>();
    const EyeBuffer eye = frame.run<EyeStage>(geometry);
    const LayeredDepth layers = frame.run<LayersStage>(geometry);
    const Shadows shadows = frame.run<ShadowStage>(geometry, eye, layers);
    const std::string whyNot = whyNoCaustic(frame);
    const Surfaces surfaces{geometry, eye, layers};
    Caustic caustic;
    IrradianceMap irradiance;
    if (whyNot.empty()) {
        caustic = followPhotons(frame, surfaces);
        irradiance = frame.run<GatherStage>(caustic.map, surfaces);
    } else {
        irradiance = skipCaustic(frame, whyNot);
    }
    const Picture picture = frame.run<ComposeStage>(
        geometry, eye, layers, LightParts{shadows, irradiance, caustic.inScattered});
    return {picture,
            irradiance,
            eye,
            whyNot.empty() ? layers : LayeredDepth{},
            caustic.last,
            irradiance.ledger,
            caustic.inScattered,
            shadows,
            caustic.map};
}

}  // namespace kaustik
