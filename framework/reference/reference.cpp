// SPDX-License-Identifier: MIT
#include "framework/reference/reference.h"

#include <algorithm>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/reference/class_file.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/photon_mapping.h"
#include "framework/scene/scene_hash.h"

namespace kaustik::reference {
namespace {

// Goes up whenever the estimators give other numbers for the same request.
constexpr std::uint32_t kEstimatorVersion = 2;

LightTraceSettings lightSettings(const ReferenceRequest& request) {
    return {request.width, request.height, request.photonsPerBatch,
            request.seed,  request.filter, request.classes};
}

PhotonMappingSettings mappingSettings(const ReferenceRequest& request) {
    return {request.width, request.height,     request.photonsPerBatch,
            request.seed,  request.filter,     request.initialRadiusPixels,
            request.alpha, request.causticView};
}

}  // namespace

std::string referenceKey(const scene::Scene& scene, const ReferenceRequest& request) {
    ContentHash hash;
    hash.addBytes("kaustik.reference").add(kEstimatorVersion);
    scene::addTo(hash, scene);
    hash.add(request.estimator).add(request.width).add(request.height);
    hash.add(request.seed).add(request.photonsPerBatch);
    hash.add(static_cast<std::uint8_t>(request.filter.transmissionOnly ? 1
                                       : request.filter.reflectionOnly ? 2
                                                                       : 0));
    hash.add(request.filter.maximumInteractions).add(request.filter.splitInteractions);
    if (request.estimator == Estimator::sppm)
        hash.add(request.initialRadiusPixels).add(request.alpha).add(request.causticView);
    for (const PathClass& one : request.classes)
        hash.addBytes("class").addBytes(one.name).addBytes(one.pattern);
    return hash.hex();
}

PixelSums makeSums(const EmbreeScene& scene, const ReferenceRequest& request) {
    return request.estimator == Estimator::light
               ? makeLightTraceSums(scene, lightSettings(request))
               : makePhotonMappingSums(scene, mappingSettings(request));
}

void addBatches(const EmbreeScene& scene, const ReferenceRequest& request,
                const RunOptions& options, PixelSums& sums) {
    if (request.estimator == Estimator::light) {
        lightTrace(scene, lightSettings(request), options, sums);
    } else {
        photonMapping(scene, mappingSettings(request), options, sums);
    }
}

Subject subjectOf(const scene::Scene& scene, const ReferenceRequest& request) {
    const bool isMapped = request.estimator == Estimator::sppm;
    const int radianceLayer = causticRadianceLayer(scene);
    return {
        .key = referenceKey(scene, request),
        .scene = scene.name,
        .request = request,
        .inScatteredLayer = isMapped ? -1 : inScatteredLayer(scene),
        .causticRadianceLayer =
            isMapped && radianceLayer > 0 ? kMappedRadianceLayer : radianceLayer,
        .causticViewLayer = isMapped ? viewedCausticsLayer(scene, mappingSettings(request)) : -1,
        .firstClassLayer = request.classes.empty() ? -1 : firstClassLayer(scene)};
}

Reference makeReference(const Subject& subject, const PixelSums& sums, double seconds) {
    if (sums.batchCount() < 2) {
        throw ConfigError(
            "A reference needs at least two batches, or its error is unknown; let it run longer.");
    }
    Reference reference;
    reference.key = subject.key;
    reference.scene = subject.scene;
    reference.request = subject.request;
    const auto fill = [&](int layer, Image& mean, Image& error) {
        if (layer < 0 || layer >= sums.layers()) return;
        mean = sums.meanImage(layer);
        error = sums.standardErrorImage(layer);
    };
    fill(kIrradianceLayer, reference.irradiance, reference.irradianceError);
    fill(subject.inScatteredLayer, reference.inScattered, reference.inScatteredError);
    fill(subject.causticRadianceLayer, reference.causticRadiance, reference.causticRadianceError);
    fill(subject.causticViewLayer, reference.causticView, reference.causticViewError);
    if (subject.firstClassLayer > 0)
        reference.classes = classImages(subject.request.classes, sums, subject.firstClassLayer);
    reference.energy = sums.energy();
    reference.photons = sums.photons();
    reference.batches = sums.batchCount();
    reference.rejectedValues = sums.rejectedValues();
    reference.relativeError = sums.relativeStandardError(kIrradianceLayer);
    reference.seconds = seconds;
    return reference;
}

Reference makeReference(const scene::Scene& scene, const ReferenceRequest& request,
                        const PixelSums& sums, double seconds) {
    return makeReference(subjectOf(scene, request), sums, seconds);
}

std::uint64_t batchesFor(const EmbreeScene& scene, const ReferenceRequest& request,
                         std::uint64_t photons) {
    const std::uint64_t each = LightSampler(scene, request.photonsPerBatch).photonsPerBatch();
    if (each == 0) return 2;  // nothing is sent out, however often
    return std::max<std::uint64_t>(2, photons / each + (photons % each == 0 ? 0 : 1));
}

}  // namespace kaustik::reference
