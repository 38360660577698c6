// SPDX-License-Identifier: MIT
#include "framework/audit/shadow_audit.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "framework/core/json_schema.h"
#include "framework/reference/eye.h"
#include "framework/reference/shadow_rays.h"

namespace kaustik::audit {
namespace {

// Light that grazes more is left out: there a shadow has no part in how bright the surface is.
constexpr double kMinCosine = 0.01;

}  // namespace

void ShadowAudit::add(const ShadowAudit& other) {
    tested += other.tested;
    inShadow += other.inShadow;
    falseShadow += other.falseShadow;
    falseLit += other.falseLit;
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
            const reference::WayToLight way =
                reference::wayTo(source, seen.position, scene.center());
            const bool seesFront = glm::dot(seen.geometricNormal, ray) < 0.0;
            const double side = seesFront ? 1.0 : -1.0;
            // Both normals must face the light: what a shading normal alone turns to it is in the
            // shadow of its own triangle.
            if (side * glm::dot(seen.geometricNormal, way.direction) < kMinCosine ||
                side * glm::dot(seen.shadingNormal, way.direction) < kMinCosine) {
                continue;
            }
            const bool isBlocked =
                shadowRays.isBlocked(seen, side * seen.geometricNormal, way.direction, way.meters);
            const bool isDark = !(visibility.at(x, y, 0) > 0.5f);
            ++audit.tested;
            audit.inShadow += isBlocked ? 1 : 0;
            audit.falseShadow += isDark && !isBlocked ? 1 : 0;
            audit.falseLit += !isDark && isBlocked ? 1 : 0;
        }
    }
    return audit;
}

template <class F>
void reflect(F& f, const ShadowAudit& audit) {
    const auto share = [&](const char* key, std::size_t part, const char* sentence) {
        const double of = static_cast<double>(audit.tested);
        f.fieldOrNull(
            key, audit.tested > 0 ? std::optional(static_cast<double>(part) / of) : std::nullopt,
            "", sentence);
    };
    f.field("pixels", audit.tested, "Whose middle sees a receiver that faces a light, by light");
    share("in_shadow", audit.inShadow, "Of them those that are in shadow");
    share("misclassified", audit.falseShadow + audit.falseLit,
          "Of them those that are taken for the other");
    share("lit_taken_for_shadow", audit.falseShadow, "");
    share("shadow_taken_for_lit", audit.falseLit, "");
}

nlohmann::json toJson(const ShadowAudit& audit) {
    return jsonOf(audit);
}

nlohmann::json shadowSchema() {
    return jsonSchemaOf<ShadowAudit>();
}

}  // namespace kaustik::audit
