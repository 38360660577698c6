// SPDX-License-Identifier: MIT
#include "framework/scene/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "framework/scene/meshes/position_welding.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::scene {
namespace {

// How far a face's corners may lie next to its plane, in the mesh's sizes: a float's rounding.
constexpr double kFlat = 1e-6;

struct Triangle {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 area{0.0};    // twice the area, along the normal
    glm::dvec3 normal{0.0};  // unit; 0 where there is no area
};

// Sets of triangles that are joined one by one (union-find).
class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t of(std::size_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

  private:
    std::vector<std::size_t> parent_;
};

Triangle triangleOf(const Mesh& mesh, std::size_t index, double size) {
    const glm::uvec3& t = mesh.triangles[index];
    Triangle one;
    for (int i = 0; i < 3; ++i)
        one.corners[static_cast<std::size_t>(i)] = glm::dvec3(mesh.positions[t[i]]);
    one.area = glm::cross(one.corners[1] - one.corners[0], one.corners[2] - one.corners[0]);
    const double length = glm::length(one.area);
    if (length > kFlat * kFlat * size * size) one.normal = one.area / length;
    return one;
}

bool isOnPlane(const Triangle& plane, const Triangle& other, double size) {
    if (!(glm::dot(plane.normal, other.normal) > 0.0)) return false;
    return std::all_of(other.corners.begin(), other.corners.end(), [&](const glm::dvec3& corner) {
        return std::abs(glm::dot(corner - plane.corners[0], plane.normal)) <= kFlat * size;
    });
}

// Whether a triangle shares an edge with another one of its plane, if it has an area at all.
bool hasNeighbour(const Mesh& mesh, std::size_t index, double size) {
    const Triangle triangle = triangleOf(mesh, index, size);
    if (triangle.normal == glm::dvec3(0.0)) return true;
    for (std::size_t other = 0; other < mesh.triangles.size(); ++other) {
        int shared = 0;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& a = mesh.positions[mesh.triangles[other][i]];
            for (int j = 0; j < 3; ++j)
                shared += a == mesh.positions[mesh.triangles[index][j]] ? 1 : 0;
        }
        if (shared == 2 && isOnPlane(triangle, triangleOf(mesh, other, size), size)) return true;
    }
    return false;
}

// Sets of coplanar triangles that share edges.
Sets joinCoplanar(const Mesh& mesh, const std::vector<Triangle>& triangles, double size) {
    const std::vector<std::uint32_t> welded = weldPositions(mesh.positions);
    struct Edge {
        std::uint32_t low, high;
        std::size_t triangle;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (triangles[t].normal == glm::dvec3(0.0)) continue;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = welded[mesh.triangles[t][i]];
            const std::uint32_t b = welded[mesh.triangles[t][(i + 1) % 3]];
            edges.push_back({std::min(a, b), std::max(a, b), t});
        }
    }
    const auto key = [](const Edge& edge) { return std::pair(edge.low, edge.high); };
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
    Sets sets(triangles.size());
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
        for (end = first + 1; end < edges.size() && key(edges[end]) == key(edges[first]); ++end) {
            for (std::size_t other = first; other < end; ++other) {
                const Triangle& a = triangles[edges[other].triangle];
                const Triangle& b = triangles[edges[end].triangle];
                if (isOnPlane(a, b, size) && isOnPlane(b, a, size))
                    sets.join(edges[other].triangle, edges[end].triangle);
            }
        }
    }
    return sets;
}

// The corners of the convex hull of points in a plane, counter-clockwise about `normal`; those that
// lie between others are none (Andrew's monotone chain).
std::vector<glm::dvec3> hullOf(const std::vector<glm::dvec3>& points, const glm::dvec3& normal,
                               double size) {
    const glm::dvec3 neighbour =
        std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(neighbour, normal));
    const glm::dvec3 v = glm::cross(normal, u);
    struct Flat {
        glm::dvec2 at;
        std::size_t point;
    };
    std::vector<Flat> flat;
    for (std::size_t i = 0; i < points.size(); ++i)
        flat.push_back({{glm::dot(points[i], u), glm::dot(points[i], v)}, i});
    std::sort(flat.begin(), flat.end(), [](const Flat& a, const Flat& b) {
        return std::pair(a.at.x, a.at.y) < std::pair(b.at.x, b.at.y);
    });
    std::vector<Flat> hull;
    const auto add = [&](const Flat& next, std::size_t keep) {
        while (hull.size() >= keep + 2) {
            const glm::dvec2 before = hull.back().at - hull[hull.size() - 2].at;
            const glm::dvec2 after = next.at - hull.back().at;
            const double turn = before.x * after.y - before.y * after.x;
            // Points on an edge lie within rounding of it, on either side.
            if (turn > kFlat * size * glm::length(before + after)) break;
            hull.pop_back();
        }
        hull.push_back(next);
    };
    for (const Flat& next : flat)
        add(next, 0);
    const std::size_t lower = hull.size();
    for (std::size_t i = flat.size() - 1; i-- > 0;)
        add(flat[i], lower - 1);
    if (!hull.empty()) hull.pop_back();
    std::vector<glm::dvec3> corners;
    for (const Flat& corner : hull)
        corners.push_back(points[corner.point]);
    return corners;
}

// What these triangles fill, if it is a parallelogram.
std::optional<Parallelogram> parallelogramOf(const std::vector<const Triangle*>& triangles,
                                             double size) {
    const Triangle& largest = **std::max_element(
        triangles.begin(), triangles.end(), [](const Triangle* a, const Triangle* b) {
            return glm::dot(a->area, a->area) < glm::dot(b->area, b->area);
        });
    std::vector<glm::dvec3> points;
    double filled = 0.0;
    for (const Triangle* triangle : triangles) {
        if (!isOnPlane(largest, *triangle, size)) return std::nullopt;
        filled += 0.5 * glm::length(triangle->area);
        points.insert(points.end(), triangle->corners.begin(), triangle->corners.end());
    }
    const std::vector<glm::dvec3> hull = hullOf(points, largest.normal, size);
    if (hull.size() != 4) return std::nullopt;
    if (glm::length(hull[0] + hull[2] - hull[1] - hull[3]) > 4.0 * kFlat * size)
        return std::nullopt;
    Parallelogram face{hull[0], hull[1] - hull[0], hull[3] - hull[0], {}};
    const glm::dvec3 area = glm::cross(face.edgeU, face.edgeV);
    // Neither holes nor parts that lie on each other.
    const double rounding =
        4.0 * kFlat * size * (glm::length(face.edgeU) + glm::length(face.edgeV));
    if (std::abs(glm::length(area) - filled) > rounding) return std::nullopt;
    face.normal = glm::normalize(area);
    return face;
}

bool isStill(const HeightField& field) {
    return std::all_of(field.waves.begin(), field.waves.end(),
                       [](const Wave& wave) { return wave.amplitudeMeters == 0.0f; });
}

}  // namespace

std::vector<Parallelogram> flatFaces(const Mesh& mesh) {
    if (mesh.heightField && !isStill(*mesh.heightField)) return {};
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions)
        bounds.include(position);
    const double size = glm::length(bounds.maximum - bounds.minimum);
    // A few triangles tell most curved meshes, however large, at once.
    const std::size_t step = std::max<std::size_t>(mesh.triangles.size() / 8, 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
        if (!hasNeighbour(mesh, t, size)) return {};
    }
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        triangles.push_back(triangleOf(mesh, t, size));
    Sets sets = joinCoplanar(mesh, triangles, size);
    std::vector<std::vector<const Triangle*>> members(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (triangles[t].normal != glm::dvec3(0.0)) members[sets.of(t)].push_back(&triangles[t]);
    }
    std::vector<Parallelogram> faces;
    for (const std::vector<const Triangle*>& set : members) {
        if (set.empty()) continue;
        const std::optional<Parallelogram> face =
            set.size() < 2 ? std::nullopt : parallelogramOf(set, size);
        if (!face) return {};
        faces.push_back(*face);
    }
    return faces;
}

FlatReceivers flatReceivers(const Scene& scene) {
    FlatReceivers result;
    result.isFlat.resize(scene.objects.size());
    // Meshes may be placed more than once.
    std::vector<std::optional<std::vector<Parallelogram>>> ofMesh(scene.meshes.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const Mesh& mesh = scene.meshes[object.mesh];
        if (!isReceiver(scene.materials[object.material].kind) || mesh.triangles.empty()) continue;
        std::optional<std::vector<Parallelogram>>& faces = ofMesh[object.mesh];
        if (!faces) faces = flatFaces(mesh);
        result.isFlat[i] = !faces->empty();
        if (faces->empty()) result.others.push_back(object.name);
        const glm::dmat3 linear(object.toWorld);
        const glm::dmat3 normalToWorld = glm::transpose(glm::inverse(linear));
        for (const Parallelogram& face : *faces) {
            const glm::dvec4 corner(mesh.origin + face.corner, 1.0);
            result.faces.push_back(
                {{glm::dvec3(object.toWorld * corner), linear * face.edgeU, linear * face.edgeV,
                  glm::normalize(normalToWorld * face.normal)},
                 object.material});
        }
    }
    return result;
}

}  // namespace kaustik::scene
