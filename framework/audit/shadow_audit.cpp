// SPDX-License-Identifier: MIT
#include "framework/audit/shadow_audit.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "framework/reference/eye.h"
#include "framework/reference/shadow_rays.h"

namespace kaustik::audit {
namespace {

// Light that grazes more is left out: there a shadow has no part in how bright the surface is.
constexpr double kLeastCosine = 0.01;

// The direction to the light and how far it is; no distance for one without a place.
struct LightPath {
    glm::dvec3 direction;
    double meters;
};

LightPath pathTo(const scene::Light& light, const glm::dvec3& from, const glm::dvec3& sceneCenter) {
    if (light.kind == scene::LightKind::directional)
        return {-light.direction, std::numeric_limits<double>::infinity()};
    const glm::dvec3 offset = light.position - sceneCenter - from;
    const double meters = glm::length(offset);
    return {meters > 0.0 ? offset / meters : -light.direction, meters};
}

}  // namespace

void ShadowAudit::add(const ShadowAudit& other) {
    asked += other.asked;
    inShadow += other.inShadow;
    litTakenForShadow += other.litTakenForShadow;
    shadowTakenForLit += other.shadowTakenForLit;
}

ShadowAudit auditShadow(const Image& visibility, std::size_t light,
                        const reference::EmbreeScene& scene) {
    const scene::Light& source = scene.scene().lights[light];
    const reference::Eye eye(scene, visibility.width, visibility.height);
    const reference::ShadowRays shadowRays(scene);
    ShadowAudit audit;
    for (int y = 0; y < visibility.height; ++y) {
        for (int x = 0; x < visibility.width; ++x) {
            reference::SurfaceHit seen;
            const glm::dvec3 ray = glm::normalize(eye.ray(x + 0.5, y + 0.5));
            if (!scene.intersectStraight(eye.position(), ray, seen)) continue;
            if (!isReceiver(scene.scene().materials[seen.material].kind)) continue;
            const LightPath path = pathTo(source, seen.position, scene.center());
            const bool seesFront = glm::dot(seen.geometricNormal, ray) < 0.0;
            const double side = seesFront ? 1.0 : -1.0;
            // Both normals must face the light: what a shading normal alone turns to it is in the
            // shadow of its own triangle.
            if (side * glm::dot(seen.geometricNormal, path.direction) < kLeastCosine ||
                side * glm::dot(seen.shadingNormal, path.direction) < kLeastCosine) {
                continue;
            }
            const bool isBlocked = shadowRays.isBlocked(seen, side * seen.geometricNormal,
                                                        path.direction, path.meters);
            const bool isDark = !(visibility.at(x, y, 0) > 0.5f);
            ++audit.asked;
            audit.inShadow += isBlocked ? 1 : 0;
            audit.litTakenForShadow += isDark && !isBlocked ? 1 : 0;
            audit.shadowTakenForLit += !isDark && isBlocked ? 1 : 0;
        }
    }
    return audit;
}

nlohmann::json toJson(const ShadowAudit& audit) {
    const auto share = [&](std::size_t part) -> nlohmann::json {
        if (audit.asked == 0) return nullptr;
        return static_cast<double>(part) / static_cast<double>(audit.asked);
    };
    return {{"pixels", audit.asked},
            {"in_shadow", share(audit.inShadow)},
            {"misclassified", share(audit.litTakenForShadow + audit.shadowTakenForLit)},
            {"lit_taken_for_shadow", share(audit.litTakenForShadow)},
            {"shadow_taken_for_lit", share(audit.shadowTakenForLit)}};
}

}  // namespace kaustik::audit
