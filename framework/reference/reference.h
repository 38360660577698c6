// SPDX-License-Identifier: MIT
// A finished reference: the caustic outputs with the standard error of every pixel, and all that
// says what they are. In memory, in files, and in a cache whose names are made of everything that
// the reference depends on. Units: W/m² (irradiance), W/m²/sr (in-scattered radiance), W.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "framework/reference/batches.h"
#include "framework/reference/embree_scene.h"
#include "framework/reference/energy.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/path_classes.h"
#include "framework/reference/pixel_sums.h"

namespace kaustik::reference {

enum class Estimator { light, sppm };

struct ReferenceRequest {
    Estimator estimator = Estimator::light;
    int width = 800;
    int height = 600;
    std::uint64_t seed = 1;
    std::uint64_t photonsPerBatch = 1u << 18;
    PathFilter filter;
    double initialRadiusPixels = 1.0;  // sppm
    double alpha = 0.7;                // sppm
    bool causticView = false;          // sppm: PhotonMappingSettings::followsView
    std::vector<PathClass> classes;    // light: of the irradiance, that are kept apart
};

struct Reference {
    std::string key;
    std::string scene;
    ReferenceRequest request;
    Image irradiance;
    Image irradianceError;  // standard error, the same unit
    Image causticRadiance;  // empty where no receiver is glossy
    Image causticRadianceError;
    Image causticView;  // as the eye sees it through specular surfaces; empty unless asked for
    Image causticViewError;
    std::vector<ClassImages> classes;  // of the request, and then `other`; else none
    Image inScattered;                 // empty without a medium that scatters, and for sppm
    Image inScatteredError;
    Energy energy;
    std::uint64_t photons = 0;
    std::uint64_t batches = 0;
    std::uint64_t rejectedValues = 0;
    double relativeError = 0.0;  // PixelSums::relativeStandardError of the irradiance
    double seconds = 0.0;        // of computing
};

// Names everything that the result depends on, but for how many batches it has: camera, lights,
// materials and their images, meshes as they are at Scene::timeSeconds, the medium, the request.
// Throws IoError for an image that cannot be read.
[[nodiscard]] std::string referenceKey(const scene::Scene& scene, const ReferenceRequest& request);

// Empty sums for a request, and more batches for them.
[[nodiscard]] PixelSums makeSums(const EmbreeScene& scene, const ReferenceRequest& request);
void addBatches(const EmbreeScene& scene, const ReferenceRequest& request,
                const RunOptions& options, PixelSums& sums);

// What sums are of, and which of their layers hold what: with it they become a reference without
// the scene.
struct Subject {
    std::string key;    // referenceKey
    std::string scene;  // name
    ReferenceRequest request;
    int inScatteredLayer = -1;  // -1: there is none
    int causticRadianceLayer = -1;
    int causticViewLayer = -1;
    int firstClassLayer = -1;  // of the request's classes, and then `other`
};
[[nodiscard]] Subject subjectOf(const scene::Scene& scene, const ReferenceRequest& request);

// What the sums have found. Throws ConfigError below two batches, of which no error can be told.
[[nodiscard]] Reference makeReference(const Subject& subject, const PixelSums& sums,
                                      double seconds);
[[nodiscard]] Reference makeReference(const scene::Scene& scene, const ReferenceRequest& request,
                                      const PixelSums& sums, double seconds);

// How many batches a reference of that many photons has, before any is computed: two at least.
[[nodiscard]] std::uint64_t batchesFor(const EmbreeScene& scene, const ReferenceRequest& request,
                                       std::uint64_t photons);

// NAME.exr (or .pfm) is the irradiance; next to it NAME.stderr.exr, NAME.caustic_radiance.exr and
// NAME.caustic_radiance.stderr.exr where a receiver is glossy, NAME.caustic_view.exr and
// NAME.caustic_view.stderr.exr where asked for, NAME.in_scattered.exr and
// NAME.in_scattered.stderr.exr where there is a medium, NAME.classes.exr where classes are kept
// apart (class_file.h), and NAME.json, which is written last and holds fingerprints of the others:
// a reference is there whole or not at all.
void writeReference(const std::filesystem::path& path, const Reference& reference);

// Throws IoError, naming the file, for a reference that is missing, cut off, mixed from two or not
// finite; and ConfigError when `expectedKey` is not empty and not its own.
[[nodiscard]] Reference readReference(const std::filesystem::path& path,
                                      const std::string& expectedKey = "");

// The reference that `cacheFolder` has, however good it is; nothing where there is none, or where
// it is damaged.
[[nodiscard]] std::optional<Reference> findCached(const scene::Scene& scene,
                                                  const ReferenceRequest& request,
                                                  const std::filesystem::path& cacheFolder);

// The reference from `cacheFolder` when one is there that is at least as good as `options.stop`
// asks for; else its sums are taken up where they were left, or begun, and cached. A damaged entry
// is reported in one sentence and replaced. Interrupted by `options.progress`, it keeps the sums
// for the next time and gives what it has; that is a ConfigError below two batches.
[[nodiscard]] Reference loadOrCompute(const EmbreeScene& scene, const ReferenceRequest& request,
                                      const std::filesystem::path& cacheFolder,
                                      const RunOptions& options,
                                      const std::function<void(const std::string&)>& report);

}  // namespace kaustik::reference
