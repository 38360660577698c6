// SPDX-License-Identifier: MIT
#include "techniques/generators/light_reach.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "framework/scene/flat_faces.h"

namespace kaustik {
namespace {

using glm::dvec3;

// Of lengths: of the scene's size; of a wall's sides: of themselves. A ray on the very edge of a
// wall carries nothing.
constexpr double kRounding = 1e-9;
// By so much the picture is taken for larger than it is on each side: a pixel shows a mean over
// what lies around it.
constexpr double kFrustumMargin = 0.05;
// A piece of a receiver is halved so often where no wall's plane cuts it.
constexpr int kMaxHalvings = 5;
// Steps of the proof for one object; what has not been proved by then is not.
constexpr int kMaxSteps = 4000;
// Largest walls that are asked.
constexpr std::size_t kMaxWalls = 128;

using Points = std::vector<dvec3>;  // of a convex hull; of a polygon in order

struct Plane {
    dvec3 normal;  // unit
    double offset = 0.0;
    [[nodiscard]] double heightOf(const dvec3& point) const {
        return glm::dot(normal, point) - offset;
    }
};

struct Wall {
    scene::Parallelogram shape;
    Plane plane;
    // The shares of the edges at a point of the plane.
    [[nodiscard]] bool holds(const dvec3& point) const {
        const dvec3 offset = point - shape.corner;
        const dvec3 area = glm::cross(shape.edgeU, shape.edgeV);
        const double square = glm::dot(area, area);
        const double u = glm::dot(glm::cross(offset, shape.edgeV), area);
        const double v = glm::dot(glm::cross(shape.edgeU, offset), area);
        const double slack = kRounding * square;
        return u >= -slack && u <= square + slack && v >= -slack && v <= square + slack;
    }
};

// A receiver, or a part of one: a polygon, or the box of one that is not flat.
struct Target {
    Points points;
    bool isFlat = false;
    Plane plane;  // of a flat one
};

// The lowest and the highest of the points over a plane.
std::pair<double, double> heights(const Plane& plane, const Points& points) {
    std::pair<double, double> range{1e300, -1e300};
    for (const dvec3& point : points) {
        const double height = plane.heightOf(point);
        range.first = std::min(range.first, height);
        range.second = std::max(range.second, height);
    }
    return range;
}

Points cornersOf(const scene::Bounds& box) {
    Points corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners.emplace_back((i & 1U) != 0 ? box.maximum.x : box.minimum.x,
                             (i & 2U) != 0 ? box.maximum.y : box.minimum.y,
                             (i & 4U) != 0 ? box.maximum.z : box.minimum.z);
    }
    return corners;
}

// The part of a convex polygon on the side of a plane that its normal points to.
Points above(const Points& polygon, const Plane& plane) {
    Points part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3& a = polygon[i];
        const dvec3& b = polygon[(i + 1) % polygon.size()];
        const double heightA = plane.heightOf(a);
        const double heightB = plane.heightOf(b);
        if (heightA >= 0.0) part.push_back(a);
        if ((heightA > 0.0 && heightB < 0.0) || (heightA < 0.0 && heightB > 0.0))
            part.push_back(a + heightA / (heightA - heightB) * (b - a));
    }
    return part;
}

Plane turned(const Plane& plane) {
    return {-plane.normal, -plane.offset};
}

// Who sees receivers, or lights them: a point, or all of a box.
struct Source {
    Points points;
    bool isEye = false;
};

class Reach {
  public:
    Reach(const scene::Scene& scene, const render::RasterView& eye) : scene_(scene) {
        const scene::Bounds all = sceneBounds(scene);
        size_ = all.empty ? 1.0 : glm::length(all.maximum - all.minimum);
        addReceivers();
        addFrustum(eye);
        for (const scene::Object& object : scene.objects) {
            const scene::Bounds bounds = objectBounds(scene, object);
            const bool isSpecular =
                !isReceiver(scene.materials[object.material].kind) && !bounds.empty;
            boxes_.push_back(isSpecular ? cornersOf(bounds) : Points{});
        }
    }

    [[nodiscard]] std::vector<bool> result() {
        std::vector<bool> may(boxes_.size(), true);
        std::vector<bool> isSeen(boxes_.size(), false);
        for (std::size_t i = 0; i < boxes_.size(); ++i)
            isSeen[i] = !boxes_[i].empty() && isInFrustum(boxes_[i]) && !isBlocked(eye_, boxes_[i]);
        isSeen = closure(isSeen);
        std::vector<Source> eyes{{eye_, true}};
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            if (isSeen[i]) eyes.push_back({boxes_[i]});
        }
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            if (boxes_[i].empty() || isSeen[i]) continue;
            std::vector<bool> own(boxes_.size(), false);
            own[i] = true;
            may[i] = meets(closure(own), isSeen, eyes);
        }
        return may;
    }

  private:
    void addReceivers() {
        const scene::FlatReceivers flat = scene::flatReceivers(scene_);
        for (const scene::FlatReceivers::Face& face : flat.faces) {
            const scene::Parallelogram& shape = face.shape;
            const Plane plane{shape.normal, glm::dot(shape.normal, shape.corner)};
            walls_.push_back({shape, plane});
            const dvec3 far = shape.corner + shape.edgeU + shape.edgeV;
            targets_.push_back(
                {{shape.corner, shape.corner + shape.edgeU, far, shape.corner + shape.edgeV},
                 true,
                 plane});
        }
        const auto areaOf = [](const Wall& wall) {
            return glm::length(glm::cross(wall.shape.edgeU, wall.shape.edgeV));
        };
        std::stable_sort(walls_.begin(), walls_.end(),
                         [&](const Wall& a, const Wall& b) { return areaOf(a) > areaOf(b); });
        if (walls_.size() > kMaxWalls) walls_.resize(kMaxWalls);
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            const scene::Object& object = scene_.objects[i];
            if (!isReceiver(scene_.materials[object.material].kind) || flat.isFlat[i]) continue;
            const scene::Bounds bounds = objectBounds(scene_, object);
            if (!bounds.empty) targets_.push_back({cornersOf(bounds), false, {}});
        }
    }

    void addFrustum(const render::RasterView& eye) {
        const glm::dmat4 toWorld = glm::inverse(eye.worldToView);
        const dvec3 position(toWorld[3]);
        const glm::dmat3 turn(toWorld);
        const auto add = [&](const dvec3& insideVs) {
            const dvec3 normal = glm::normalize(turn * insideVs);
            frustum_.push_back({normal, glm::dot(normal, position)});
        };
        const glm::dvec2 wide = (1.0 + kFrustumMargin) * eye.halfExtent;
        // A wall nearer than the near plane is not drawn, and hides nothing.
        eye_ = {position};
        for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            eye_.push_back(position + eye.nearMeters * (turn * dvec3(corner * wide, -1.0)));
        add({0.0, 0.0, -1.0});
        add({1.0, 0.0, -wide.x});
        add({-1.0, 0.0, -wide.x});
        add({0.0, 1.0, -wide.y});
        add({0.0, -1.0, -wide.y});
    }

    [[nodiscard]] bool isInFrustum(const Points& points) const {
        return std::all_of(frustum_.begin(), frustum_.end(), [&](const Plane& plane) {
            return heights(plane, points).second >= 0.0;
        });
    }

    // Whether one wall is in every way from the one convex body to the other. What lies between two
    // points of them on the wall's plane is a mean of where it lies between corners: seen from one
    // point a plane's picture of a hull is the hull of the corners' pictures, twice over.
    [[nodiscard]] bool isBlocked(const Points& source, const Points& target) const {
        return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
            Plane plane = wall.plane;
            auto [low, high] = heights(plane, source);
            if (low < 0.0) {
                plane = turned(plane);
                std::tie(low, high) = std::pair(-high, -low);
            }
            const double slack = kRounding * size_;
            const auto beyond = heights(plane, target);
            // What lies in the wall itself is not behind it; what ends at it is.
            if (low <= slack || beyond.first >= -slack || beyond.second > slack) return false;
            for (const dvec3& from : source) {
                for (const dvec3& to : target) {
                    const double height = plane.heightOf(from);
                    const double below = std::min(plane.heightOf(to), 0.0);
                    if (!wall.holds(from + height / (height - below) * (to - from))) return false;
                }
            }
            return true;
        });
    }

    // All specular objects that light from these may come to, these among them.
    [[nodiscard]] std::vector<bool> closure(std::vector<bool> reached) const {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (reached[i]) open.push_back(i);
        }
        while (!open.empty()) {
            const std::size_t from = open.back();
            open.pop_back();
            for (std::size_t i = 0; i < reached.size(); ++i) {
                if (reached[i] || boxes_[i].empty() || isBlocked(boxes_[from], boxes_[i])) continue;
                reached[i] = true;
                open.push_back(i);
            }
        }
        return reached;
    }

    [[nodiscard]] bool meets(const std::vector<bool>& lit, const std::vector<bool>& seen,
                             const std::vector<Source>& eyes) {
        steps_ = 0;
        std::vector<Source> lights;
        for (std::size_t i = 0; i < lit.size(); ++i) {
            if (!lit[i]) continue;
            if (seen[i]) return true;
            lights.push_back({boxes_[i]});
        }
        for (const Target& target : targets_) {
            for (const Source& eye : eyes) {
                Target part = target;
                if (eye.isEye && !cutToFrustum(part)) continue;
                for (const Source& light : lights) {
                    if (isOnOneSide(part, eye.points, light.points) &&
                        meetsAt(part, eye.points, light.points, 0))
                        return true;
                }
            }
        }
        return false;
    }

    // False where nothing of it is in the picture.
    [[nodiscard]] bool cutToFrustum(Target& target) const {
        if (!target.isFlat) return isInFrustum(target.points);
        for (const Plane& plane : frustum_) {
            target.points = above(target.points, plane);
            if (target.points.size() < 3) return false;
        }
        return true;
    }

    // Light on one side of a flat receiver is not seen from the other.
    [[nodiscard]] bool isOnOneSide(const Target& target, const Points& eye,
                                   const Points& light) const {
        if (!target.isFlat) return true;
        const double slack = kRounding * size_;
        const auto ofEye = heights(target.plane, eye);
        const auto ofLight = heights(target.plane, light);
        const bool isAbove = ofEye.second > slack && ofLight.second > slack;
        const bool isBelow = ofEye.first < -slack && ofLight.first < -slack;
        return isAbove || isBelow;
    }

    // Whether some of a part may be both seen and lit.
    [[nodiscard]] bool meetsAt(const Target& part, const Points& eye, const Points& light,
                               int halvings) {
        if (isBlocked(eye, part.points) || isBlocked(light, part.points)) return false;
        if (++steps_ > kMaxSteps || !part.isFlat) return true;
        std::optional<Plane> cut = planeThrough(part, eye, light);
        if (!cut) {
            if (halvings >= kMaxHalvings) return true;
            cut = halving(part.points);
            ++halvings;
        }
        for (const Plane& side : {*cut, turned(*cut)}) {
            Target piece = part;
            piece.points = above(part.points, side);
            // What is left of a cut along an edge is no part.
            if (piece.points.size() < 3) continue;
            if (meetsAt(piece, eye, light, halvings)) return true;
        }
        return false;
    }

    // The plane of a wall that cuts the part, and that either is wholly on one side of.
    [[nodiscard]] std::optional<Plane> planeThrough(const Target& part, const Points& eye,
                                                    const Points& light) const {
        const double slack = kRounding * size_;
        const auto isApart = [&](const Plane& plane, const Points& points) {
            const auto range = heights(plane, points);
            return range.first > slack || range.second < -slack;
        };
        for (const Wall& wall : walls_) {
            const auto range = heights(wall.plane, part.points);
            if (range.first >= -slack || range.second <= slack) continue;
            if (isApart(wall.plane, eye) || isApart(wall.plane, light)) return wall.plane;
        }
        return std::nullopt;
    }

    // Across the longest way between two corners of a polygon, in the middle of it.
    [[nodiscard]] static Plane halving(const Points& polygon) {
        std::pair<dvec3, dvec3> ends{polygon[0], polygon[1]};
        for (const dvec3& a : polygon) {
            for (const dvec3& b : polygon) {
                if (glm::length(b - a) > glm::length(ends.second - ends.first)) ends = {a, b};
            }
        }
        const dvec3 along = ends.second - ends.first;
        const double length = glm::length(along);
        const dvec3 normal = length > 0.0 ? along / length : dvec3(1, 0, 0);
        return {normal, glm::dot(normal, 0.5 * (ends.first + ends.second))};
    }

    const scene::Scene& scene_;
    double size_ = 1.0;
    std::vector<Wall> walls_;
    std::vector<Target> targets_;
    std::vector<Plane> frustum_;  // whose normals point inside
    Points eye_;
    std::vector<Points> boxes_;  // by object; none of receivers
    int steps_ = 0;
};

}  // namespace

std::vector<bool> mayReachPicture(const scene::Scene& scene, const render::RasterView& eye) {
    if (scene.medium && scene.medium->scatteringPerMeter != glm::vec3(0.0f))
        return std::vector<bool>(scene.objects.size(), true);
    return Reach(scene, eye).result();
}

}  // namespace kaustik
