// SPDX-License-Identifier: MIT
#include "techniques/shared/light_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/pipeline/stage_params.h"
#include "techniques/shared/receivers.h"

namespace kaustik {
namespace {

scene::Bounds receiverBounds(const scene::Scene& scene) {
    scene::Bounds bounds;
    for (const scene::Object& object : scene.objects) {
        if (!isReceiver(scene.materials[object.material].kind)) continue;
        const scene::Bounds objects = objectBounds(scene, object);
        if (objects.empty) continue;
        bounds.include(objects.minimum);
        bounds.include(objects.maximum);
    }
    return bounds;
}

// What of a box the eye looks at: the box around all corners of box and frustum, and all places
// where the edges of one meet the sides of the other. Points are in the eye's view space.
class SeenPart {
  public:
    SeenPart(const render::RasterView& eye, const scene::Bounds& box)
        : eye_(eye), toWorld_(glm::inverse(eye.worldToView)), box_(box) {}

    [[nodiscard]] scene::Bounds bounds() {
        const std::vector<glm::dvec3> corners = cornersOf(box_);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (const std::size_t bit : {1U, 2U, 4U}) {
                if ((i & bit) == 0) addEdge(corners[i], corners[i | bit]);
            }
        }
        const glm::dvec3 eye(toWorld_[3]);
        for (const double x : {-1.0, 1.0}) {
            for (const double y : {-1.0, 1.0}) {
                const glm::dvec3 ray(x * eye_.halfExtent.x, y * eye_.halfExtent.y, -1.0);
                addRay(eye, glm::dmat3(toWorld_) * ray);
            }
        }
        return seen_;
    }

  private:
    static std::vector<glm::dvec3> cornersOf(const scene::Bounds& box) {
        std::vector<glm::dvec3> all;
        for (std::size_t i = 0; i < 8; ++i) {
            all.emplace_back((i & 1) != 0 ? box.maximum.x : box.minimum.x,
                             (i & 2) != 0 ? box.maximum.y : box.minimum.y,
                             (i & 4) != 0 ? box.maximum.z : box.minimum.z);
        }
        return all;
    }

    // The part of [low, high] along a line where a + b t >= 0.
    static void cut(double a, double b, double& low, double& high) {
        if (b > 0.0) {
            low = std::max(low, -a / b);
        } else if (b < 0.0) {
            high = std::min(high, -a / b);
        } else if (a < 0.0) {
            high = low - 1.0;
        }
    }

    // An edge of the box, as far as it is in the frustum.
    void addEdge(const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 a(eye_.worldToView * glm::dvec4(from, 1.0));
        const glm::dvec3 b = glm::dvec3(eye_.worldToView * glm::dvec4(to, 1.0)) - a;
        double low = 0.0;
        double high = 1.0;
        cut(-a.z, -b.z, low, high);
        for (int axis = 0; axis < 2; ++axis) {
            const double wide = eye_.halfExtent[axis];
            cut(-a.z * wide - a[axis], -b.z * wide - b[axis], low, high);
            cut(-a.z * wide + a[axis], -b.z * wide + b[axis], low, high);
        }
        addEnds(from, to - from, low, high);
    }

    // An edge of the frustum, as far as it is in the box.
    void addRay(const glm::dvec3& from, const glm::dvec3& along) {
        double low = 0.0;
        double high = 1e30;
        for (int axis = 0; axis < 3; ++axis) {
            cut(from[axis] - box_.minimum[axis], along[axis], low, high);
            cut(box_.maximum[axis] - from[axis], -along[axis], low, high);
        }
        addEnds(from, along, low, high);
    }

    void addEnds(const glm::dvec3& from, const glm::dvec3& along, double low, double high) {
        if (low > high) return;
        seen_.include(from + low * along);
        seen_.include(from + high * along);
    }

    const render::RasterView& eye_;
    glm::dmat4 toWorld_;
    scene::Bounds box_;
    scene::Bounds seen_;
};

scene::Bounds coveredBounds(const FrameBuilder& frame, MapCover covers) {
    const scene::Bounds all = receiverBounds(frame.scene());
    if (covers == MapCover::scene || all.empty) return all;
    scene::Bounds seen = SeenPart(frame.view(), all).bounds();
    if (seen.empty) return all;
    // Splats of what lies just beside the picture reach into it.
    const glm::dvec3 margin =
        0.02 * (seen.maximum - seen.minimum) + 1e-6 * glm::length(all.maximum - all.minimum);
    seen.minimum = glm::max(seen.minimum - margin, all.minimum);
    seen.maximum = glm::min(seen.maximum + margin, all.maximum);
    return seen;
}

// A perspective view wider than this wastes most of its texels on its rim.
constexpr double kWidestTangent = 2.0;

bool needsCube(const render::RasterView& view) {
    return !view.isOrthographic &&
           (view.isClipped || std::max(view.halfExtent.x, view.halfExtent.y) > kWidestTangent);
}

// Six faces of half a map's side.
constexpr double kMapsOfCube = 6.0 / 4.0;

// Of flux in the most ways that it is stored in, counts, depth, normal and reflectance.
constexpr double kBytesPerTexel = 4.0 * 6.0 * 5.0 + 4.0 * 4.0 + 8.0 + 16.0 + 8.0;

// As asked for, or halved until all maps fit into the memory that they may take.
int sideOfMaps(FrameBuilder& frame, const ReconstructParams& params, int views) {
    int side = params.mapSize;
    const double most = static_cast<double>(params.memoryMebibytes) * 1048576.0;
    while (side > 16 && kBytesPerTexel * side * side * views > most)
        side /= 2;
    if (side < params.mapSize) {
        frame.warn(
            fmt::format("Caustic maps of {} texels a side do not fit into "
                        "reconstruct.map_memory = {} MiB; they have {}.",
                        params.mapSize, params.memoryMebibytes, side));
    }
    return side;
}

int sideOfFaces(int side) {
    return std::max(side / 2, 16);
}

std::vector<ReceiverView> drawReceivers(FrameBuilder& frame, const Geometry& geometry) {
    const auto& params = frame.params<ReconstructParams>("reconstruct");
    const std::vector<scene::Light>& lights = frame.scene().lights;
    const scene::Bounds target = coveredBounds(frame, params.covers);
    std::vector<render::RasterView> views;
    double maps = 0.0;  // in sides of the size asked for
    for (const scene::Light& light : lights) {
        views.push_back(render::makeLightView(light, target, sceneBounds(frame.scene())));
        maps += needsCube(views.back()) ? kMapsOfCube : 1.0;
    }
    const int side = sideOfMaps(frame, params, static_cast<int>(std::ceil(maps)));
    std::vector<ReceiverView> receivers;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Views made =
            needsCube(views[i])
                ? frame.makeViews(
                      render::Space::cube,
                      render::makeCube(lights[i].position, views[i].nearMeters, sideOfFaces(side)))
                : frame.makeViews(render::Space::light, {render::inPixels(views[i], side, side)});
        const std::string name = i == 0 ? "light" : fmt::format("light.{}", i + 1);
        receivers.push_back(
            seeReceivers(
                frame, geometry, made, name,
                fmt::format("light '{}' stores caustics where it sees receivers", lights[i].name),
                render::DrawSet::receivers)
                .receivers);
    }
    return receivers;
}

}  // namespace

int sideOfCubeMaps(FrameBuilder& frame, int cubes) {
    const auto& params = frame.params<ReconstructParams>("reconstruct");
    return sideOfFaces(sideOfMaps(frame, params, static_cast<int>(std::ceil(kMapsOfCube * cubes))));
}

const std::vector<ReceiverView>& lightReceivers(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<std::vector<ReceiverView>>("light.receivers", [&] {
        return std::make_shared<std::vector<ReceiverView>>(drawReceivers(frame, geometry));
    });
}

}  // namespace kaustik
