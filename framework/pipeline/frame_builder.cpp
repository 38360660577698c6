// SPDX-License-Identifier: MIT
#include "framework/pipeline/frame_builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/pipeline/ledger.h"
#include "framework/pipeline/stage_params.h"
#include "framework/pipeline/tile_hits.h"
#include "framework/pipeline/tracing_log.h"
#include "framework/scene/emitters.h"
#include "framework/transport/photon_list.h"
#include "framework/transport/primitives.h"

namespace kaustik {

const params::ParamSet& settingsOf(const FrameBuilder& frame) {
    return frame.inputs().params;
}

const Registry::Node& FrameBuilder::chosenNode(const std::string& stage) {
    stagesRun_.push_back(stage);
    return inputs_.registry.findNode(stage, inputs_.params.choice(stage));
}

TracerReach FrameBuilder::tracerReach() const {
    return traits<TraceStage>().reach;
}

bool FrameBuilder::usesBeams() const {
    return facts().usesBeams();
}

bool FrameBuilder::joinsCells() const {
    return traits<ReconstructStage>().joinsCells;
}

params::Extent FrameBuilder::photonsOfALight() const {
    const auto& own = traits<EmitStage>().photons;
    if (own) return own(*this);
    // The points of a light that has a size share out its photons, and so do wavelengths.
    const params::Extent photons = params<EmitParams>("emit").photons;
    const double side = 1.0 / std::sqrt(scene::mostLightPoints(scene()) * needs().bands);
    const auto part = [&](int count) {
        return std::max(static_cast<int>(std::lround(count * side)), 1);
    };
    return {part(photons.width), part(photons.height)};
}

int FrameBuilder::runsOf(const std::string& stage) const {
    return static_cast<int>(std::count(stagesRun_.begin(), stagesRun_.end(), stage));
}

void FrameBuilder::needsWayOut(const Photons& photons, const Surfaces& /*surfaces*/) const {
    if (!photons.paths.insideBodies || !traits<TraceStage>().onlyReceivers) return;
    std::vector<std::string> bodies;
    for (const std::vector<std::size_t>& objects : needs().bodies) {
        for (const std::size_t object : objects)
            bodies.push_back("'" + scene().objects[object].name + "'");
    }
    const Registry& registry = inputs_.registry;
    std::vector<std::string> choices;
    for (const Registry::Node& node : registry.nodes()) {
        if (node.stage == SpecularStage::name &&
            registry.traits<SpecularStage>(node.name).throughBodies)
            choices.push_back("specular=" + node.name);
    }
    for (const Registry::Node& node : registry.nodes()) {
        if (node.stage != TraceStage::name) continue;
        const auto& tracer = registry.traits<TraceStage>(node.name);
        if (!tracer.onlyReceivers && !tracer.multipliesLight)
            choices.push_back("trace=" + node.name);
    }
    throw ConfigError(fmt::format(
        "trace.{} finds receivers alone, and specular.{} would leave photons inside of {} to it, "
        "all of whose light would be lost; take {}.",
        inputs_.params.choice(TraceStage::name), inputs_.params.choice(SpecularStage::name),
        joinNames(bodies), fmt::join(choices, " or ")));
}

std::optional<ScreenTile> FrameBuilder::tile() const {
    return inputs_.tiles ? inputs_.tiles->tile : std::nullopt;
}

bool FrameBuilder::endsTile(int interaction, int interactions) {
    maxRounds_ = std::max(maxRounds_, interactions);
    return tile() && static_cast<std::size_t>(interaction) > inputs_.tiles->rounds.size();
}

void FrameBuilder::requireTileNodes() const {
    if (!inputs_.tiles) return;
    const std::string obstacle = noCausticReason(facts());
    if (!obstacle.empty())
        throw ConfigError(fmt::format("--tiles: there is nothing to trace, {}.", obstacle));
    requireTiles<DriverStage>();
    requireTiles<LayersStage>();
    requireTiles<TraceStage>();
}

// Throws ConfigError where the node that is chosen cannot take part in tiles.
template <class Stage>
void FrameBuilder::requireTiles() const {
    if (traits<Stage>().tiles) return;
    std::vector<std::string> choices;
    for (const Registry::Node& node : inputs_.registry.nodes()) {
        if (node.stage == Stage::name && inputs_.registry.traits<Stage>(node.name).tiles)
            choices.push_back(fmt::format("{}={}", Stage::name, node.name));
    }
    throw ConfigError(fmt::format("--tiles: {}={} does not work in tiles of the screen; take {}.",
                                  Stage::name, inputs_.params.choice(Stage::name),
                                  fmt::join(choices, " or ")));
}

Hits FrameBuilder::hitsOfTiles(const TraceStage::Build& build, const Photons& photons,
                               const Surfaces& surfaces) {
    const std::vector<RoundOfHits>& rounds = inputs_.tiles->rounds;
    const std::size_t round = tracingsOfBatch_[photons.batch]++;
    if (round < rounds.size()) {
        const auto known = rounds[round].find(photons.suffix);
        return loadHits(*this, photons, known == rounds[round].end() ? FirstHits{} : known->second);
    }
    // After the last round nothing is on its way.
    if (!tile()) return loadHits(*this, photons, FirstHits{});
    tileHits_.push_back(build(*this, photons, surfaces));
    return tileHits_.back();
}

CausticMap FrameBuilder::closed(CausticMap map) {
    const auto close = traits<ReconstructStage>().close;
    return close != nullptr ? close(*this, std::move(map)) : map;
}

Hits FrameBuilder::traced(const TraceStage::Build& build, const Photons& photons,
                          const Surfaces& surfaces) {
    TraceStage::Build tracer = build;
    if (inputs_.tiles) {
        tracer = [this, &build](FrameBuilder&, const Photons& list, const Surfaces& seen) {
            return hitsOfTiles(build, list, seen);
        };
    }
    return recordsTraces_ ? recorded(tracer, photons, surfaces) : tracer(*this, photons, surfaces);
}

Hits FrameBuilder::recorded(const TraceStage::Build& build, const Photons& photons,
                            const Surfaces& surfaces) {
    const std::string name = fmt::format("audit.ledger_{}", runsOf(TraceStage::name));
    TraceRecord record;
    record.before = copyLedger(*this, photons.ledger, name + "_before");
    record.hits = build(*this, photons, surfaces);
    record.reach = tracerReach();
    if (loops_ > 0) {
        logTracing(*this, record, name + "_after");
    } else {
        record.after = copyLedger(*this, record.hits.incoming.ledger, name + "_after");
    }
    traces_.push_back(record);
    return record.hits;
}

void FrameBuilder::beginLoop() {
    graph_.beginLoop();
    ++loops_;
}

void FrameBuilder::endLoop(const graph::ResourceRef& again, std::size_t word, bool mayRunIdle) {
    graph_.endLoop(again, word, mayRunIdle);
    --loops_;
}

Views FrameBuilder::eyeViews() {
    return once<render::RasterViews>("eye.views", [this] {
        return std::make_shared<render::RasterViews>(inputs_.view, inputs_.instances);
    });
}

Views FrameBuilder::makeViews(render::Space space, std::vector<render::RasterView> views) {
    auto made = std::make_shared<render::RasterViews>(space, std::move(views), inputs_.gpuScene,
                                                      inputs_.view);
    keptObjects_.push_back(made);
    return made;
}

void needsEyesView(const std::string& node, const std::string& what, const Views& views) {
    if (views->isEyeView()) return;
    throw ConfigError(fmt::format("{} works on the screen, but {} it is given {} {}.", node, what,
                                  what.ends_with('s') ? "are" : "is",
                                  render::describe(views->space())));
}

void needsBeams(FrameBuilder& frame, const std::string& node, const Photons& photons) {
    if (photons.hasBeams()) return;
    throw ConfigError(fmt::format(
        "{} needs the beams of photons, which emit.{} does not make; take emit=grid, or "
        "reconstruct=sprites.",
        node, frame.chosenNode(EmitStage::name).name));
}

void FrameBuilder::request(const Photons& photons) {
    for (const graph::ResourceRef& handle : photons.textures())
        graph_.request(handle);
    graph_.request(photons.list);
}

void FrameBuilder::request(const Hits& hits) {
    for (const graph::ResourceRef& handle : hits.textures())
        graph_.request(handle);
    request(hits.incoming);
}

void dispatchOver(gl::Command& command, const Photons& photons) {
    command.dispatchIndirect(photons.list, offsetof(transport::PhotonList, groupsX));
}

void drawOver(gl::Command& command) {
    command.drawArrays(GL_TRIANGLE_STRIP, 4);
}

void setCells(gl::Command& command, const CellGrid& cells) {
    command.set("cellGrid", glm::ivec2(cells.width, cells.rows))
        .set("cellFirstRow", cells.firstRow)
        .set("cellLights", glm::ivec2(cells.firstLight, cells.lights))
        .set("cellSplits", cells.splits)
        .offer("cellOwnRows", glm::ivec2(cells.firstOwn, cells.endOwn));
}

void fillList(gl::PassContext& context, const Photons& photons) {
    const transport::PhotonList list = transport::photonListOf(
        static_cast<unsigned>(photons.capacity()), static_cast<unsigned>(photons.width));
    context.buffer(photons.list).upload(0, sizeof(list), &list);
}

namespace {

// Irradiance of zero and an empty ledger, in place of all that follows photons.
IrradianceMap skipCaustic(FrameBuilder& frame, const std::string& reason) {
    for (const char* stage :
         {DriverStage::name, EmitStage::name, SpecularStage::name, TraceStage::name,
          MediaStage::name, BlurStage::name, ReconstructStage::name, FilterStage::name,
          GatherStage::name, TemporalStage::name}) {
        const std::string node = frame.chosenNode(stage).name;
        frame.skip(std::string(stage) + "." + node, reason);
    }
    return frame.pass<IrradianceMap>(
        "reconstruct.nothing", "stands for a caustic that cannot be: " + reason,
        [&](graph::PassSetup& setup, IrradianceMap& data) {
            data.irradiance =
                setup.create<IrradianceTexel>("caustic.irradiance", frame.width(), frame.height());
            data.ledger =
                setup.createBuffer<transport::LedgerEntry>("ledger", transport::kLedgerEntryCount);
        },
        [](const IrradianceMap& data, gl::PassContext& context) {
            context.texture(data.irradiance).clear({0, 0, 0, 0});
            context.buffer(data.ledger).clear();
        });
}

}  // namespace

FrameOutputs buildFrame(FrameBuilder& frame) {
    frame.requireTileNodes();
    const Geometry geometry = frame.run<GeometryStage>();
    const EyeBuffer eye = frame.run<EyeStage>(geometry);
    const LayeredDepth layers = frame.run<LayersStage>(geometry);
    if (frame.tile()) {
        frame.run<DriverStage>(Surfaces{geometry, eye, layers});
        FrameOutputs outputs;
        outputs.layers = layers;
        return outputs;
    }
    const Shadows shadows = frame.run<ShadowStage>(geometry, eye, layers);
    const std::string obstacle = frame.skipsCaustic() ? "what the eye sees is judged without it"
                                                      : noCausticReason(frame.facts());
    const Surfaces surfaces{geometry, eye, layers};
    Caustic caustic;
    IrradianceMap irradiance;
    if (obstacle.empty()) {
        caustic = frame.run<DriverStage>(surfaces);
        caustic.map = frame.run<FilterStage>(caustic.map);
        irradiance = frame.run<GatherStage>(caustic.map, surfaces);
        irradiance = frame.run<TemporalStage>(irradiance, eye);
    } else {
        irradiance = skipCaustic(frame, obstacle);
    }
    const Picture picture = frame.run<ComposeStage>(
        geometry, eye, layers, LightParts{shadows, irradiance, caustic.inScattered, caustic.map});
    return {picture,
            irradiance,
            eye,
            obstacle.empty() ? layers : LayeredDepth{},
            caustic.last,
            irradiance.ledger,
            caustic.inScattered,
            shadows,
            caustic.map,
            caustic.cells,
            geometry};
}

}  // namespace kaustik
