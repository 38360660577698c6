// SPDX-License-Identifier: MIT
#include "techniques/eye_rays/view_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "framework/scene/dielectrics.h"
#include "techniques/eye_rays/view_params.h"

namespace kaustik {
namespace {

bool contains(const scene::Bounds& outer, const scene::Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.minimum, inner.minimum)) &&
           glm::all(glm::greaterThanEqual(outer.maximum, inner.maximum));
}

// The longest chain of boxes, each within the one before.
int deepestNesting(std::vector<scene::Bounds> boxes) {
    const auto size = [](const scene::Bounds& box) {
        const glm::dvec3 extent = box.maximum - box.minimum;
        return extent.x + extent.y + extent.z;
    };
    std::sort(boxes.begin(), boxes.end(),
              [&](const auto& a, const auto& b) { return size(a) > size(b); });
    std::vector<int> depths(boxes.size(), 1);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t outer = 0; outer < i; ++outer) {
            if (contains(boxes[outer], boxes[i]))
                depths[i] = std::max(depths[i], depths[outer] + 1);
        }
    }
    return boxes.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
}

// Sets what include/views/scene_look.glsl is told besides what the pass has bound.
void setLook(const FrameInputs& inputs, gl::Command& command, const ViewPass& pass,
             const SceneLookParams& look) {
    command.set("searchesScene", look.scene ? 1 : 0)
        .set("reflectsScene", look.scene && look.reflection ? 1 : 0)
        .set("lookMirrors", look.mirrors);
    if (inputs.needs.refractors > 0) command.define("DIELECTRICS");
    const bool looksInLayers = look.surfaces == LookSurfaces::layers;
    if (pass.isGlossy || looksInLayers) command.set("lightCount", inputs.needs.lights);
    if (pass.isGlossy) command.define("GLOSSY_RECEIVERS");
    if (looksInLayers) {
        command.define("LOOK_IN_LAYERS").set("sceneLayers", pass.sceneLayers);
    } else {
        command.set("searchStride", look.stride);
    }
}

// The first surface of every pixel, as rays see it that go by `offset`, px, next to the middles.
void drawSights(const FrameInputs& inputs, gl::PassContext& context, const ViewSamples& samples,
                const glm::vec2& offset) {
    gl::Command command = context.shaders({"raster_views/eye.vert", "eye_rays/sight.frag"});
    // What lies there comes to lie on the middle; clip.w is -z.
    glm::mat4 projection = inputs.view.projection();
    projection[2][0] += 2.0f * offset.x / static_cast<float>(inputs.view.width);
    projection[2][1] += 2.0f * offset.y / static_cast<float>(inputs.view.height);
    command.set("projection", projection);
    command.target(samples.sight).clear();
    command.target(samples.surface).clear();
    command.depth(samples.depthBuffer, gl::DepthTest::nearerReversed).clear();
    // In the order of the eye buffer, so that of surfaces that coincide the same one is seen.
    for (const render::DrawSet set :
         {render::DrawSet::nonDielectrics, render::DrawSet::dielectrics}) {
        inputs.gpuScene.draw(command, context, samples.geometry, inputs.instances, set);
    }
}

}  // namespace

std::vector<glm::vec2> samplesOfPixel(int count) {
    // As near to the golden ratio's part as a number without a common divisor comes.
    const int modulus = count + 1;
    const double wanted = modulus / std::numbers::phi;
    int step = 1;
    for (int other = 2; other < modulus; ++other) {
        if (std::gcd(other, modulus) == 1 && std::abs(other - wanted) < std::abs(step - wanted))
            step = other;
    }
    std::vector<glm::vec2> offsets;
    for (int i = 1; i <= count; ++i) {
        const glm::vec2 cell(i, i * step % modulus);
        offsets.push_back((cell - 0.5f * static_cast<float>(modulus)) / static_cast<float>(count));
    }
    return offsets;
}

View renderReceiversOnly(FrameBuilder& frame, const std::string& pass, const Radiance& receivers) {
    frame.skip(pass, whyNothingSeenThrough(frame.facts()));
    return {receivers.radiance, {}, {}, {}};
}

std::string lookReason(const FrameBuilder& frame) {
    const int samples = frame.params<ViewParams>("view").samples;
    const std::string reason = "the eye looks at specular surfaces";
    return samples > 1 ? fmt::format("{}, by {} rays a pixel", reason, samples) : reason;
}

DielectricsBox boxOfDielectrics(const FrameBuilder& frame) {
    const scene::Scene& scene = frame.scene();
    scene::Bounds all;
    std::vector<scene::Bounds> closed;
    std::vector<scene::Bounds> others;
    for (const scene::Object& object : scene.objects) {
        const scene::MaterialKind kind = scene.materials[object.material].kind;
        const scene::Bounds bounds = objectBounds(scene, object);
        if (bounds.empty) continue;
        if (kind != scene::MaterialKind::dielectric) {
            others.push_back(bounds);
            continue;
        }
        all.include(bounds.minimum);
        all.include(bounds.maximum);
        if (scene.meshes[object.mesh].closed) closed.push_back(bounds);
    }
    DielectricsBox box;
    if (all.empty) return box;
    for (const scene::Bounds& inside : closed) {
        for (const scene::Bounds& other : others)
            box.holdsScene = box.holdsScene || overlap(inside, other);
    }
    box.nested = deepestNesting(closed);
    const render::RasterView& view = frame.view();
    const glm::dvec3 extent = all.maximum - all.minimum;
    const glm::dvec3 center(view.worldToView * glm::dvec4(0.5 * (all.minimum + all.maximum), 1.0));
    const double farthest = std::max(-center.z + 0.5 * glm::length(extent), view.nearMeters);
    const double margin = 1e-4 * glm::length(extent) + 2.0 * farthest * view.footprintPerMeter();
    box.centerVs = glm::vec3(center);
    box.halfExtentMeters = glm::vec3(0.5 * extent + margin);
    return box;
}

ViewPass declareView(const FrameBuilder& frame, graph::PassSetup& setup, const Geometry& geometry,
                     const EyeBuffer& eye, const Radiance& receivers, const Shadows& shadows) {
    setup.sample("interfaceDepth", eye.interface);
    setup.sample("interfaceSurface", eye.interfaceSurface);
    setup.sample("receiver", eye.receiver);
    setup.sample("receiverSurface", eye.receiverSurface);
    setup.sample("receiverRadiance", receivers.radiance);
    ViewPass pass;
    if (frame.needs().glossyReceivers && frame.needs().lights > 0) {
        pass.isGlossy = true;
        setup.sample("directVisibility", shadows.visibility);
    }
    const int w = frame.width();
    const int h = frame.height();
    pass.seen.radiance = setup.create<RadianceTexel>("view.radiance", w, h);
    pass.seen.ending = setup.create<PathEnding>("view.path_ending", w, h);
    pass.seen.exitPosition = setup.create<ExitPosition>("view.exit_position", w, h);
    pass.seen.exitDirection = setup.create<ExitDirection>("view.exit_direction", w, h);
    setup.bypass(pass.seen.radiance, receivers.radiance);
    setup.bypass(pass.seen.ending, {0, 0, 0, 0});
    setup.bypass(pass.seen.exitPosition, {0, 0, 0, 0});
    setup.bypass(pass.seen.exitDirection, {0, 0, 0, 0});
    ViewSamples& samples = pass.samples;
    samples.count = frame.params<ViewParams>("view").samples;
    if (samples.count == 1) return pass;
    samples.geometry = geometry;
    if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
    samples.sight = setup.create<SightTexel>("view.sight", w, h);
    samples.surface = setup.create<SurfaceTexel>("view.sight_surface", w, h);
    samples.depthBuffer = setup.create<DepthBuffer>("view.sight_depth_buffer", w, h);
    for (const graph::ResourceRef& drawn : std::initializer_list<graph::ResourceRef>{
             samples.sight, samples.surface, samples.depthBuffer}) {
        setup.bypass(drawn, {0, 0, 0, 0});
    }
    return pass;
}

ViewPass declareLook(const FrameBuilder& frame, graph::PassSetup& setup,
                     const SceneLookParams& look, const Geometry& geometry, const EyeBuffer& eye,
                     const LayeredDepth& sceneLayers, const Radiance& receivers,
                     const Shadows& shadows) {
    ViewPass pass = declareView(frame, setup, geometry, eye, receivers, shadows);
    if (look.surfaces == LookSurfaces::layers) {
        needsEyesView("surfaces=layers of a view", "the layers", sceneLayers.views);
        pass.sceneLayers = sceneLayers.layers;
        setup.sample("sceneDepths", sceneLayers.depth);
        setup.sample("sceneSurfaces", sceneLayers.surface);
    }
    pass.marks = setup.create<DepthBuffer>("view.marks", frame.width(), frame.height());
    setup.bypass(pass.marks, {0, 0, 0, 0});
    return pass;
}

void lookBySamples(const FrameInputs& inputs, gl::PassContext& context, const ViewPass& pass,
                   const LookOnce& look) {
    const ViewSamples& samples = pass.samples;
    const float share = 1.0f / static_cast<float>(samples.count);
    const auto lookAt = [&](float shareOfRay, const glm::vec2& offset) {
        PixelSample sample{offset, {}};
        sample.tell = [&, isMiddle = sample.isMiddle()](gl::Command& command) {
            if (samples.count > 1) command.define("MORE_SAMPLES").set("sampleShare", shareOfRay);
            if (isMiddle) return;
            command.define("BESIDE_MIDDLE")
                .set("sampleOffset", offset)
                .texture("sight", samples.sight)
                .texture("sightSurface", samples.surface);
        };
        look(sample);
    };
    std::vector<glm::vec2> sampleOffsets = samplesOfPixel(samples.count);
    const bool isMiddleOne = std::erase(sampleOffsets, glm::vec2(0.0f)) > 0;
    lookAt(isMiddleOne ? share : 0.0f, glm::vec2(0.0f));
    for (const glm::vec2& offset : sampleOffsets) {
        drawSights(inputs, context, samples, offset);
        lookAt(share, offset);
    }
}

bool storesExits(const gl::PassContext& context, const View& seen) {
    return context.isKept(seen.exitPosition) || context.isKept(seen.exitDirection);
}

void drawSpecular(const FrameInputs& inputs, gl::PassContext& context, const ViewPass& pass,
                  const std::string& shader, const std::vector<Tell>& tells) {
    // First pixels that need no look, then the others, by the marks that the first have left.
    lookBySamples(inputs, context, pass, [&](const PixelSample& sample) {
        for (std::size_t draw = 0; draw <= tells.size(); ++draw) {
            const bool looks = draw > 0;
            gl::Command command = context.fullscreen(looks ? shader : "eye_rays/straight.frag");
            if (looks) tells[draw - 1](command);
            sample.tell(command);
            command.target(pass.seen.radiance);
            if (sample.isMiddle()) {
                command.target(pass.seen.ending);
                if (storesExits(context, pass.seen)) {
                    command.define("EXITS")
                        .target(pass.seen.exitPosition)
                        .target(pass.seen.exitDirection);
                }
            } else {
                command.blend(gl::Blend::add);
            }
            // 1 is left where no look is needed.
            command.depth(pass.marks,
                          looks ? gl::DepthTest::atReversed : gl::DepthTest::nearerReversed);
            if (!looks) command.clear();
            command.draw();
        }
    });
}

void drawLook(const FrameInputs& inputs, gl::PassContext& context, const ViewPass& pass,
              const SceneLookParams& look, const std::string& shader, const Tell& tell) {
    drawSpecular(inputs, context, pass, shader, {[&](gl::Command& command) {
                     setLook(inputs, command, pass, look);
                     tell(command);
                 }});
}

void reportExitLimit(FrameBuilder& frame, const std::string& pass, const View& seen,
                     const std::string& parameter, const std::string& unit, int value,
                     std::size_t EyeRays::*ending, const std::string& fate) {
    frame.reportLimit(
        {pass,
         {seen.ending},
         [=, endings = seen.ending](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const std::size_t rays = countEyeRays(executor.texture(endings)).*ending;
             if (rays == 0) return {};
             return ReachedLimit{parameter,
                                 unit,
                                 static_cast<double>(value),
                                 0.0,
                                 fmt::format("the eye's rays of {} pixels {}", rays, fate),
                                 0.0};
         }});
}

void reportLostRays(FrameBuilder& frame, const std::string& pass, const View& seen,
                    const std::string& why) {
    constexpr double kTold = 0.01;
    frame.reportLimit(
        {pass,
         {seen.ending},
         [=, endings = seen.ending](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const EyeRays rays = countEyeRays(executor.texture(endings));
             const double share = rays.shareOf(rays.lost);
             if (share <= kTold) return {};
             return ReachedLimit{
                 pass,
                 "% of the eye's rays",
                 100.0 * kTold,
                 100.0 * share,
                 fmt::format(
                     "{:.3g}% of the {} pixels' rays that meet a specular surface first are "
                     "lost: {}",
                     100.0 * share, rays.pixels, why),
                 0.0};
         }});
}

void reportDielectricLimits(FrameBuilder& frame, const std::string& pass, const View& seen,
                            int interfaces, int reflections) {
    reportExitLimit(frame, pass, seen, pass + ".interfaces", "refractions", interfaces,
                    &EyeRays::endedInside,
                    "end inside of an object and are taken to see what they would outside");
    reportExitLimit(frame, pass, seen, pass + ".reflections", "reflections", reflections,
                    &EyeRays::reflectionLimit, "are lost between total reflections");
    reportExitLimit(frame, pass, seen, pass + ".nesting", "dielectrics",
                    numberDielectrics(frame.scene()).depth, &EyeRays::nestingLimit,
                    "are lost in a dielectric inside of more others");
}

void reportMirrorLimit(FrameBuilder& frame, const std::string& pass, const View& seen,
                       int mirrors) {
    if (frame.needs().reflectors == 0) return;
    reportExitLimit(frame, pass, seen, pass + ".mirrors", "mirrors", mirrors, &EyeRays::mirrorLimit,
                    "hit one more mirror, in which they see the environment");
}

}  // namespace kaustik
