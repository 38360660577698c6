// SPDX-License-Identifier: MIT
// The scene of a certificate: what the scene file's geometry is. Positions and normals of corners
// are those of the reference (reference/embree_scene.h): 32-bit floats in local coordinates, the
// world's less the middle of the scene, m. Between the corners everything is exact: planes, and
// normals that are interpolated and then of unit length.
//
// A facet is a convex flat polygon: a triangle, or, of a receiver, two that make one rectangle
// along the axes of the scene, so that no border runs through it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/certify/jet.h"
#include "framework/certify/polygon.h"
#include "framework/scene/scene.h"

namespace kaustik::certify {

using Vec = Vector<Interval>;
[[nodiscard]] inline Vec exact(const glm::dvec3& v) {
    return {Interval(v.x), Interval(v.y), Interval(v.z)};
}

struct Box {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
    void include(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

struct Facet {
    std::size_t corners = 3;
    std::array<glm::dvec3, 4> position;  // local, exact
    std::array<glm::dvec3, 3> normal;    // of a specular triangle's corners, of any length
    Vec area;                            // encloses the cross product of two sides
    glm::dvec3 unit{0.0};                // about its normal,
    double unitError = 0.0;              // and by how much it may be off
    std::uint32_t object = 0;
    std::uint32_t material = 0;
    scene::MaterialKind kind = scene::MaterialKind::lambertian;
    bool isClosed = false;  // its mesh is
    [[nodiscard]] bool isReceiver() const { return scene::isReceiver(kind); }
};

// Lights that a certificate knows, in local coordinates.
struct Source {
    bool isDistant = true;
    Vec direction;             // of a distant one: encloses the unit vector
    glm::dvec3 position{0.0};  // of a near one
    glm::vec3 power{0.0f};     // W/m², or W/sr
    std::string name;
};

class Geometry {
  public:
    // Throws ConfigError that says what of the scene cannot be certified.
    explicit Geometry(const scene::Scene& scene);

    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }
    [[nodiscard]] const std::vector<Source>& sources() const { return sources_; }
    [[nodiscard]] const glm::dvec3& center() const { return center_; }
    // The size of coordinates, m; lengths of this times kNear are taken to be 0 on either side.
    [[nodiscard]] double size() const { return size_; }
    [[nodiscard]] bool absorbs() const { return absorbs_; }

    // Calls `visit` for all facets that a box which moves from `start` along directions from
    // `velocity`, for times from 0 to `end`, may meet.
    void sweep(const Vec& start, const Vec& velocity, double end,
               const std::function<void(std::uint32_t)>& visit) const;

  private:
    void addObject(const scene::Object& object);
    void addReceivers(const std::vector<glm::dvec3>& positions,
                      const std::vector<glm::uvec3>& triangles, const Facet& like);
    void addFacet(Facet facet);
    void build();
    void addNode(std::size_t first, std::size_t end);

    struct Node {
        Box box;
        std::uint32_t first = 0;  // of a leaf its first facet, else the second child
        std::uint32_t count = 0;
    };
    const scene::Scene& scene_;
    glm::dvec3 center_{0.0};
    double size_ = 1.0;
    bool absorbs_ = false;
    std::vector<Facet> facets_;
    std::vector<Source> sources_;
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

// Of coordinates' size: far above what is rounded, far below what is seen.
inline constexpr double kNear = 1e-10;

// The part of the facet that is in front of the plane of `ground`, seen from `from`: its corners,
// or nothing. Side::outer: all that may be; Side::inner: what is for sure, by a hair of kNear of
// `size`. Corners that are made are exact to far less than that.
[[nodiscard]] std::vector<glm::dvec3> partBefore(const Facet& facet, const Facet& ground,
                                                 const glm::dvec3& from, double size, Side side);

}  // namespace kaustik::certify
