// SPDX-License-Identifier: MIT
#include "framework/render/raster_views.h"

#include <cmath>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::render {

const char* describe(Space space) {
    switch (space) {
        case Space::screen:
            return "on the screen";
        case Space::light:
            return "in a light's view";
        case Space::cube:
            break;
    }
    return "on the faces of a cube";
}

RasterViews::RasterViews(const RasterView& eye, const ViewInstances& instances)
    : views_{eye}, eyesInstances_(&instances) {}

RasterViews::RasterViews(Space space, std::vector<RasterView> views, const GpuScene& scene,
                         const RasterView& eye)
    : space_(space), views_(std::move(views)) {
    std::vector<transport::ViewData> block;
    for (const RasterView& view : views_) {
        const glm::dvec2 pixel = view.halfExtent / glm::dvec2(view.width, view.height);
        if (std::abs(pixel.x - pixel.y) > 1e-9 * pixel.y)
            throw GraphError("Views have square pixels: inPixels() makes them so.");
        instances_.push_back(scene.makeInstances(view.worldToView));
        block.push_back(viewData(scene.scene(), view, eye));
    }
    // A block has room for all faces; shaders of one view read the first.
    block.resize(transport::kMaxViews);
    block_ = gl::Buffer(block, "views");
}

gl::Command& RasterViews::bindTo(gl::Command& command) const {
    if (isEyeView()) return command;
    command.offer("View", block_).define("OTHER_VIEW");
    if (views_.front().isOrthographic) command.define("ORTHOGRAPHIC_VIEW");
    if (count() > 1) command.define("MANY_VIEWS").offer("viewCount", count());
    return command;
}

std::vector<RasterView> makeCube(const glm::dvec3& center, double nearMeters, int side) {
    std::vector<RasterView> faces;
    for (int face = 0; face < static_cast<int>(transport::kMaxViews); ++face) {
        RasterView view = makeCubeFaceView(center, face);
        view.nearMeters = nearMeters;
        faces.push_back(inPixels(view, side, side));
    }
    return faces;
}

}  // namespace kaustik::render
