// SPDX-License-Identifier: MIT
#include "framework/reference/reference.h"

#include <algorithm>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/reference/content_hash.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/photon_mapping.h"

namespace kaustik::reference {
namespace {

// Goes up whenever the estimators give other numbers for the same request.
constexpr std::uint32_t kEstimatorVersion = 2;

LightTraceSettings lightSettings(const ReferenceRequest& request) {
    return {request.width, request.height, request.photonsPerBatch, request.seed, request.filter};
}

PhotonMappingSettings mappingSettings(const ReferenceRequest& request) {
    return {request.width, request.height,     request.photonsPerBatch,
            request.seed,  request.filter,     request.initialRadiusPixels,
            request.alpha, request.causticView};
}

// Field by field: structs may have padding.
void addScene(ContentHash& hash, const scene::Scene& scene) {
    const scene::Camera& camera = scene.camera;
    hash.add(camera.position).add(camera.target).add(camera.up);
    hash.add(camera.verticalFovDegrees).add(camera.nearMeters);
    hash.add(scene.lights.size());
    for (const scene::Light& light : scene.lights) {
        hash.add(light.kind).add(light.position).add(light.direction).add(light.power);
        hash.add(light.innerConeRadians).add(light.outerConeRadians).add(light.rangeMeters);
        hash.add(light.image).add(light.up);
    }
    hash.add(scene.materials.size());
    for (const scene::Material& material : scene.materials) {
        hash.add(material.kind).add(material.albedo).add(material.pattern);
        hash.add(material.patternAlbedo).add(material.uvScale).add(material.image);
        hash.add(material.ior).add(material.absorptionPerMeter);
        hash.add(material.specular).add(material.exponent);
    }
    hash.add(scene.images.size());
    for (const scene::TextureImage& image : scene.images) {
        hash.addBytes(image.file.empty() ? image.bytes : readFile(image.file));
        hash.add(static_cast<std::uint8_t>(image.srgb));
    }
    hash.add(scene.meshes.size());
    for (const scene::Mesh& mesh : scene.meshes) {
        hash.add(mesh.origin).add(static_cast<std::uint8_t>(mesh.closed));
        hash.addAll(mesh.positions).addAll(mesh.normals).addAll(mesh.uvs).addAll(mesh.triangles);
    }
    hash.add(scene.objects.size());
    for (const scene::Object& object : scene.objects)
        hash.add(object.mesh).add(object.material).add(object.toWorld);
    hash.add(static_cast<std::uint8_t>(scene.medium.has_value()));
    if (scene.medium) {
        hash.add(scene.medium->scatteringPerMeter).add(scene.medium->absorptionPerMeter);
        hash.add(scene.medium->anisotropy);
    }
}

}  // namespace

std::string referenceKey(const scene::Scene& scene, const ReferenceRequest& request) {
    ContentHash hash;
    hash.addBytes("kaustik.reference").add(kEstimatorVersion);
    addScene(hash, scene);
    hash.add(request.estimator).add(request.width).add(request.height);
    hash.add(request.seed).add(request.photonsPerBatch);
    hash.add(static_cast<std::uint8_t>(request.filter.transmissionOnly));
    hash.add(request.filter.maximumInteractions).add(request.filter.splitInteractions);
    if (request.estimator == Estimator::sppm)
        hash.add(request.initialRadiusPixels).add(request.alpha).add(request.causticView);
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
        .causticViewLayer = isMapped ? viewedCausticsLayer(scene, mappingSettings(request)) : -1};
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
