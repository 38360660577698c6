// SPDX-License-Identifier: MIT
// A certificate: for each pixel an interval that holds the caustic irradiance of the paths that
// were asked for, W/m², and for the whole scene one of the watts that they bring to receivers.
//
// What is certified is the quantity that the reference estimates (reference/light_tracing.h): the
// mean over a pixel's area of the irradiance on the first receiver on the straight eye ray, of
// light that has met 1 to `interactions` specular surfaces, from the side that the eye sees; of the
// geometry that geometry.h says. Computed in parts that merge exactly.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/certify/beams.h"
#include "framework/core/shard.h"
#include "framework/image/image.h"
#include "framework/scene/scene.h"

namespace kaustik::certify {

struct CertificateRequest {
    int width = 800;
    int height = 600;
    BeamSettings beams;
};

struct Certificate {
    std::string key;
    std::string scene;
    CertificateRequest request;
    Image lower;      // RGB, W/m², rounded down
    Image upper;      // rounded up
    Image undecided;  // what of `upper` is light that may lie in any of many pixels
    Totals totals;    // W
    std::uint64_t cells = 0;
    double seconds = 0.0;
};

// How tight the intervals are. A pixel is lit where its upper bound is above a thousandth of the
// picture's mean of positive lower bounds, and undecided where it is lit and its interval wider
// than a fifth of its upper bound. Sums of channels.
struct Tightness {
    std::size_t pixels = 0;
    std::size_t lit = 0;
    std::size_t undecided = 0;
    double medianWidth = 0.0;  // of lit pixels: width over the middle
    double p95Width = 0.0;
    double totalWidth = 0.0;  // of the deposited watts: width over the middle
};
// W/m², a sum of channels: above it a pixel's upper bound is light, and not what rounding leaves.
[[nodiscard]] double litAbove(const Certificate& certificate);
[[nodiscard]] Tightness tightnessOf(const Certificate& certificate);

// Names all that the result depends on.
[[nodiscard]] std::string certificateKey(const scene::Scene& scene,
                                         const CertificateRequest& request);

// What one shard has done by now: a file that says all about itself.
struct CertificatePart {
    std::string key;
    std::string scene;
    CertificateRequest request;
    Shard shard;
    std::uint64_t blocks = 0;      // that the shard has
    std::uint64_t blocksDone = 0;  // the first ones
    std::size_t facets = 0;
    double irradianceScale = 1.0;
    double wattScale = 1.0;
    double seconds = 0.0;
    BoundSums sums;
    [[nodiscard]] bool isWhole() const { return blocksDone == blocks; }
};
void writePart(const std::filesystem::path& file, const CertificatePart& part);
// Throws IoError that names the file where it is missing, damaged or something else.
[[nodiscard]] CertificatePart readPart(const std::filesystem::path& file);

struct CertifyOptions {
    int threads = 0;  // 0: all
    Shard shard;
    std::filesystem::path keep;  // where an unfinished part is, and is left; empty: nowhere
    std::function<bool(double share, std::uint64_t cells)> progress;  // false: stop
    PlantedError planted;                                             // for tests
};
// Computes a part, or goes on with the one in `keep`. Not whole where `progress` has said stop.
// Throws ConfigError for what of a scene cannot be certified.
[[nodiscard]] CertificatePart certifyPart(const scene::Scene& scene,
                                          const CertificateRequest& request,
                                          const CertifyOptions& options);

// The sum of all parts. Throws ConfigError where they do not belong together, or one is missing or
// unfinished. `scene` is the one that they are of.
[[nodiscard]] Certificate makeCertificate(const scene::Scene& scene,
                                          const std::vector<CertificatePart>& parts);

// NAME.lower.exr, NAME.upper.exr and NAME.undecided.exr (or .pfm), and NAME.json, which is written
// last, with fingerprints of them.
void writeCertificate(const std::filesystem::path& path, const Certificate& certificate);
// Throws IoError for what is missing or damaged, ConfigError where `expectedKey` is not empty and
// another's.
[[nodiscard]] Certificate readCertificate(const std::filesystem::path& path,
                                          const std::string& expectedKey = "");

// Everything of it but the pictures.
[[nodiscard]] nlohmann::json toJson(const Certificate& certificate);

}  // namespace kaustik::certify
