// SPDX-License-Identifier: MIT
#include "techniques/deferred_buffers/body_buffers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "techniques/deferred_buffers/body_data.h"

namespace kaustik {
namespace {

double distanceFrom(const glm::dvec3& point, const scene::Bounds& box) {
    return glm::length(point - glm::clamp(point, box.minimum, box.maximum));
}

// Of the corner that comes first.
double distanceAlong(const glm::dvec3& direction, const scene::Bounds& box) {
    double minimum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        minimum +=
            std::min(direction[axis] * box.minimum[axis], direction[axis] * box.maximum[axis]);
    return minimum;
}

template <class Distance>
std::vector<Body> sortedBy(std::vector<Body> bodies, const Distance& distance) {
    const auto nearestOf = [&](const Body& body) {
        double minimum = std::numeric_limits<double>::infinity();
        for (const scene::Bounds& box : body.boxes)
            minimum = std::min(minimum, distance(box));
        return minimum;
    };
    std::stable_sort(bodies.begin(), bodies.end(),
                     [&](const Body& a, const Body& b) { return nearestOf(a) < nearestOf(b); });
    return bodies;
}

// For rounding, and as far as a texel's front may lie next to the surface.
double marginAround(const scene::Bounds& box, const render::RasterView& view) {
    double farthest = 1.0;
    if (!view.isOrthographic) {
        const glm::dvec3 middle = 0.5 * (box.minimum + box.maximum);
        farthest = std::max(-(view.worldToView * glm::dvec4(middle, 1.0)).z, view.nearMeters) +
                   0.5 * glm::length(box.maximum - box.minimum);
    }
    return 1e-4 * glm::length(box.maximum - box.minimum) +
           0.1 * farthest * view.footprintPerMeter();
}

std::vector<deferred::BodyBox> boxesIn(const render::RasterView& view,
                                       const std::vector<Body>& bodies) {
    std::vector<deferred::BodyBox> boxes;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (const scene::Bounds& box : bodies[i].boxes) {
            const glm::dvec3 middle(view.worldToView *
                                    glm::dvec4(0.5 * (box.minimum + box.maximum), 1.0));
            const glm::dvec3 half = 0.5 * (box.maximum - box.minimum) + marginAround(box, view);
            boxes.push_back({glm::vec4(glm::vec3(middle), static_cast<float>(i)),
                             glm::vec4(glm::vec3(half), 0.0f)});
        }
    }
    return boxes;
}

struct Drawing {
    BodyBuffers buffers;
    graph::Texture<DepthBuffer> depthBuffer;
    Geometry geometry;
};

// Into a layer, or all of them.
gl::Command commandFor(gl::PassContext& context, const Drawing& data, bool isOnce, int layer) {
    const BodyBuffers& buffers = data.buffers;
    std::vector<std::string> shaders = {"deferred_buffers/deferred.vert",
                                        "deferred_buffers/deferred.frag"};
    if (isOnce) shaders.insert(shaders.begin() + 1, "deferred_buffers/deferred.geom");
    gl::Command command = context.shaders(std::move(shaders));
    if (isOnce) command.define("ONCE");
    buffers.views->bindTo(command).set("projection", buffers.views->view(0).projection());
    command.target(buffers.depth, layer).clear();
    command.target(buffers.surface, layer).clear();
    if (buffers.shape.valid()) command.define("SHAPES").target(buffers.shape, layer).clear();
    command.depth(data.depthBuffer, gl::DepthTest::nearerReversed, layer).clear();
    return command;
}

void drawObjects(const FrameInputs& inputs, gl::PassContext& context, gl::Command& command,
                 const Drawing& data, const Body& body) {
    for (std::size_t i = 0; i < inputs.gpuScene.commandCount(); ++i) {
        const std::size_t object = inputs.gpuScene.objectOf(i);
        if (std::count(body.objects.begin(), body.objects.end(), object) == 0) continue;
        inputs.gpuScene.drawOne(command, context, data.geometry, data.buffers.views->instances(0),
                                i);
    }
}

void draw(const FrameInputs& inputs, gl::PassContext& context, const Drawing& data,
          const std::vector<Body>& bodies, DeferredGeometry geometry) {
    if (geometry == DeferredGeometry::once) {
        gl::Command command = commandFor(context, data, true, gl::Command::kAllLayers);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            command.set("firstLayer", 2 * static_cast<int>(i));
            drawObjects(inputs, context, command, data, bodies[i]);
        }
    } else {
        for (int layer = 0; layer < 2 * static_cast<int>(bodies.size()); ++layer) {
            gl::Command command = commandFor(context, data, false, layer);
            command.set("layer", layer % 2);
            drawObjects(inputs, context, command, data,
                        bodies[static_cast<std::size_t>(layer / 2)]);
        }
    }
    if (bodies.size() < 2) return;
    gl::Command opaque = commandFor(context, data, false, 2 * static_cast<int>(bodies.size()));
    opaque.set("layer", 0);
    inputs.gpuScene.draw(opaque, context, data.geometry, data.buffers.views->instances(0),
                         render::DrawSet::nonDielectrics);
}

}  // namespace

std::vector<Body> bodiesOf(const FrameBuilder& frame) {
    const scene::Scene& scene = frame.scene();
    std::vector<Body> bodies;
    for (const std::vector<std::size_t>& objects : frame.needs().bodies) {
        Body body;
        body.objects = objects;
        for (const std::size_t i : objects) {
            body.names.push_back(scene.objects[i].name);
            body.boxes.push_back(objectBounds(scene, scene.objects[i]));
        }
        bodies.push_back(std::move(body));
    }
    return bodies;
}

std::vector<Body> nearestFirst(std::vector<Body> bodies, const scene::Light& light) {
    if (light.kind != scene::LightKind::directional)
        return nearestFirst(std::move(bodies), light.position);
    return sortedBy(std::move(bodies),
                    [&](const scene::Bounds& box) { return distanceAlong(light.direction, box); });
}

std::vector<Body> nearestFirst(std::vector<Body> bodies, const glm::dvec3& eye) {
    return sortedBy(std::move(bodies),
                    [&](const scene::Bounds& box) { return distanceFrom(eye, box); });
}

std::string quoted(const std::vector<std::string>& names) {
    return names.empty() ? "" : fmt::format("'{}'", fmt::join(names, "', '"));
}

std::string omittedNames(const std::vector<Body>& bodies, int maximum) {
    std::vector<std::string> names;
    for (auto i = static_cast<std::size_t>(maximum); i < bodies.size(); ++i)
        names.insert(names.end(), bodies[i].names.begin(), bodies[i].names.end());
    return quoted(names);
}

void BodyBuffers::sample(graph::PassSetup& setup) const {
    setup.sample("bodyDepth", depth);
    setup.sample("bodySurface", surface);
    if (shape.valid()) setup.sample("bodyShape", shape);
    setup.define("BODIES");
    if (bodies > 1) setup.define("SEVERAL_BODIES");
}

void BodyBuffers::bindTo(gl::Command& command) const {
    command.storage("BodyBoxes", *boxData).set("boxCount", boxes).set("bodyCount", bodies);
}

void setBoxes(FrameBuilder& frame, const std::vector<Body>& bodies, const std::string& prefix,
              BodyBuffers& buffers) {
    const std::vector<deferred::BodyBox> boxes = boxesIn(buffers.views->view(0), bodies);
    buffers.boxes = static_cast<int>(boxes.size());
    buffers.boxData = &frame.keep(gl::Buffer(boxes, prefix + "bodies"));
}

BodyBuffers drawBodies(FrameBuilder& frame, const Geometry& geometry, const Views& views,
                       const std::vector<Body>& bodies, const BodyBuffersPass& pass) {
    const std::vector<Body> drawn(bodies.begin(), bodies.begin() + pass.bodies);
    return frame
        .pass<Drawing>(
            pass.name, pass.reason,
            [&](graph::PassSetup& setup, Drawing& data) {
                data.geometry = geometry;
                if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                const int w = views->width();
                const int h = views->height();
                const int layers = 2 * pass.bodies + (pass.bodies > 1 ? 1 : 0);
                BodyBuffers& made = data.buffers;
                made.views = views;
                made.bodies = pass.bodies;
                setBoxes(frame, bodies, pass.prefix, made);
                made.depth = setup.create<ViewDepth>(pass.prefix + "body_depth", w, h, layers);
                made.surface =
                    setup.create<SurfaceTexel>(pass.prefix + "body_surface", w, h, layers);
                if (pass.hasShape)
                    made.shape = setup.create<HitShape>(pass.prefix + "body_shape", w, h, layers);
                data.depthBuffer =
                    setup.create<DepthBuffer>(pass.prefix + "body_depth_buffer", w, h, layers);
            },
            [&inputs = frame.inputs(), drawn, how = pass.geometry](const Drawing& data,
                                                                   gl::PassContext& context) {
                draw(inputs, context, data, drawn, how);
            })
        .buffers;
}

}  // namespace kaustik
