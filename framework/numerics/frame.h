// SPDX-License-Identifier: MIT
// One rendered measurement frame, read back: scenes from text, textures by name, the ledger.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/gl/context.h"
#include "framework/pipeline/renderer.h"
#include "framework/scene/scene.h"

namespace kaustik::numerics {

using Settings = std::vector<std::pair<std::string, std::string>>;

// A scene file's text, as if it lay in the folder of temporary files. Throws as loadSceneFile does.
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
    [[nodiscard]] double sum() const;
};

// Of a frame that was rendered with every texture and its lists of photons kept.

// The names of all textures of the graph.
[[nodiscard]] std::vector<std::string> textureNames(const Renderer& renderer);
// How many values of a texture, in all its layers, are not finite; of a list's texture those that
// it holds. Waits for the device.
[[nodiscard]] std::size_t countNotFinite(const Renderer& renderer, const std::string& texture);

struct FrameRequest {
    int width = 160;
    int height = 120;
    Settings settings;
    std::vector<std::string> saved = {};  // resources
    // Keeps every texture, so that all can be read and scanned.
    bool keepsAll = false;
    // Memory starts as NaN, so that reads of what was not written show.
    bool poison = false;
    // Renders for Purpose::audit: the renderer has records of all tracings.
    bool recordsTraces = false;
    // Nothing is done by the processor that a GPU would not have done there.
    bool asOnGpu = false;
};

class Frame {
  public:
    // Renders. `registry` and `scene` must outlive the frame.
    Frame(gl::Context& context, const Registry& registry, const scene::Scene& scene,
          const Technique& technique, const FrameRequest& request);

    [[nodiscard]] Texels read(const std::string& resource, int layer = 0) const;
    [[nodiscard]] Texels read(const graph::ResourceRef& handle, int layer = 0) const;
    [[nodiscard]] Texels causticIrradiance() const { return read("caustic.irradiance"); }
    [[nodiscard]] Renderer& renderer() { return *renderer_; }
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }

    // As the functions of these names.
    [[nodiscard]] std::vector<std::string> textureNames() const {
        return numerics::textureNames(*renderer_);
    }
    [[nodiscard]] std::size_t countNotFinite(const std::string& texture) const {
        return numerics::countNotFinite(*renderer_, texture);
    }

    // World position that a pixel centre sees at a view depth.
    [[nodiscard]] glm::dvec3 worldAt(int x, int y, double depth) const;
    [[nodiscard]] glm::dvec3 toWorld(const glm::dvec3& positionVs) const;
    [[nodiscard]] const render::RasterView& view() const { return view_; }

  private:
    std::unique_ptr<Renderer> renderer_;
    render::RasterView view_;
};

}  // namespace kaustik::numerics
