// SPDX-License-Identifier: MIT
#include "framework/app/truth.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "framework/app/output.h"
#include "framework/core/error.h"

#ifdef KAUSTIK_HAS_EMBREE
#include "framework/app/reference_work.h"
#include "framework/audit/hit_audit.h"
#include "framework/measure/heat_map.h"
#include "framework/measure/image_errors.h"
#endif

namespace kaustik::app {
namespace fs = std::filesystem;

#ifndef KAUSTIK_HAS_EMBREE

struct Truth::Loaded {};
Truth::Truth(const std::string& wanted, std::uint64_t, const Renderer&) {
    if (wanted != "none") {
        throw ConfigError("--reference: this program was built without Embree and knows no truth.");
    }
}
Truth::~Truth() = default;
Purpose Truth::purpose() const {
    return Purpose::measurement;
}
std::vector<fs::path> Truth::judge(const Renderer&, const fs::path&, report::RunRecord&) const {
    return {};
}

#else

namespace {

using nlohmann::json;
using reference::Reference;
using reference::ReferenceRequest;

Reference readFor(const std::string& file, const Renderer& renderer) {
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
    if (found.key != referenceKey(renderer.scene(), request)) {
        throw ConfigError(fmt::format(
            "--reference: {} is of another scene ('{}') or of this one as it was at another time "
            "or before a change; 'kaustik reference {}' makes one that fits.",
            file, found.scene, renderer.scene().name));
    }
    return found;
}

ReferenceRequest requestFor(const Renderer& renderer) {
    ReferenceRequest request;
    request.width = renderer.settings().width;
    request.height = renderer.settings().height;
    return request;
}

// What the frame is judged by, read back once.
struct Output {
    Image irradiance;
    Image receiver;  // view depth, not positive where there is none
    Image area;      // m²
};

Output readOutput(const Renderer& renderer) {
    const FrameOutputs& outputs = renderer.outputs();
    Output output;
    output.irradiance = readTexture(renderer.texture(outputs.caustic.irradiance), 0, 3);
    const Image receiver = readTexture(renderer.texture(outputs.eye.receiver), 0, 2);
    output.receiver = Image(receiver.width, receiver.height, 1);
    output.area = Image(receiver.width, receiver.height, 1);
    for (std::size_t i = 0; i < output.area.values.size(); ++i) {
        const bool sees = receiver.values[2 * i] > 0.0f;
        output.receiver.values[i] = sees ? 1.0f : 0.0f;
        output.area.values[i] = sees ? receiver.values[2 * i + 1] : 0.0f;
    }
    return output;
}

measure::ImagePair pairOf(const Output& output, const Reference& truth) {
    return measure::ImagePair({.image = output.irradiance,
                               .reference = truth.irradiance,
                               .mask = &output.receiver,
                               .standardError = &truth.irradianceError,
                               .area = &output.area,
                               .imageName = "The caustic irradiance"});
}

json errorJson(const measure::ImageErrors& errors, const Reference& truth) {
    return {{"reference_stderr", errors.truthNoise ? errors.truthNoise->rmse : 0.0},
            {"reference_relative_stderr", truth.relativeError},
            {"reference_photons", truth.photons},
            {"reference_key", truth.key},
            {"caustic_irradiance", measure::toJson(errors)}};
}

bool seesReceivers(const Output& output) {
    for (const float sees : output.receiver.values) {
        if (sees > 0.0f) return true;
    }
    return false;
}

}  // namespace

struct Truth::Loaded {
    explicit Loaded(const scene::Scene& of) : scene(of) {}
    std::string name;
    reference::EmbreeScene scene;
    Reference whole;
    std::optional<Reference> modelled;  // only the paths that the technique claims to model
    ModelledPaths paths;
};

Truth::Truth(const std::string& wanted, std::uint64_t photons, const Renderer& renderer) {
    if (wanted == "none") return;
    std::optional<Reference> fromFile;
    if (wanted != "auto") fromFile = readFor(wanted, renderer);
    loaded_ = std::make_unique<Loaded>(renderer.scene());
    loaded_->name = wanted;
    if (fromFile) {
        loaded_->whole = std::move(*fromFile);
        return;
    }
    reference::RunOptions options;
    options.stop.photons = photons;
    ReferenceRequest request = requestFor(renderer);
    loaded_->whole = obtainReference(loaded_->scene, request, options);
    loaded_->paths = renderer.outputs().hits.incoming.paths;
    if (loaded_->paths.interactions == 0) return;  // nothing is modelled: there is no caustic
    request.filter.transmissionOnly = loaded_->paths.transmissionOnly;
    request.filter.maximumInteractions = loaded_->paths.interactions;
    loaded_->modelled = obtainReference(loaded_->scene, request, options);
}

Truth::~Truth() = default;

Purpose Truth::purpose() const {
    return loaded_ ? Purpose::audit : Purpose::measurement;
}

std::vector<fs::path> Truth::judge(const Renderer& renderer, const fs::path& folder,
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
    write("hits" + displayImageExtension(),
          audit::wrongPhotonsPicture(
              hits, readTexture(renderer.texture(renderer.outputs().picture.display), 0, 3)));
    write("reference" + floatImageExtension(), loaded_->whole.irradiance);

    const Output output = readOutput(renderer);
    record.error = {{"reference", loaded_->name}};
    if (!seesReceivers(output)) {
        record.error["caustic_irradiance"] = nullptr;
        record.error["reason"] = "no pixel of this view sees a receiver";
        return files;
    }
    const measure::ImagePair pair = pairOf(output, loaded_->whole);
    const measure::ImageErrors errors = measure::measureErrors(pair);
    record.error.update(errorJson(errors, loaded_->whole));
    const measure::Plane<float> differences = measure::absoluteErrorPlane(pair);
    write("error" + displayImageExtension(),
          measure::heatMap(pair, differences, measure::heatMapScale(errors, differences)));
    if (loaded_->modelled) {
        json modelled = errorJson(measure::measureErrors(pairOf(output, *loaded_->modelled)),
                                  *loaded_->modelled);
        modelled["transmission_only"] = loaded_->paths.transmissionOnly;
        modelled["maximum_interactions"] = loaded_->paths.interactions;
        record.error["modelled_paths"] = std::move(modelled);
    }
    return files;
}

#endif

}  // namespace kaustik::app
