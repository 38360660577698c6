// SPDX-License-Identifier: MIT
#include "framework/run/run_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "framework/core/error.h"
#include "framework/run/caustic_errors.h"
#include "framework/run/output.h"

#ifdef KAUSTIK_HAS_EMBREE
#include "framework/audit/hit_audit.h"
#include "framework/audit/shadow_audit.h"
#include "framework/audit/view_audit.h"
#include "framework/measure/bias.h"
#include "framework/measure/image_errors.h"
#include "framework/run/reference_work.h"
#include "framework/scene/shapes/height_field.h"
#endif

namespace kaustik::run {
namespace fs = std::filesystem;

#ifndef KAUSTIK_HAS_EMBREE

struct RunReference::Loaded {};
RunReference::RunReference(const std::string& wanted, std::uint64_t, const Renderer&,
                           const Watch&) {
    if (wanted != "none") {
        throw ConfigError(
            "--reference: this program was built without Embree and knows no reference.");
    }
}
Purpose RunReference::purpose() const {
    return Purpose::measurement;
}
void RunReference::watchFlicker(std::optional<double>, const Renderer&) {}
void RunReference::recordMoment(const Renderer&) {}
std::vector<fs::path> RunReference::judge(const Renderer&, const fs::path&,
                                          report::RunRecord&) const {
    return {};
}
std::vector<fs::path> RunReference::judgeView(Renderer&, const fs::path&,
                                              report::RunRecord&) const {
    return {};
}

#else

namespace {

using nlohmann::json;
using reference::Reference;
using reference::ReferenceRequest;

Reference readMatching(const std::string& file, const Renderer& renderer) {
    Reference found = reference::readReference(file);
    const ReferenceRequest& request = found.request;
    const RenderSettings& settings = renderer.settings();
    if (request.width != settings.width || request.height != settings.height) {
        throw ConfigError(
            fmt::format("--reference: {} has {}x{} pixels and this run {}x{}; use "
                        "--size {}x{} or another reference.",
                        file, request.width, request.height, settings.width, settings.height,
                        request.width, request.height));
    }
    const scene::Scene& scene = renderer.scene();
    if (found.key != referenceKey(scene, request)) {
        throw ConfigError(fmt::format(
            "--reference: {} is of another scene ('{}') or of this one as it was at another time "
            "or before a change; 'kaustik reference {} --size {}x{} --time {}' makes one that "
            "fits.",
            file, found.scene, scene.file.string(), settings.width, settings.height,
            scene.timeSeconds));
    }
    const reference::PathFilter all;
    if (request.filter.transmissionOnly || request.filter.reflectionOnly ||
        request.filter.maximumInteractions < all.maximumInteractions) {
        throw ConfigError(fmt::format(
            "--reference: {} follows only a part of the paths of light; a run is judged "
            "by all of them, and with 'auto' also by those that it models.",
            file));
    }
    return found;
}

ReferenceRequest requestFor(const Renderer& renderer) {
    ReferenceRequest request;
    request.width = renderer.settings().width;
    request.height = renderer.settings().height;
    return request;
}

}  // namespace

struct RunReference::Loaded {
    // What the flicker is told by.
    struct Flicker {
        std::string obstacle;  // "" where it can be told
        Reference earlier;     // `whole` is the later one
        std::vector<Moment> moments;
    };
    explicit Loaded(const scene::Scene& of) : scene(of) {}
    std::string name;
    reference::EmbreeScene scene;
    Reference whole;
    std::optional<Reference> modelled;  // only the paths that the technique claims to model
    ModelledPaths paths;
    reference::RunOptions options;
    Watch watch;
    std::optional<Flicker> flicker;

    [[nodiscard]] Reference obtain(const reference::EmbreeScene& of,
                                   const ReferenceRequest& request) const {
        return watch.shouldContinue ? obtainReference(of, request, options, watch)
                                    : obtainReference(of, request, options);
    }
};

RunReference::RunReference(const std::string& wanted, std::uint64_t photons,
                           const Renderer& renderer, const Watch& watch) {
    if (wanted == "none") return;
    std::optional<Reference> fromFile;
    if (wanted != "auto") fromFile = readMatching(wanted, renderer);
    loaded_ = std::make_unique<Loaded>(renderer.scene());
    loaded_->name = wanted;
    loaded_->options.stop.photons = photons;
    loaded_->watch = watch;
    if (fromFile) {
        loaded_->whole = std::move(*fromFile);
        return;
    }
    ReferenceRequest request = requestFor(renderer);
    loaded_->whole = loaded_->obtain(loaded_->scene, request);
    loaded_->paths = renderer.outputs().hits.incoming.paths;
    if (loaded_->paths.interactions == 0) return;  // nothing is modelled: there is no caustic
    request.filter = modelledFilter(request.filter, loaded_->paths);
    loaded_->modelled = loaded_->obtain(loaded_->scene, request);
}

Purpose RunReference::purpose() const {
    return loaded_ ? Purpose::audit : Purpose::measurement;
}

void RunReference::watchFlicker(std::optional<double> earlierSeconds, const Renderer& renderer) {
    if (!loaded_) return;
    Loaded::Flicker& flicker = loaded_->flicker.emplace();
    if (!earlierSeconds) {
        flicker.obstacle = "all frames are of one time; --frames 2 or more have two";
        return;
    }
    if (loaded_->name != "auto") {
        flicker.obstacle =
            "a reference from a file is of one time; --reference auto makes those of both";
        return;
    }
    scene::Scene scene = renderer.scene();
    scene::setTime(scene, *earlierSeconds);
    ReferenceRequest request = requestFor(renderer);
    // With one seed for both, photons that fall alike would give both the same noise, and how
    // much of it is not known.
    ++request.seed;
    flicker.earlier = loaded_->obtain(reference::EmbreeScene(scene), request);
}

void RunReference::recordMoment(const Renderer& renderer) {
    if (!loaded_ || !loaded_->flicker || !loaded_->flicker->obstacle.empty()) return;
    std::vector<Moment>& moments = loaded_->flicker->moments;
    if (moments.size() == 2) moments.erase(moments.begin());
    moments.push_back({renderer.scene().timeSeconds,
                       readTexture(renderer.texture(renderer.outputs().caustic.irradiance), 0, 3)});
}

std::vector<fs::path> RunReference::judge(const Renderer& renderer, const fs::path& folder,
                                          report::RunRecord& record) const {
    if (!loaded_) return {};
    std::vector<fs::path> files;
    const auto write = [&](const std::string& name, const Image& image) {
        files.push_back(folder / name);
        writeImage(files.back(), image);
    };
    const audit::HitAudit hits = audit::auditHits(renderer, loaded_->scene);
    record.ledger = audit::resolveLedger(renderer, hits,
                                         loaded_->whole.energy.watts[transport::kAccountEmitted]);
    record.hits = audit::toJson(hits);
    // Few are those whose bodies a pixel, or a texel, does not resolve.
    const double through = static_cast<double>(hits.throughSpecular) /
                           std::max(static_cast<double>(hits.photons), 1.0);
    if (through > 0.01) {
        record.warnings.push_back(fmt::format(
            "{} of {} photons, {:.2g}%, went straight through a further specular surface, which "
            "trace={} did not find; trace=raytraced does.",
            hits.throughSpecular, hits.photons, 100.0 * through,
            renderer.settings().params.choice(TraceStage::name)));
    }
    write("hits" + displayImageExtension(),
          audit::wrongPhotonsPicture(
              hits, readTexture(renderer.texture(renderer.outputs().picture.display), 0, 3),
              renderer.samplesPerSide()));
    write("reference" + floatImageExtension(), loaded_->whole.irradiance);
    if (!loaded_->whole.inScattered.values.empty())
        write("reference_in_scattered" + floatImageExtension(), loaded_->whole.inScattered);

    const Outputs outputs = readOutputs(renderer);
    record.error = {{"reference", loaded_->name}};
    record.error.update(errorsAgainst(outputs, loaded_->whole));
    if (!outputs.seesReceivers) {
        // Nothing is wrong with the picture: a caustic has nowhere to be seen.
    } else if (record.error.at("caustic_irradiance").is_null()) {
        record.warnings.push_back(record.error.at("reasons").at("caustic_irradiance"));
    } else {
        write("error" + displayImageExtension(),
              errorPicture(pairOf(outputs, outputs.images.front(), loaded_->whole)));
        // What the technique does not model is no bias of what it does.
        const Reference& own = loaded_->modelled ? *loaded_->modelled : loaded_->whole;
        const measure::ImagePair pair = pairOf(outputs, outputs.images.front(), own);
        record.error["bias"] = biasJson(pair, loaded_->modelled.has_value());
        write("bias" + displayImageExtension(), measure::biasPicture(pair));
    }
    if (loaded_->flicker) {
        const Loaded::Flicker& flicker = *loaded_->flicker;
        std::string obstacle = flicker.obstacle;
        record.error["flicker"] =
            obstacle.empty() ? flickerBetween(outputs, flicker.moments.at(0), flicker.moments.at(1),
                                              flicker.earlier, loaded_->whole, obstacle)
                             : json(nullptr);
        if (!obstacle.empty()) record.error["reasons"]["flicker"] = obstacle;
    }
    if (loaded_->modelled) {
        json modelled = errorsAgainst(outputs, *loaded_->modelled);
        modelled["transmission_only"] = loaded_->paths.transmissionOnly;
        modelled["reflection_only"] = loaded_->paths.reflectionOnly;
        modelled["maximum_interactions"] = loaded_->paths.interactions;
        record.error["modelled_paths"] = std::move(modelled);
    }
    const graph::ResourceRef& visibility = renderer.outputs().shadows.visibility;
    if (visibility.valid()) {
        audit::ShadowAudit shadows;
        const auto lights = static_cast<std::size_t>(renderer.needs().lights);
        for (std::size_t light = 0; light < lights; ++light) {
            shadows.add(audit::auditShadow(
                readTexture(renderer.texture(visibility), static_cast<int>(light), 1), light,
                loaded_->scene));
        }
        record.error["shadow"] = audit::toJson(shadows);
    }
    return files;
}

std::vector<fs::path> RunReference::judgeView(Renderer& renderer, const fs::path& folder,
                                              report::RunRecord& record) const {
    if (!loaded_ || renderer.needs().specularInterfaces == 0) return {};
    renderer.build(Purpose::view);
    gl::PassTimer untimed(gl::TimerMode::finish);
    renderer.renderFrame(untimed);
    reference::ViewReferenceRequest request;
    request.width = renderer.view().width;
    request.height = renderer.view().height;
    const reference::ViewReference reference = obtainView(loaded_->scene, request);
    json& error = record.error["view"];
    if (reference.pixels == 0) {
        error = nullptr;
        record.error["reasons"]["view"] = "no pixel of this view sees a specular surface";
        return {};
    }
    const View& seen = renderer.outputs().picture.view;
    if (seen.exitPosition.valid()) {
        const Image position = readTexture(renderer.texture(seen.exitPosition), 0, 4);
        const Image direction = readTexture(renderer.texture(seen.exitDirection), 0, 4);
        error = audit::toJson(audit::auditView(position, direction, reference, renderer.view()));
    } else {
        error["reasons"]["exit_direction_deg"] = "this node follows no rays";
    }
    if (renderer.needs().medium) {
        error["radiance"] = nullptr;
        error["reasons"]["radiance"] =
            "the reference of the view knows no medium that fills the scene";
        return {};
    }
    const Image radiance = readTexture(renderer.texture(seen.radiance), 0, 3);
    try {
        const measure::ImagePair pair({.image = radiance,
                                       .reference = reference.radiance,
                                       .mask = &reference.mask,
                                       .standardError = &reference.radianceError,
                                       .imageName = "the view's radiance"});
        error["radiance"] = measure::toJson(measureErrors(pair));
        const std::vector<fs::path> files = {folder / ("view_error" + displayImageExtension()),
                                             folder / ("view_reference" + floatImageExtension())};
        writeImage(files[0], errorPicture(pair));
        writeImage(files[1], reference.radiance);
        return files;
    } catch (const IoError& problem) {
        error["radiance"] = nullptr;
        error["reasons"]["radiance"] = problem.what();
        record.warnings.push_back(problem.what());
        return {};
    }
}

#endif

RunReference::~RunReference() = default;
RunReference::RunReference(RunReference&&) noexcept = default;
RunReference& RunReference::operator=(RunReference&&) noexcept = default;

}  // namespace kaustik::run
