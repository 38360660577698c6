// SPDX-License-Identifier: MIT
// Procedural shapes as triangle meshes. Lengths are in metres, in the shape's own space, centred on
// its origin unless said otherwise. Triangles run counter-clockwise as seen from outside, normals
// are those of the exact surface, and Mesh::closed says whether the shape bounds a volume. Flat
// faces have uv in metres from a corner of the face, so that a pattern has the same size on all.
// Every function throws ConfigError that names the value at fault, as scene files spell it
// (top_radius), and says what is allowed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// The largest number of steps along one side of a grid or around a circle: finer meshes than
// 2048 x 2048 quads would not fit next to the rest of a scene.
inline constexpr unsigned kMaximumCells = 2048;

// A rectangle in the xz-plane that faces +y.
struct PlaneShape {
    glm::dvec2 size{1.0};
    glm::uvec2 cells{1};
};
[[nodiscard]] Mesh makePlane(const PlaneShape& shape);

// A disc in the xz-plane that faces +y.
struct DiscShape {
    double radius = 0.5;
    unsigned segments = 128;
};
[[nodiscard]] Mesh makeDisc(const DiscShape& shape);

enum BoxFace { minusX, plusX, minusY, plusY, minusZ, plusZ };

// A box with flat faces; 24 vertices when whole. Inward: a room, seen from inside.
struct BoxShape {
    glm::dvec3 size{1.0};
    bool inward = false;
    std::array<bool, 6> open{};  // by BoxFace: faces that are left out
};
[[nodiscard]] Mesh makeBox(const BoxShape& shape);

// A ball as a cube blown up: even triangles and no poles. segments: edges around the equator, a
// multiple of 4 (rounded up).
struct SphereShape {
    double radius = 0.5;
    unsigned segments = 128;
};
[[nodiscard]] Mesh makeSphere(const SphereShape& shape);

// A cylinder about the y axis. Open: without its two caps. Inward: its inside is the outside, so
// that an open mirror concentrates light within.
struct CylinderShape {
    double radius = 0.5;
    double height = 1.0;
    bool open = false;
    bool inward = false;
    unsigned segments = 128;
};
[[nodiscard]] Mesh makeCylinder(const CylinderShape& shape);

// A tree without leaves that stands on its origin: each branch a closed tapering tube with
// `children` branches of its own, down to `levels`. The same for a seed on every machine; about
// `height` high.
struct TreeShape {
    double height = 3.0;
    double trunkRadius = 0.1;
    unsigned levels = 5;
    unsigned children = 3;
    unsigned sides = 6;
    double spreadDegrees = 38.0;  // between a branch and what it grows from
    std::uint64_t seed = 1;
};
[[nodiscard]] Mesh makeTree(const TreeShape& shape);

// A finger ring about the y axis: a tube with flat walls and a square edge.
struct RingShape {
    double innerRadius = 0.45;
    double outerRadius = 0.5;
    double height = 0.2;
    unsigned segments = 256;
};
[[nodiscard]] Mesh makeRing(const RingShape& shape);

// A torus about the y axis; radius: from the axis to the middle of the tube.
struct TorusShape {
    double radius = 0.5;
    double tubeRadius = 0.15;
    unsigned segments = 128;
    unsigned tubeSegments = 64;
};
[[nodiscard]] Mesh makeTorus(const TorusShape& shape);

// A lens with spherical faces whose axis is y; the origin lies midway between the two vertices.
// A radius of curvature is positive for a convex face, negative for a concave one and 0 for a flat
// one, on either side. Of the two thicknesses one is given, the other 0.
struct LensShape {
    double topRadius = 1.0;
    double bottomRadius = 1.0;
    double diameter = 1.0;
    double centerThickness = 0.0;
    double edgeThickness = 0.0;
    unsigned segments = 128;
};
[[nodiscard]] Mesh makeLens(const LensShape& shape);

// A triangular prism: an isosceles section in the xy-plane, apex up, extended along z.
struct PrismShape {
    double apexDegrees = 60.0;
    double height = 1.0;  // from base to apex
    double length = 2.0;
};
[[nodiscard]] Mesh makePrism(const PrismShape& shape);

// A concave mirror y = (x² + z²)/4f with its vertex at the origin; normals on the side of the
// focus, which is (0, f, 0).
struct ParaboloidShape {
    double focalLength = 1.0;
    double diameter = 1.0;
    unsigned segments = 128;
};
[[nodiscard]] Mesh makeParaboloid(const ParaboloidShape& shape);

}  // namespace kaustik::scene
