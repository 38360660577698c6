// SPDX-License-Identifier: MIT
#include "techniques/shadow/processor_shadows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/reference/shadow_rays.h"
#include "framework/scene/light_paths.h"
#include "techniques/tracing/processor_eye.h"
#include "techniques/tracing/processor_scene.h"

namespace kaustik {
namespace {

struct ProcessorShadows {
    Shadows shadows;
    graph::Buffer<std::uint32_t> lit;  // a bit a pixel of one light, rows of whole words
};

int wordsOfRow(int width) {
    return (width + 31) / 32;
}

struct Receivers {
    std::vector<glm::vec4> depths;    // ReceiverTexel
    std::vector<glm::vec4> surfaces;  // SurfaceTexel
    std::vector<bool> isOpen;         // by material
};

class ShadowsOfLight {
  public:
    ShadowsOfLight(const reference::EmbreeScene& scene, const ProcessorEye& eye,
                   const scene::Light& light, const Receivers& receivers)
        : scene_(scene), eye_(eye), light_(light), receivers_(receivers) {}

    void findRow(int row, std::uint32_t* lit) const {
        std::array<reference::RayToLight, reference::kRaysTogether> rays;
        std::array<int, reference::kRaysTogether> columns{};
        int count = 0;
        const auto trace = [&] {
            if (count == 0) return;
            const std::uint32_t blocked = scene_.blockedRays(rays, count);
            for (int i = 0; i < count; ++i) {
                const int column = columns[static_cast<std::size_t>(i)];
                if ((blocked >> i & 1u) == 0) lit[column / 32] |= std::uint32_t{1} << (column % 32);
            }
            count = 0;
        };
        for (int column = 0; column < eye_.view().width; ++column) {
            if (!faces(column, row, rays[static_cast<std::size_t>(count)])) continue;
            columns[static_cast<std::size_t>(count)] = column;
            if (++count == reference::kRaysTogether) trace();
        }
        trace();
    }

  private:
    // Whether the light may shine on what the pixel shows, and the ray back to it.
    bool faces(int column, int row, reference::RayToLight& ray) const {
        const auto pixel =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(eye_.view().width) +
            static_cast<std::size_t>(column);
        const double depth = static_cast<double>(receivers_.depths[pixel].x);
        if (!(depth > 0.0 && std::isfinite(depth))) return false;
        const glm::dvec3 viewing = eye_.viewing(glm::dvec2(column, row) + 0.5);
        const glm::dvec3 position = depth * viewing;
        const glm::dvec3 local = eye_.localPosition(position);
        const reference::WayToLight way = reference::wayTo(light_, local, scene_.center());
        if (!(way.meters > 0.0)) return false;
        const glm::vec4& surface = receivers_.surfaces[pixel];
        const glm::dvec3 normal(surface);
        const bool isTurned = isOpen(surface.w) && glm::dot(normal, position) > 0.0;
        const double cosine = glm::dot(eye_.direction(way.direction), normal);
        if (!((isTurned ? -cosine : cosine) > 0.0)) return false;
        ray.origin = local;
        ray.direction = way.direction;
        constexpr double kFar = std::numeric_limits<float>::max();
        ray.reachMeters = static_cast<float>(
            std::min((1.0 - reference::ShadowRays::kOwnSurface) * way.meters, kFar));
        // A picture's depths: rasterisers move corners to the 1/256 of a pixel.
        ray.resolvedMeters = static_cast<float>(scene_.roundingMeters() +
                                                eye_.view().footprintPerMeter() * depth / 128.0 +
                                                4e-6 * glm::length(position));
        return true;
    }

    // Material, + 1: a device that is lost may hand out anything.
    [[nodiscard]] bool isOpen(float material) const {
        const bool isOne =
            material >= 1.0f && material < static_cast<float>(receivers_.isOpen.size() + 1);
        return isOne && receivers_.isOpen[static_cast<std::size_t>(material) - 1];
    }

    const reference::EmbreeScene& scene_;
    const ProcessorEye& eye_;
    const scene::Light& light_;
    const Receivers& receivers_;
};

std::vector<std::uint32_t> litPixels(const reference::EmbreeScene& scene,
                                     const render::RasterView& view, const scene::Light& light,
                                     const Receivers& receivers) {
    const ProcessorEye eye(scene, view);
    const ShadowsOfLight shadows(scene, eye, light, receivers);
    const auto words = static_cast<std::size_t>(wordsOfRow(view.width));
    std::vector<std::uint32_t> lit(words * static_cast<std::size_t>(view.height), 0);
    tbb::parallel_for(0, view.height, [&](int row) {
        shadows.findRow(row, lit.data() + words * static_cast<std::size_t>(row));
    });
    return lit;
}

}  // namespace

Shadows shadowsByProcessor(FrameBuilder& frame, const std::string& pass, const Geometry& geometry,
                           const EyeBuffer& eye) {
    const ProcessorScene processor = processorScene(frame, geometry);
    const int lights = frame.needs().lights;
    return frame
        .pass<ProcessorShadows>(
            pass, "a ray from every receiver back to the light, traced by the processor",
            [&](graph::PassSetup& setup, ProcessorShadows& data) {
                setup.read(eye.receiver);
                setup.read(eye.receiverSurface);
                processor.read(setup);
                const int w = frame.width();
                const int h = frame.height();
                data.shadows.visibility = setup.image(
                    "visibility", setup.create<VisibilityTexel>("shadow.visibility", w, h, lights));
                setup.bypass(data.shadows.visibility, {1, 1, 1, 1});
                data.lit = setup.createBuffer<std::uint32_t>(
                    "shadow.lit",
                    static_cast<std::size_t>(wordsOfRow(w)) * static_cast<std::size_t>(h));
                setup.bypass(data.lit, {0, 0, 0, 0});
            },
            [&inputs = frame.inputs(), scene = processor.scene, eye, lights](
                const ProcessorShadows& data, gl::PassContext& context) {
                const scene::Scene& of = scene->scene();
                Receivers receivers;
                if (!context.isListing()) {
                    receivers.depths = context.texture(eye.receiver).readRows(inputs.view.height);
                    receivers.surfaces =
                        context.texture(eye.receiverSurface).readRows(inputs.view.height);
                    receivers.isOpen = openMaterials(of);
                }
                for (int light = 0; light < lights; ++light) {
                    if (!context.isListing()) {
                        const auto lit =
                            litPixels(*scene, inputs.view,
                                      of.lights[static_cast<std::size_t>(light)], receivers);
                        context.buffer(data.lit).upload(lit);
                    }
                    context.compute("shadow/processor_shadows.comp")
                        .texels("litPixels", data.lit, Format::r32ui)
                        .set("wordsOfRow", wordsOfRow(inputs.view.width))
                        .set("lightIndex", light)
                        .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
                }
            })
        .shadows;
}

}  // namespace kaustik
