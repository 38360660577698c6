// SPDX-License-Identifier: MIT
#include "framework/pipeline/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "framework/core/elapsed.h"
#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/pipeline/pixel_mean.h"
#include "framework/pipeline/stage_params.h"
#include "framework/scene/spectrum.h"

namespace kaustik {
namespace {

gl::Buffer makeViewBlock(const scene::Scene& scene, const render::RasterView& view) {
    const transport::ViewData data = viewData(scene, view, view);
    return {sizeof(data), &data, "view"};
}

gl::Buffer makeLights(const scene::Scene& scene, const render::RasterView& view) {
    std::vector<transport::LightData> lights;
    for (const scene::Light& light : scene.lights)
        lights.push_back(lightData(light, view));
    lights.push_back({});  // a scene without lights still binds a block
    return {lights, "lights"};
}

gl::Buffer makeBands(const scene::Scene& scene) {
    transport::BandTable table{};
    for (int c = 0; c < 3; ++c)
        table.rec709FromFlux[c] = glm::vec4(glm::vec3(scene::rec709FromFlux()[c]), 0.0f);
    const std::size_t count = std::min<std::size_t>(scene.bands.size(), transport::kMaxBands);
    if (count > 0) table.lights.x = static_cast<float>(scene.lights.size() / scene.bands.size());
    for (std::size_t b = 0; b < count; ++b) {
        const scene::Band& band = scene.bands[b];
        table.bands[b].tint = glm::vec4(band.tint, static_cast<float>(band.place));
        for (int c = 0; c < 3; ++c)
            table.bands[b].ofLight[c] = glm::vec4(band.ofLight[c], 0.0f);
    }
    return {sizeof(table), &table, "bands"};
}

std::vector<std::string> namesOf(const graph::Compiled& compiled) {
    std::vector<std::string> passes;
    for (const graph::PassRecord& pass : compiled.records)
        passes.push_back(pass.name);
    return passes;
}

// The passes that a user may mean by `name`: its full name, or the ends of some after a dot.
std::vector<std::string> matchingPasses(const std::string& name,
                                        const std::vector<std::string>& passes) {
    std::vector<std::string> matches;
    for (const std::string& pass : passes) {
        if (pass == name) return {pass};
        if (pass.ends_with("." + name)) matches.push_back(pass);
    }
    return matches;
}

// The only one. Throws ConfigError with the nearest name.
std::string fullPassName(const std::string& name, const std::vector<std::string>& passes,
                         const std::string& disabledBy) {
    const std::vector<std::string> matches = matchingPasses(name, passes);
    if (matches.size() == 1) return matches.front();
    if (matches.empty()) {
        throw ConfigError(
            fmt::format("{}: there is no pass '{}'{} ('kaustik explain' prints them all).",
                        disabledBy, name, didYouMean(name, passes)));
    }
    throw ConfigError(fmt::format("{}: '{}' could be {}; write out which.", disabledBy, name,
                                  joinNames(matches)));
}

bool compiles(const graph::Graph& graph) {
    try {
        static_cast<void>(graph.compile());
        return true;
    } catch (const GraphError&) {
        return false;
    }
}

// Compiles the graph without the passes that the settings disable, and puts their full names there.
// Throws ConfigError for a name that does not exist and for a pass that is required.
graph::Compiled compileWithout(graph::Graph& graph, RenderSettings& settings) {
    std::set<std::string>& disabled = settings.disabledPasses;
    // What fails here is not the user's mistake.
    const std::vector<std::string> passes = namesOf(graph.compile());
    std::set<std::string> fullNames;
    for (const std::string& name : disabled)
        fullNames.insert(fullPassName(name, passes, settings.disabledBy));
    disabled = std::move(fullNames);

    const std::vector<std::string> declared = graph.passNames();
    for (const std::string& name : disabled) {
        // One that this scene does not need is skipped anyway.
        if (std::find(declared.begin(), declared.end(), name) == declared.end()) continue;
        graph.disable(name);
        if (!compiles(graph)) {
            throw ConfigError(
                fmt::format("{}: pass '{}' is required; nothing stands in for what it makes.",
                            settings.disabledBy, name));
        }
    }
    return graph.compile();
}

int samplesPerSideOf(const RenderSettings& settings) {
    return settings.params.get<EyeParams>(EyeStage::name).perSide();
}

render::RasterView eyeView(const scene::Scene& scene, const RenderSettings& settings) {
    const int side = samplesPerSideOf(settings);
    return render::makeEyeView(scene.camera, side * settings.width, side * settings.height);
}

}  // namespace

Renderer::Renderer(gl::Context& context, const Registry& registry, const scene::Scene& scene,
                   RenderSettings settings)
    : context_(context),
      registry_(registry),
      scene_(scene),
      settings_(std::move(settings)),
      view_(eyeView(scene, settings_)),
      gpuScene_(scene),
      viewBlock_(makeViewBlock(scene, view_)),
      lights_(makeLights(scene, view_)),
      bands_(makeBands(scene)),
      instances_(gpuScene_.makeInstances(view_.worldToView)),
      shapes_(scene),
      needs_(sceneNeeds(shapes_)),
      ledgerQuantumWatts_(ledgerQuantum(scene)),
      inputs_{registry_,
              settings_.params,
              gpuScene_,
              needs_,
              view_,
              instances_,
              settings_.seed,
              settings_.tiles,
              ledgerQuantumWatts_,
              samplesPerSideOf(settings_),
              context.info().isSoftware && !settings_.asOnGpu,
              &ofScene_},
      programs_(registry.shaderFolders()),
      executor_(context, programs_) {
    bindToAll(Purpose::measurement);
    context_.check();
}

// By the names of include/views/view.glsl, bands.glsl, surface_data.glsl, lights.glsl,
// scene_images.glsl and ledger.glsl.
void Renderer::bindToAll(Purpose purpose) {
    std::vector<std::string> defines;
    if (scene::hasNormalMaps(scene_)) defines.emplace_back("NORMAL_MAPS");
    if (!scene_.bands.empty()) defines.emplace_back("BANDS");
    inputs_.hasLedger = purpose != Purpose::picture || settings_.hasLedger;
    if (!inputs_.hasLedger) defines.emplace_back("NO_LEDGER");
    executor_.bindToAll({{{"View", &viewBlock_}, {"Bands", &bands_}},
                         {{"Materials", &gpuScene_.materials()}, {"Lights", &lights_}},
                         {{"sceneImages", &gpuScene_.images()}},
                         {{"ledgerUnitsPerWatt", 1.0f / ledgerQuantumWatts_}},
                         defines});
}

void Renderer::update(RenderSettings settings) {
    const bool asksForOthers =
        settings.technique.name != settings_.technique.name ||
        settings.technique.isAsPublished != settings_.technique.isAsPublished ||
        settings.disabledPasses != settings_.disabledPasses ||
        settings.hasLedger != settings_.hasLedger || settings.asOnGpu != settings_.asOnGpu ||
        settings.params.json() != settings_.params.json();
    if (asksForOthers) startedFor_.clear();
    settings_ = std::move(settings);
    view_ = eyeView(scene_, settings_);
    inputs_.samplesPerSide = samplesPerSideOf(settings_);
    inputs_.isOnProcessor = context_.info().isSoftware && !settings_.asOnGpu;
    viewBlock_ = makeViewBlock(scene_, view_);
    lights_ = makeLights(scene_, view_);
    bands_ = makeBands(scene_);
    instances_ = gpuScene_.makeInstances(view_.worldToView);
    const int measuredDepthComplexity = needs_.measuredDepthComplexity;
    needs_ = sceneNeeds(shapes_);
    needs_.measuredDepthComplexity = measuredDepthComplexity;
    ledgerQuantumWatts_ = ledgerQuantum(scene_);
    bindToAll(Purpose::measurement);
    context_.check();
}

render::RasterView Renderer::pictureView() const {
    return render::makeEyeView(scene_.camera, settings_.width, settings_.height);
}

std::vector<std::string> Renderer::forgetAbsentPasses() {
    if (settings_.disabledPasses.empty()) return {};
    static_cast<void>(declareFrame());
    const std::vector<std::string> passes = namesOf(graph_->compile());
    std::vector<std::string> absent;
    for (const std::string& name : settings_.disabledPasses) {
        if (matchingPasses(name, passes).empty()) absent.push_back(name);
    }
    for (const std::string& name : absent)
        settings_.disabledPasses.erase(name);
    return absent;
}

FrameBuilder Renderer::declareFrame(bool recordsTraces, bool skipsCaustic) {
    graph_ = std::make_unique<graph::Graph>();
    FrameBuilder frame(*graph_, inputs_, recordsTraces, skipsCaustic);
    if (settings_.tiles && inputs_.samplesPerSide > 1) {
        throw ConfigError("--tiles: they share out the pixels of a picture; take eye.samples=1.");
    }
    if (settings_.tiles && settings_.technique.build) {
        throw ConfigError(fmt::format(
            "--tiles: {} puts its stages together in a way of its own; take a technique that does "
            "not, such as screen_space_photons.",
            settings_.technique.name));
    }
    outputs_ = settings_.technique.build ? settings_.technique.build(frame) : buildFrame(frame);
    return frame;
}

graph::Compiled Renderer::compile(Purpose purpose, const std::vector<std::string>& resources) {
    const auto begin = std::chrono::steady_clock::now();
    FrameBuilder frame = declareFrame(purpose == Purpose::audit, purpose == Purpose::view);
    if (frame.tile()) return compileTile(frame);
    if (purpose != Purpose::picture) closedLedger_ = closeLedger(frame, outputs_);
    if (purpose == Purpose::measurement || purpose == Purpose::audit)
        closedLedger_ = addEmittable(frame, outputs_, closedLedger_);
    if (inputs_.samplesPerSide > 1) meanOverPixelsOfCaustic(frame);
    graph_->request(outputs_.picture.radiance, "the picture's radiance");
    graph_->request(outputs_.picture.display, "the picture");
    graph_->request(outputs_.caustic.irradiance, "the caustic's irradiance");
    if (outputs_.caustic.radiance.valid()) graph_->request(outputs_.caustic.radiance);
    if (outputs_.inScattered.radiance.valid()) graph_->request(outputs_.inScattered.radiance);
    if (purpose != Purpose::picture) {
        graph_->request(closedLedger_);
    }
    traces_ = frame.traces();
    if (purpose == Purpose::measurement || purpose == Purpose::audit) requestForMaps();
    if (purpose == Purpose::audit) requestForAudit();
    if (purpose == Purpose::view) requestExits();
    for (const std::string& name : resources) {
        const graph::ResourceRef handle = graph_->find(name);
        if (!handle.valid()) {
            throw ConfigError(
                fmt::format("There is no resource '{}'{}; 'kaustik explain' prints them all.", name,
                            didYouMean(name, graph_->resourceNames())));
        }
        graph_->request(handle);
    }
    graph::Compiled compiled =
        settings_.disabledPasses.empty() ? graph_->compile() : compileWithout(*graph_, settings_);
    // What is made anyway: a measurement asks for no pass of its own.
    const auto keepIfMade = [&](const graph::ResourceRef& handle) {
        const bool isMade = handle.valid() && purpose != Purpose::picture &&
                            compiled.slotOf(handle) != graph::Compiled::kNowhere;
        if (isMade) graph_->request(handle);
        return isMade;
    };
    hasLayerStatistics_ = keepIfMade(outputs_.layers.statistics);
    hasEyeRays_ = keepIfMade(outputs_.picture.view.ending);
    if (hasLayerStatistics_ || hasEyeRays_) compiled = graph_->compile();
    limits_.clear();
    nodeWarnings_.clear();
    if (purpose == Purpose::measurement || purpose == Purpose::audit)
        compiled = keepFindings(compiled, frame);
    buildMilliseconds_ = millisecondsSince(begin);
    keptObjects_ = frame.releaseKeptObjects();
    warnings_ = frame.warnings();
    for (const std::string& name : settings_.params.setByUser()) {
        const std::string reason = whyNoEffect(name, compiled);
        if (!reason.empty()) warnings_.push_back(sayNoEffect(name, reason));
    }
    isRandom_ = frame.isRandom();
    return compiled;
}

// The means take the names of what they are of, so that an output has one name in every frame.
void Renderer::meanOverPixelsOfCaustic(FrameBuilder& frame) {
    const auto average = [&](const char* name, auto& ofSamples) {
        if (!ofSamples.valid()) return;
        const std::string known = graph_->nameOf(ofSamples);
        graph_->rename(ofSamples, known + ".samples");
        ofSamples = meanOverPixels(frame, name, ofSamples);
        graph_->rename(ofSamples, known);
    };
    average("caustic", outputs_.caustic.irradiance);
    average("caustic_radiance", outputs_.caustic.radiance);
    average("in_scattered", outputs_.inScattered.radiance);
}

// Only what one tile of the screen gives: the first hits of its round, and counts of the work.
graph::Compiled Renderer::compileTile(FrameBuilder& frame) {
    tileHits_ = frame.tileHits();
    maxRounds_ = frame.maxRounds();
    for (const Hits& hits : tileHits_) {
        frame.request(hits);
        graph_->request(hits.order);
    }
    hasLayerStatistics_ = outputs_.layers.statistics.valid();
    hasEyeRays_ = false;
    if (hasLayerStatistics_) graph_->request(outputs_.layers.statistics);
    keptObjects_ = frame.releaseKeptObjects();
    warnings_ = frame.warnings();
    return graph_->compile();
}

std::string Renderer::whyNoEffect(const std::string& name) const {
    return whyNoEffect(name, compiled());
}

std::string Renderer::whyNoEffect(const std::string& name, const graph::Compiled& compiled) const {
    return kaustik::whyNoEffect({registry_, settings_.params, &needs_}, compiled.records, name);
}

// Only of passes that run: to ask for what others make would bring them back.
graph::Compiled Renderer::keepFindings(const graph::Compiled& compiled, const FrameBuilder& frame) {
    const auto keep = [&](const auto& findings, auto& kept) {
        for (const auto& finding : findings) {
            const bool runs = std::any_of(compiled.records.begin(), compiled.records.end(),
                                          [&](const graph::PassRecord& pass) {
                                              return pass.name == finding.pass &&
                                                     pass.state == graph::PassState::ran;
                                          });
            if (!runs) continue;
            kept.push_back(finding);
            for (const graph::ResourceRef& handle : finding.counted)
                graph_->request(handle);
        }
    };
    keep(frame.limits(), limits_);
    keep(frame.nodeWarnings(), nodeWarnings_);
    return graph_->compile();
}

// What says where light went that was stored off the screen, or that a filter has changed.
void Renderer::requestForMaps() {
    bool isAccounted = false;
    for (const FluxMap& map : outputs_.map.maps) {
        isAccounted = isAccounted || !map.on.views->isEyeView() || map.filtered.valid();
        if (map.filtered.valid()) graph_->request(map.filtered);
    }
    if (isAccounted) graph_->request(outputs_.eye.receiver);
    if (outputs_.cells.valid()) graph_->request(outputs_.cells);
}

void Renderer::requestForAudit() {
    const auto request = [this](const graph::ResourceRef& handle) {
        if (handle.valid()) graph_->request(handle);
    };
    for (const TraceRecord& trace : traces_) {
        for (const graph::ResourceRef& handle : texelsOf(trace.hits))
            request(handle);
        request(trace.before);
        request(trace.after);
    }
    request(outputs_.layers.depth);
    request(outputs_.eye.receiver);
    request(outputs_.shadows.visibility);
    requestExits();
}

void Renderer::requestExits() {
    const View& seen = outputs_.picture.view;
    graph_->request(seen.radiance);
    if (seen.exitPosition.valid()) graph_->request(seen.exitPosition);
    if (seen.exitDirection.valid()) graph_->request(seen.exitDirection);
}

void Renderer::build(Purpose purpose, const std::vector<std::string>& resources) {
    bindToAll(purpose);
    executor_.prepare(compile(purpose, resources));
    if (!startedFor_.insert(purpose).second) return;
    std::vector<gl::ProgramKey> keys;
    for (gl::UsedProgram& used : executor_.listPrograms())
        keys.push_back(std::move(used.key));
    programs_.start(keys);
}

bool Renderer::renderFrame(gl::PassTimer& timer,
                           const std::function<bool(std::size_t)>& shouldContinue) {
    return executor_.runFrame(timer, shouldContinue);
}

EnergyLedger Renderer::ledger() const {
    return ledger(closedLedger_);
}

EnergyLedger Renderer::ledger(const Ledger& handle) const {
    return readLedger(executor_.buffer(handle), ledgerQuantumWatts_);
}

std::vector<ReachedLimit> Renderer::reachedLimits() const {
    std::vector<ReachedLimit> all;
    for (const NodeLimit& limit : limits_) {
        const std::optional<ReachedLimit> reached =
            limit.inLedger ? limit.inLedger(ledger()) : limit.reached(executor_);
        if (!reached) continue;
        const auto same = std::find_if(all.begin(), all.end(), [&](const ReachedLimit& other) {
            return other.parameter == reached->parameter;
        });
        if (same == all.end()) {
            all.push_back(*reached);
        } else {
            *same = bothLimits(*same, *reached);
        }
    }
    return all;
}

std::vector<std::string> Renderer::foundWarnings() const {
    std::vector<std::string> all;
    for (const NodeWarning& warning : nodeWarnings_) {
        if (const std::optional<std::string> found = warning.found(executor_))
            all.push_back(*found);
    }
    return all;
}

transport::LayerStatistics Renderer::layerStatistics() const {
    if (!hasLayerStatistics_) return {};
    return executor_.buffer(outputs_.layers.statistics).read<transport::LayerStatistics>().front();
}

std::optional<EyeRays> Renderer::eyeRays() const {
    if (!hasEyeRays_) return std::nullopt;
    return countEyeRays(executor_.texture(outputs_.picture.view.ending));
}

const gl::Texture& Renderer::texture(const graph::ResourceRef& handle) const {
    return executor_.texture(handle);
}

const gl::Buffer& Renderer::buffer(const graph::ResourceRef& handle) const {
    return executor_.buffer(handle);
}

void Renderer::measureDepthComplexity() {
    const FrameBuilder frame = declareFrame();
    if (!outputs_.layers.statistics.valid()) return;
    hasLayerStatistics_ = true;
    graph_->request(outputs_.layers.statistics);
    executor_.prepare(graph_->compile());
    gl::PassTimer timer(gl::TimerMode::finish);
    executor_.runFrame(timer);
    needs_.measuredDepthComplexity = static_cast<int>(layerStatistics().complexity);
}

}  // namespace kaustik
