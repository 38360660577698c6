// SPDX-License-Identifier: MIT
// Views in which surfaces are rasterised and light is stored: on the screen, in a light's view, or
// on the faces of a cube. Passes that draw into views or look things up in them are written once
// for all: shaders by include/views/view.glsl, C++ by asking here.
#pragma once

#include <vector>

#include "framework/gl/command.h"
#include "framework/render/gpu_scene.h"
#include "framework/render/view.h"

namespace kaustik::render {

enum class Space { screen, light, cube };
// The space as messages name it: "on the screen".
[[nodiscard]] const char* describe(Space space);

// One view, or the six faces of a cube; all of one size and projection. Textures of more than one
// view are arrays, one face's layers after the other's.
class RasterViews {
  public:
    // The eye's, whose block is bound to every command and whose instances belong to the renderer.
    RasterViews(const RasterView& eye, const ViewInstances& instances);
    RasterViews(Space space, std::vector<RasterView> views, const GpuScene& scene,
                const RasterView& eye);

    [[nodiscard]] Space space() const { return space_; }
    [[nodiscard]] bool isEyeView() const { return space_ == Space::screen; }
    [[nodiscard]] int count() const { return static_cast<int>(views_.size()); }
    [[nodiscard]] int width() const { return views_.front().width; }
    [[nodiscard]] int height() const { return views_.front().height; }
    // Layers of a texture that has `each` a view; 0, a texture that is no array, for one of one.
    [[nodiscard]] int layers(int each) const { return each * count(); }
    [[nodiscard]] int layers() const { return count() == 1 ? 0 : count(); }
    [[nodiscard]] const RasterView& view(int face) const {
        return views_[static_cast<std::size_t>(face)];
    }
    [[nodiscard]] const ViewInstances& instances(int face) const {
        return isEyeView() ? *eyesInstances_ : instances_[static_cast<std::size_t>(face)];
    }

    // ViewData of all, for a block under another name; not of the eye's.
    [[nodiscard]] const gl::Buffer& block() const { return block_; }
    // Makes the shaders of a command see these views.
    gl::Command& bindTo(gl::Command& command) const;

  private:
    Space space_ = Space::screen;
    std::vector<RasterView> views_;
    const ViewInstances* eyesInstances_ = nullptr;
    std::vector<ViewInstances> instances_;
    gl::Buffer block_;
};

// The six faces around a point in world space, `side` pixels each.
[[nodiscard]] std::vector<RasterView> makeCube(const glm::dvec3& center, double nearMeters,
                                               int side);

}  // namespace kaustik::render
