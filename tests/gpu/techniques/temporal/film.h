// SPDX-License-Identifier: MIT
// Frames that follow each other, of irradiance that is known, for tests of filters over time.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/gpu/fixture.h"

namespace kaustik::test {

inline constexpr std::uint64_t kSeedOfNaN = 13;

// With gather.pattern, whose irradiance has a closed form (gather_pattern.frag) and needs no
// photon.
inline Registry registryWithPattern(const glm::dvec3& origin) {
    Registry registry = registerAll();
    registry.node<GatherStage>(
        "pattern", {"A closed form.", "a test", ""},
        std::function([origin](FrameBuilder& frame, const params::NoParams&, CausticMap map,
                               Surfaces surfaces) {
            return frame.pass<IrradianceMap>(
                "gather.pattern", "a test",
                [&](graph::PassSetup& setup, IrradianceMap& data) {
                    setup.sample("receiver", surfaces.eye.receiver);
                    setup.sample("receiverSurface", surfaces.eye.receiverSurface);
                    data.ledger = map.ledger;
                    data.irradiance = setup.create<IrradianceTexel>("caustic.irradiance",
                                                                    frame.width(), frame.height());
                    if (!frame.needs().glossyReceivers) return;
                    data.radiance = setup.create<RadianceTexel>("caustic.radiance", frame.width(),
                                                                frame.height());
                },
                [origin, &frameInputs = frame.inputs()](const IrradianceMap& data,
                                                        gl::PassContext& context) {
                    const scene::Camera& camera = frameInputs.gpuScene.scene().camera;
                    gl::Command command =
                        context.fullscreen("tests/gpu/shaders/gather_pattern.frag");
                    command.set("eyeFromOrigin", glm::vec3(camera.position - origin))
                        .set("seed", static_cast<unsigned>(frameInputs.seed))
                        .set("seedOfNaN", static_cast<unsigned>(kSeedOfNaN))
                        .target(data.irradiance);
                    if (data.radiance.valid()) command.define("HAS_RADIANCE").target(data.radiance);
                    command.draw();
                });
        }));
    return registry;
}

// Frames of a scene that the test moves, one after the other, of one renderer.
class Film {
  public:
    Film(scene::Scene scene, int width, int height, const Settings& settings,
         const glm::dvec3& origin = {})
        : scene_(std::move(scene)), registry_(registryWithPattern(origin)) {
        settings_.technique = registry_.findTechnique("screen_space_photons");
        settings_.params = registry_.makeParams(settings_.technique);
        settings_.width = width;
        settings_.height = height;
        for (const auto& [name, value] : settings)
            settings_.params.set(name, value, "a test");
        renderer_.emplace(context(), registry_, scene_, settings_);
    }

    scene::Scene& scene() { return scene_; }
    RenderSettings& settings() { return settings_; }
    Renderer& renderer() { return *renderer_; }

    // Renders the scene as it is now; `saved` can be read afterwards.
    void next(const std::vector<std::string>& saved = {}) {
        renderer_->update(settings_);
        renderer_->build(Purpose::picture, saved);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer_->renderFrame(timer);
    }
    // With noise of its own.
    void nextOfSeed(std::uint64_t seed, const std::vector<std::string>& saved = {}) {
        settings_.seed = seed;
        next(saved);
    }

    // Four values a pixel, of the frame that was rendered last.
    [[nodiscard]] std::vector<float> irradiance() const {
        return renderer_->texture(renderer_->outputs().caustic.irradiance).read();
    }
    [[nodiscard]] std::vector<float> saved(const std::string& name) const {
        return renderer_->texture(renderer_->graph().find(name)).read();
    }

  private:
    scene::Scene scene_;
    Registry registry_;
    RenderSettings settings_;
    std::optional<Renderer> renderer_;
};

inline Settings reprojected(Settings more = {}) {
    more.emplace_back("temporal", "reproject");
    return more;
}

inline Settings pattern(const std::string& weight = "0.2") {
    return reprojected({{"gather", "pattern"}, {"temporal.reproject.weight", weight}});
}

inline constexpr const char* kUnfiltered = "temporal.unfiltered";

// The largest difference of two images, relative to the second where that is above `floor`.
inline double largestDifference(const std::vector<float>& image, const std::vector<float>& expected,
                                double floor) {
    double largest = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double value = static_cast<double>(expected[i]);
        const double difference = std::abs(static_cast<double>(image[i]) - value);
        // A difference that is no number is the largest of all.
        if (!(difference <= std::numeric_limits<double>::max())) return difference;
        largest = std::max(largest, difference / std::max(std::abs(value), floor));
    }
    return largest;
}

inline std::size_t countNotFinite(const std::vector<float>& values) {
    return static_cast<std::size_t>(std::count_if(
        values.begin(), values.end(), [](float value) { return !std::isfinite(value); }));
}

// Root of the mean square of channel `channel` less `mean`, over pixels that are lit.
inline double deviation(const std::vector<float>& image, std::size_t channel, double mean) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.size(); i += 4) {
        if (image[i] == 0.0f) continue;
        sum += std::pow(static_cast<double>(image[i + channel]) - mean, 2.0);
        ++count;
    }
    return std::sqrt(sum / static_cast<double>(count));
}

inline double rootMeanSquareDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2.0);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

// By about four pixels of 320 sideways, with as much of a turn, a roll and some way forward.
inline void moveCamera(scene::Scene& scene, int frame) {
    scene::Camera& camera = scene.camera;
    const double side = frame % 2 == 0 ? 1.0 : 0.7;
    camera.position += side * glm::dvec3(0.041, 0.013, -0.029);
    camera.target += side * glm::dvec3(-0.017, 0.005, 0.013);
    camera.up += glm::dvec3(0.004, 0.0, 0.002);
}

// Everything by `offset`, m.
inline scene::Scene movedBy(const glm::dvec3& offset) {
    return sceneFromText(fmt::format(R"(
name = "steps"
[camera]
position = [{}, {}, {}]
target = [{}, {}, {}]
[[light]]
name = "sun"
type = "directional"
direction = [0.1, -1, 0]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "brick"
type = "lambertian"
albedo = 0.4
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [4, 4]
position = [{}, {}, {}]
[[object]]
name = "block"
shape = "box"
material = "brick"
size = [0.5, 0.6, 0.4]
position = [{}, {}, {}]
[[object]]
name = "water"
shape = "plane"
material = "water"
size = [1, 1]
position = [{}, {}, {}]
)",
                                     offset.x + 0.3, offset.y + 2.0, offset.z + 1.9, offset.x,
                                     offset.y - 0.4, offset.z, offset.x, offset.y - 0.5, offset.z,
                                     offset.x, offset.y - 0.2, offset.z, offset.x, offset.y + 0.4,
                                     offset.z));
}

}  // namespace kaustik::test
