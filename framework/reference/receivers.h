// SPDX-License-Identifier: MIT
// What receivers send out by direct and fill light: everything specular blocks direct light
// (shadow_rays.h), and lights that have a size are the points that stand for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <vector>

#include "framework/reference/shadow_rays.h"
#include "framework/scene/light_paths.h"

namespace kaustik::reference {

// Irradiance that a light sends to a point, on a surface that faces it, if nothing is in the way.
struct Arriving {
    glm::dvec3 irradiance{0.0};
    glm::dvec3 toLight{0.0};  // unit
    double distance = std::numeric_limits<double>::infinity();
};

// Radiance of receivers by direct and fill light.
class Receivers {
  public:
    explicit Receivers(const EmbreeScene& scene) : scene_(scene), shadowRays_(scene) {
        isOpen_ = openMaterials(scene.scene());
    }

    // Along `direction` (unit, towards the receiver), W/m²/sr.
    [[nodiscard]] glm::dvec3 radiance(const SurfaceHit& hit, const glm::dvec3& direction) const {
        const scene::Scene& scene = scene_.scene();
        const scene::Material& material = scene.materials[hit.material];
        const Appearance& appearance = scene_.appearance();
        // A sheet is lit on the side that is looked at.
        const bool isTurned =
            isOpen_[hit.material] && glm::dot(direction, hit.geometricNormal) > 0.0;
        const double side = isTurned ? -1.0 : 1.0;
        const glm::dvec3 shading = side * hit.shadingNormal;
        const glm::dvec3 geometric = side * hit.geometricNormal;
        glm::dvec3 sum = glm::dvec3(scene.ambientIrradiance) *
                         (appearance.albedo(hit.material, hit.uv) + glm::dvec3(material.specular)) /
                         glm::pi<double>();
        for (const scene::Light& light : scene.lights) {
            if (light.band > 0) continue;
            const Arriving arriving = fromLight(light, hit.position);
            const double cosine = glm::dot(shading, arriving.toLight);
            if (cosine <= 0.0 || glm::dot(geometric, arriving.toLight) <= 0.0) continue;
            if (arriving.irradiance == glm::dvec3(0.0) ||
                shadowRays_.isBlocked(hit, geometric, arriving.toLight, arriving.distance)) {
                continue;
            }
            sum += arriving.irradiance * cosine *
                   appearance.brdf(hit.material, hit.uv, shading, arriving.toLight, -direction);
        }
        return sum;
    }

  private:
    [[nodiscard]] Arriving fromLight(const scene::Light& light, const glm::dvec3& position) const {
        Arriving arriving;
        arriving.irradiance = glm::dvec3(light.power);
        const WayToLight way = wayTo(light, position, scene_.center());
        if (!(way.meters > 0.0)) return {};
        arriving.toLight = way.direction;
        arriving.distance = way.meters;
        if (light.kind == scene::LightKind::directional) return arriving;
        const double range = static_cast<double>(light.rangeMeters);
        if (range > 0.0 && arriving.distance > range) return {};
        arriving.irradiance /= arriving.distance * arriving.distance;
        if (light.kind == scene::LightKind::surface)
            arriving.irradiance *= std::max(glm::dot(-arriving.toLight, light.direction), 0.0);
        if (light.kind == scene::LightKind::spot) {
            const double falloff = spotFalloff(light, glm::dot(-arriving.toLight, light.direction));
            if (falloff <= 0.0) return {};
            arriving.irradiance *=
                falloff * scene_.appearance().spotColor(light, -arriving.toLight);
        }
        return arriving;
    }

    const EmbreeScene& scene_;
    ShadowRays shadowRays_;
    std::vector<bool> isOpen_;  // by material
};

}  // namespace kaustik::reference
