// SPDX-License-Identifier: MIT
#include "framework/pipeline/frame_builder.h"

#include <algorithm>

#include "framework/pipeline/stage_params.h"

namespace kaustik {

const Registry::Node& FrameBuilder::chosenNode(const std::string& stage) {
    stagesRun_.push_back(stage);
    return inputs_.registry.findNode(stage, inputs_.params.choice(stage));
}

int FrameBuilder::runsOf(const std::string& stage) const {
    return static_cast<int>(std::count(stagesRun_.begin(), stagesRun_.end(), stage));
}

gl::Command& FrameInputs::bindView(gl::Command& command) const {
    return command.uniforms("View", viewBlock);
}

gl::Command& FrameInputs::bindLedger(gl::Command& command, const Ledger& ledger) const {
    return command.storage("LedgerEntries", ledger)
        .set("ledgerUnitsPerWatt", 1.0f / ledgerQuantumWatts);
}

namespace {

// A path through still water meets it once. Where one can come back, the limit decides, and the
// ledger says what it cost.
int interactionCount(const FrameBuilder& frame, const ModelledPaths& paths) {
    const scene::MeetingsAgain& again = frame.needs().meetsAgain;
    const bool canRepeat = paths.transmissionOnly ? again.transmitted : again.reflected;
    return canRepeat ? frame.params<SpecularParams>("specular").bounces : 1;
}

// Why the frame has no caustic; "" if it may have one.
std::string whyNoCaustic(const FrameBuilder& frame) {
    const scene::SceneNeeds& needs = frame.needs();
    if (frame.leavesOutCaustic()) return "what the eye sees is judged without it";
    if (needs.lights == 0) return "the scene has no light";
    if (needs.specularInterfaces == 0) return "the scene has no specular surface";
    if (!needs.receivers) return "the scene has no receiver";
    return "";
}

// Irradiance of zero and an empty ledger, in place of all that follows photons.
IrradianceMap leaveOutCaustic(FrameBuilder& frame, const std::string& why) {
    for (const char* stage : {EmitStage::name, SpecularStage::name, TraceStage::name,
                              MediaStage::name, BlurStage::name, ReconstructStage::name}) {
        const std::string node = frame.chosenNode(stage).name;
        frame.leaveOut(std::string(stage) + "." + node, why);
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
    Hits hits;
    IrradianceMap map;
    InScattered inScattered;
};

Caustic followPhotons(FrameBuilder& frame, const Geometry& geometry, const EyeBuffer& eye,
                      const LayeredDepth& layers) {
    const bool scatters = frame.needs().scatteringMedium;
    Caustic caustic;
    caustic.hits = frame.run<EmitStage>(geometry);
    int interactions = 1;
    for (int i = 0; i < interactions; ++i) {
        const Hits meeting = frame.run<SpecularStage>(caustic.hits);
        interactions = interactionCount(frame, meeting.incoming.paths);
        caustic.hits = frame.run<TraceStage>(meeting.incoming, layers, meeting);
        if (scatters)
            caustic.inScattered = frame.run<MediaStage>(caustic.hits, eye, caustic.inScattered);
    }
    if (scatters) {
        caustic.inScattered = frame.run<BlurStage>(caustic.inScattered);
    } else {
        for (const char* stage : {MediaStage::name, BlurStage::name}) {
            frame.leaveOut(std::string(stage) + "." + frame.chosenNode(stage).name,
                           "the scene has no medium that scatters");
        }
    }
    caustic.map = frame.run<ReconstructStage>(caustic.hits, eye);
    return caustic;
}

}  // namespace

FrameOutputs buildFrame(FrameBuilder& frame) {
    const Geometry geometry = frame.run<GeometryStage>();
    const EyeBuffer eye = frame.run<EyeStage>(geometry);
    const LayeredDepth layers = frame.run<LayersStage>(geometry);
    const Shadows shadows = frame.run<ShadowStage>(geometry, eye, layers);
    const std::string whyNot = whyNoCaustic(frame);
    Caustic caustic;
    if (whyNot.empty()) {
        caustic = followPhotons(frame, geometry, eye, layers);
    } else {
        caustic.map = leaveOutCaustic(frame, whyNot);
    }
    const Picture picture = frame.run<ComposeStage>(
        geometry, eye, layers, LightParts{shadows, caustic.map, caustic.inScattered});
    return {picture,
            caustic.map,
            eye,
            whyNot.empty() ? layers : LayeredDepth{},
            caustic.hits,
            caustic.map.ledger,
            caustic.inScattered,
            shadows};
}

}  // namespace kaustik
