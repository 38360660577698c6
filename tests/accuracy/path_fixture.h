// SPDX-License-Identifier: MIT
// Small scenes made in code, and single rays through them.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "framework/reference/light_transport.h"
#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/scene.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::reference {

inline scene::Material glass(double index) {
    scene::Material material;
    material.kind = scene::MaterialKind::dielectric;
    material.ior = static_cast<float>(index);
    return material;
}
inline scene::Material mirror() {
    scene::Material material;
    material.kind = scene::MaterialKind::mirror;
    material.albedo = glm::vec3(1.0f);
    return material;
}

inline void addObject(scene::Scene& scene, scene::Mesh mesh, const scene::Material& material,
                      const glm::dvec3& position = glm::dvec3(0.0)) {
    scene::Object object;
    object.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    object.material = static_cast<std::uint32_t>(scene.materials.size());
    object.toWorld[3] = glm::dvec4(position, 1.0);
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    scene.objects.push_back(object);
}

inline scene::Scene sceneOf(scene::Mesh mesh, const scene::Material& material) {
    scene::Scene scene;
    addObject(scene, std::move(mesh), material);
    return scene;
}

// A straight piece of a photon's path, in world coordinates.
struct PathSegment {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0};
    glm::dvec3 fluxWatts{0.0};
    int interactions = 0;

    [[nodiscard]] glm::dvec3 at(double distance) const { return origin + distance * direction; }
    // Where it crosses the plane in which `coordinate` has a value.
    [[nodiscard]] glm::dvec3 crossing(int coordinate, double value) const {
        return at((value - origin[coordinate]) / direction[coordinate]);
    }
    [[nodiscard]] double distanceFrom(const glm::dvec3& point) const {
        return glm::length(glm::cross(point - origin, direction));
    }
};

// All segments that a photon and its branches take after the first interaction.
struct SegmentRecorder : NullSink {
    explicit SegmentRecorder(const glm::dvec3& sceneCenter) : center(sceneCenter) {}
    void add(const PhotonState& photon) {
        if (photon.interactions > 0)
            segments.push_back(
                {photon.origin + center, photon.direction, photon.fluxWatts, photon.interactions});
    }
    void leftScene(const PhotonState& photon) { add(photon); }
    void arrived(const SurfaceHit&, const PhotonState& photon) { add(photon); }
    void hitSurface(const SurfaceHit&, const PhotonState& photon) { add(photon); }
    glm::dvec3 center;
    std::vector<PathSegment> segments;
};

inline std::vector<PathSegment> segmentsOf(const EmbreeScene& scene, const glm::dvec3& origin,
                                           const glm::dvec3& direction, const PathFilter& filter) {
    SegmentRecorder recorder(scene.center());
    Random random(1, 0, 0);
    PhotonState photon;
    photon.origin = origin - scene.center();
    photon.direction = glm::normalize(direction);
    photon.fluxWatts = glm::dvec3(1.0);
    LightTransport(scene, filter).follow(photon, {}, random, recorder);
    return recorder.segments;
}

// The segment after `interactions` along the refracted branch (reflected at mirrors).
inline PathSegment segmentAfter(const EmbreeScene& scene, int interactions,
                                const glm::dvec3& origin, const glm::dvec3& direction) {
    PathFilter filter;
    filter.transmissionOnly = true;
    filter.maximumInteractions = 16;
    for (const PathSegment& segment : segmentsOf(scene, origin, direction, filter)) {
        if (segment.interactions == interactions) return segment;
    }
    ADD_FAILURE() << "no segment after " << interactions << " interactions";
    return {};
}

// Where two rays of the plane z = 0 intersect: the envelope of a family, for two that are near.
inline glm::dvec2 crossingPoint(const PathSegment& a, const PathSegment& b) {
    const glm::dvec2 u(a.direction);
    const glm::dvec2 v(b.direction);
    const glm::dvec2 offset = glm::dvec2(b.origin) - glm::dvec2(a.origin);
    const double t = (offset.x * v.y - offset.y * v.x) / (u.x * v.y - u.y * v.x);
    return glm::dvec2(a.origin) + t * u;
}

}  // namespace kaustik::reference
