// SPDX-License-Identifier: MIT
#include "tests/mixtures/bench.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <optional>

#include "framework/report/limits.h"
#include "framework/report/loss_advice.h"
#include "framework/report/map_account.h"
#include "framework/run/output.h"
#include "framework/run/reference_work.h"
#include "framework/scene/files/scene_file.h"
#include "framework/transport/watts.h"
#include "tests/mixtures/varied_scene.h"

namespace kaustik::mixtures {
namespace {

// Renderers that are kept, and after how many frames one is made anew: programs add up.
constexpr std::size_t kStations = 4;
constexpr int kBuilds = 40;
constexpr std::uint64_t kReferencePhotons = 1u << 19;

Settings settingsOf(const Mixture& mixture, const Variation& variation) {
    Settings settings = mixture.settings;
    if (variation.scale != 1.0) {
        for (const params::NamedField& parameter : paramsOf(mixture).all()) {
            if (parameter.field.unit != "m") continue;
            const double meters = std::stod(parameter.field.text());
            if (meters != 0.0) {
                settings.emplace_back(parameter.fullName,
                                      fmt::format("{:.9g}", meters * variation.scale));
            }
        }
    }
    settings.insert(settings.end(), variation.settings.begin(), variation.settings.end());
    return settings;
}

// W, the mean of the channels, of the first layer of each view.
double wattsOf(const std::vector<float>& texels, std::size_t texelsALayer, int views,
               int layersAView) {
    double sum = 0.0;
    for (int view = 0; view < views; ++view) {
        const std::size_t begin = 4 * texelsALayer * static_cast<std::size_t>(view * layersAView);
        for (std::size_t i = begin; i < begin + 4 * texelsALayer; i += 4) {
            for (std::size_t c = 0; c < 3; ++c)
                sum += static_cast<double>(texels[i + c]);
        }
    }
    return sum / 3.0;
}

std::optional<double> filteredWattsOf(const Renderer& renderer) {
    std::optional<double> watts;
    for (const FluxMap& map : renderer.outputs().map.maps) {
        if (map.cascade > 0) continue;
        if (!map.filtered.valid()) return {};
        const gl::Texture& texture = renderer.texture(map.filtered);
        const auto texels = static_cast<std::size_t>(texture.desc().width) *
                            static_cast<std::size_t>(texture.desc().height);
        watts = watts.value_or(0.0) +
                wattsOf(texture.read(), texels, map.on.views->count(), map.filteredPerView());
    }
    return watts;
}

double shownWattsOf(const run::Outputs& outputs) {
    const std::vector<float>& irradiance = outputs.images.front().image.values;
    double watts = 0.0;
    for (std::size_t pixel = 0; pixel < outputs.area.values.size(); ++pixel) {
        for (std::size_t c = 0; c < 3; ++c) {
            watts += static_cast<double>(outputs.area.values[pixel]) *
                     static_cast<double>(irradiance[3 * pixel + c]);
        }
    }
    return watts / 3.0;
}

// What is to be kept where everything is: all textures, and the lists that say how much of some of
// them means anything. The longest rows of the tracer of lines hold what nobody reads.
std::vector<std::string> everything(const Renderer& renderer) {
    std::vector<std::string> names = numerics::textureNames(renderer);
    for (const std::string& name : renderer.graph().resourceNames()) {
        if (name.starts_with("photons.list")) names.push_back(name);
    }
    return names;
}

Shot shotOf(const Renderer& renderer, bool keptAll) {
    Shot shot;
    shot.outputs = run::readOutputs(renderer);
    shot.picture = run::readTexture(renderer.texture(renderer.outputs().picture.radiance), 0, 3);
    shot.display = run::readTexture(renderer.texture(renderer.outputs().picture.display), 0, 3);
    shot.ledger = renderer.ledger();
    if (shot.ledger.events[transport::kAccountEmittable] > 0)
        shot.ledger.judgeEmission(shot.ledger.watts[transport::kAccountEmittable]);
    shot.warnings = renderer.warnings();
    for (std::string& warning : renderer.foundWarnings())
        shot.warnings.push_back(std::move(warning));
    if (auto warning = report::mapWarning(report::mapAccount(renderer),
                                          renderer.settings().params.choice(FilterStage::name)))
        shot.warnings.push_back(std::move(*warning));
    for (std::string& advice : report::lossAdvice(shot.ledger, renderer))
        shot.warnings.push_back(std::move(advice));
    report::RunRecord record;
    record.ledger = shot.ledger;
    record.layers = renderer.layerStatistics();
    record.layersAllowed = renderer.outputs().layers.layers;
    record.nodeLimits = renderer.reachedLimits();
    record.photonsEnd = renderer.outputs().hits.incoming.paths.end;
    shot.limits = report::reachedLimits(record, renderer);
    shot.paths = renderer.outputs().hits.incoming.paths;
    shot.shownWatts = shownWattsOf(shot.outputs);
    shot.filteredWatts = filteredWattsOf(renderer);
    const std::vector<FluxMap>& maps = renderer.outputs().map.maps;
    shot.isStoredOnScreen = !maps.empty() && maps.front().on.views->isEyeView();
    for (const params::NamedField& parameter : renderer.settings().params.all()) {
        if (!renderer.whyNoEffect(parameter.fullName).empty()) shot.idle.insert(parameter.fullName);
    }
    if (!keptAll) return shot;
    for (const std::string& name : numerics::textureNames(renderer)) {
        if (name.starts_with("trace.rows_")) continue;
        if (numerics::countNotFinite(renderer, name) > 0) shot.notFinite.push_back(name);
    }
    return shot;
}

}  // namespace

const scene::Scene& Bench::sceneOf(const std::string& name) {
    static std::map<std::string, scene::Scene> scenes;
    const auto found = scenes.find(name);
    if (found != scenes.end()) return found->second;
    const std::filesystem::path folder = KAUSTIK_MIXTURE_SCENES;
    return scenes.emplace(name, scene::loadSceneFile(folder / (name + ".toml"))).first->second;
}

// One of a memory of earlier frames begins with none.
Renderer& Bench::rendererOf(const Mixture& mixture, const Variation& variation,
                            RenderSettings settings) {
    const std::string key = fmt::format("{} {} {} {} {}", mixture.scene, variation.scale,
                                        variation.turnDegrees, variation.light, variation.order);
    const auto found = std::find_if(stations_.begin(), stations_.end(),
                                    [&](const Station& station) { return station.key == key; });
    const bool remembers = settings.params.choice(TemporalStage::name) != "none";
    if (found != stations_.end() && !remembers && found->builds < kBuilds) {
        stations_.splice(stations_.begin(), stations_, found);
        stations_.front().renderer->update(std::move(settings));
    } else {
        if (found != stations_.end()) stations_.erase(found);
        Station station{key,
                        std::make_unique<scene::Scene>(varied(sceneOf(mixture.scene), variation)),
                        nullptr};
        station.renderer =
            std::make_unique<Renderer>(context_, registry(), *station.scene, std::move(settings));
        stations_.push_front(std::move(station));
        if (stations_.size() > kStations) stations_.pop_back();
    }
    ++stations_.front().builds;
    return *stations_.front().renderer;
}

Shot Bench::render(const Mixture& mixture, const Variation& variation) {
    if (isFresh_) stations_.clear();
    ++renders_;
    RenderSettings settings;
    settings.technique = registry().findTechnique(mixture.technique);
    settings.params = registry().makeParams(settings.technique);
    for (const auto& [name, value] : settingsOf(mixture, variation))
        settings.params.set(name, value, "--set");
    settings.width = kWidth;
    settings.height = kHeight;
    try {
        Renderer& renderer = rendererOf(mixture, variation, std::move(settings));
        std::vector<std::string> kept = {"eye.receiver"};
        if (variation.keepsAll) {
            static_cast<void>(renderer.compile(Purpose::measurement));
            kept = everything(renderer);
        }
        renderer.build(Purpose::measurement, kept);
        renderer.executor().poisonTransients(variation.poison);
        gl::PassTimer timer(gl::TimerMode::finish);
        std::optional<tbb::global_control> threads;
        if (variation.threads > 0) {
            threads.emplace(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(variation.threads));
        }
        renderer.renderFrame(timer);
        return shotOf(renderer, variation.keepsAll);
    } catch (...) {
        // Who knows what it has left.
        if (!stations_.empty()) stations_.pop_front();
        throw;
    }
}

Shot Bench::renderFresh(const Mixture& mixture, const Variation& variation) {
    const bool before = isFresh_;
    isFresh_ = true;
    Shot shot = render(mixture, variation);
    isFresh_ = before;
    return shot;
}

const reference::Reference& Bench::referenceOf(const std::string& scene,
                                               const ModelledPaths& paths) {
    const std::string key = fmt::format("{} {} {} {}", scene, paths.transmissionOnly,
                                        paths.reflectionOnly, paths.interactions);
    const auto found = references_.find(key);
    if (found != references_.end()) return found->second;
    reference::ReferenceRequest request;
    request.width = kWidth;
    request.height = kHeight;
    request.photonsPerBatch = kReferencePhotons / 8;
    request.filter = run::modelledFilter(request.filter, paths);
    const reference::EmbreeScene embree(sceneOf(scene));
    reference::RunOptions options;
    options.stop.photons = kReferencePhotons;
    reference::PixelSums sums = makeSums(embree, request);
    addBatches(embree, request, options, sums);
    return references_.emplace(key, makeReference(embree.scene(), request, sums, 0.0))
        .first->second;
}

}  // namespace kaustik::mixtures
