// SPDX-License-Identifier: MIT
// What the GPU tests share: one headless context, scenes from text, and frames read back.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/gl/context.h"
#include "framework/pipeline/renderer.h"
#include "framework/scene/scene.h"
#include "techniques/register_all.h"

namespace kaustik::test {

// The context of this process, current on its only thread.
[[nodiscard]] gl::Context& context();

// A scene file's text, as if it lay in experiments/scenes.
[[nodiscard]] scene::Scene sceneFromText(const std::string& toml);

// Texels of one layer, lower left first; `channels` of each.
struct Texels {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> values;
    [[nodiscard]] float at(int x, int y, int channel) const {
        return values[static_cast<std::size_t>((y * width + x) * channels + channel)];
    }
    [[nodiscard]] glm::dvec3 rgb(int x, int y) const {
        return {at(x, y, 0), at(x, y, 1), at(x, y, 2)};
    }
};

// One rendered measurement frame of a scene with the project's own techniques.
class Frame {
  public:
    using Settings = std::vector<std::pair<std::string, std::string>>;
    Frame(const scene::Scene& scene, int width, int height, const Settings& settings = {},
          const std::vector<std::string>& saved = {}, bool poison = false,
          const std::string& technique = "screen_space_photons");

    [[nodiscard]] Texels read(const std::string& resource, int layer = 0) const;
    [[nodiscard]] Texels causticIrradiance() const { return read("caustic.irradiance"); }
    [[nodiscard]] Renderer& renderer() { return *renderer_; }
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }

    // World position that a pixel centre sees at a view depth.
    [[nodiscard]] glm::dvec3 worldAt(int x, int y, double depth) const;
    [[nodiscard]] glm::dvec3 toWorld(const glm::dvec3& positionVs) const;

  private:
    Registry registry_;
    std::unique_ptr<Renderer> renderer_;
    render::EyeView view_;
};

}  // namespace kaustik::test
