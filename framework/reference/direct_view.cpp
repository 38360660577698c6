// SPDX-License-Identifier: MIT
#include "framework/reference/direct_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "framework/reference/eye.h"
#include "framework/reference/random.h"
#include "framework/reference/receivers.h"
#include "framework/reference/threads.h"

namespace kaustik::reference {
namespace {

class Tracer {
  public:
    Tracer(const EmbreeScene& scene, const DirectViewRequest& request, DirectView& view)
        : scene_(scene),
          eye_(scene, request.width, request.height),
          receivers_(scene),
          request_(request),
          view_(view) {}

    void traceRow(int row) const {
        for (int column = 0; column < request_.width; ++column)
            tracePixel(column, row);
    }

  private:
    struct Sample {
        glm::dvec3 direct{0.0};
        glm::dvec3 fill{0.0};
        std::uint32_t object = 0;
        bool hasGlass = false;
    };

    // Nothing where the ray ends on no plain receiver.
    [[nodiscard]] std::optional<Sample> sample(double column, double row) const {
        const glm::dvec3 ray = eye_.ray(column, row);
        const glm::dvec3 origin = eye_.position() + eye_.nearMeters() * ray;
        const glm::dvec3 direction = glm::normalize(ray);
        SurfaceHit hit;
        if (!scene_.intersectStraight(origin, direction, hit)) return std::nullopt;
        const scene::Material& material = scene_.scene().materials[hit.material];
        if (material.kind != scene::MaterialKind::lambertian ||
            material.emission != glm::vec3(0.0f))
            return std::nullopt;
        Sample result;
        result.object = hit.triangle.object;
        result.direct = receivers_.radiance(hit, direction);
        // Without light all that it has is by the fill light, of which the scene has a known part.
        result.fill = scene_.appearance().albedo(hit.material, hit.uv) / glm::pi<double>();
        result.direct -= glm::dvec3(scene_.scene().ambientIrradiance) * result.fill;
        Ray eyeRay;
        eyeRay.origin = origin;
        eyeRay.direction = direction;
        eyeRay.sides = SideRule::any;
        SurfaceHit first;
        result.hasGlass =
            scene_.intersect(eyeRay, first) &&
            scene_.scene().materials[first.material].kind == scene::MaterialKind::dielectric;
        return result;
    }

    void tracePixel(int column, int row) const {
        const int side = request_.samplesPerSide;
        Random random(request_.seed, 2,
                      static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(request_.width) +
                          static_cast<std::uint64_t>(column));
        glm::dvec3 direct(0.0);
        glm::dvec3 fill(0.0);
        bool isPlain = true;
        bool hasGlass = false;
        std::optional<std::uint32_t> object;
        for (int i = 0; i < side * side; ++i) {
            const double x = column + (i % side + random.uniform()) / side;
            const double y = row + (i / side + random.uniform()) / side;
            const std::optional<Sample> found = sample(x, y);
            isPlain = isPlain && found && object.value_or(found->object) == found->object;
            if (!found) continue;
            object = found->object;
            direct += found->direct;
            fill += found->fill;
            hasGlass = hasGlass || found->hasGlass;
        }
        for (int c = 0; c < 3; ++c) {
            view_.direct.at(column, row, c) = static_cast<float>(direct[c] / (side * side));
            view_.fill.at(column, row, c) = static_cast<float>(fill[c] / (side * side));
        }
        view_.isPlain.at(column, row, 0) = isPlain ? 1.0f : 0.0f;
        view_.hasGlass.at(column, row, 0) = hasGlass ? 1.0f : 0.0f;
    }

    const EmbreeScene& scene_;
    Eye eye_;
    Receivers receivers_;
    DirectViewRequest request_;
    DirectView& view_;
};

}  // namespace

DirectView traceDirectView(const EmbreeScene& scene, const DirectViewRequest& request) {
    DirectView view;
    view.direct = Image(request.width, request.height, 3);
    view.fill = Image(request.width, request.height, 3);
    view.isPlain = Image(request.width, request.height, 1);
    view.hasGlass = Image(request.width, request.height, 1);
    const Tracer tracer(scene, request, view);
    runWithThreads(request.threads, [&] {
        tbb::parallel_for(0, request.height, [&](int row) { tracer.traceRow(row); });
    });
    return view;
}

}  // namespace kaustik::reference
