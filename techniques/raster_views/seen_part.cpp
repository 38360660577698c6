// SPDX-License-Identifier: MIT
#include "techniques/raster_views/seen_part.h"

#include <algorithm>
#include <array>
#include <vector>

namespace kaustik {
namespace {

using glm::dvec3;
using glm::dvec4;

// Two convex bodies meet in one whose corners are those of either that lie in the other, and places
// where an edge of one goes through a side of the other: the ends of all edges, each cut to the
// other body.
class Cut {
  public:
    Cut(const scene::Bounds& box, const render::RasterView& eye, double farMeters)
        : eye_(eye), toWorld_(glm::inverse(eye.worldToView)), box_(box), farMeters_(farMeters) {}

    [[nodiscard]] SeenPart part() {
        addBox();
        addFrustum();
        return seen_;
    }

  private:
    void addBox() {
        std::array<dvec3, 8> corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corners[i] = {(i & 1) != 0 ? box_.maximum.x : box_.minimum.x,
                          (i & 2) != 0 ? box_.maximum.y : box_.minimum.y,
                          (i & 4) != 0 ? box_.maximum.z : box_.minimum.z};
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (const std::size_t bit : {1U, 2U, 4U}) {
                if ((i & bit) == 0) addEdgeOfBox(corners[i], corners[i | bit]);
            }
        }
    }

    // Four edges from the eye, and four where it ends.
    void addFrustum() {
        const dvec3 eye(toWorld_[3]);
        std::array<dvec3, 4> rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const dvec3 ray((i == 0 || i == 3 ? -1.0 : 1.0) * eye_.halfExtent.x,
                            (i < 2 ? -1.0 : 1.0) * eye_.halfExtent.y, -1.0);
            rays[i] = glm::dmat3(toWorld_) * ray;
            addEdgeOfFrustum(eye, rays[i], farMeters_);
        }
        if (farMeters_ >= 1e29) return;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            addEdgeOfFrustum(eye + farMeters_ * rays[i],
                             farMeters_ * (rays[(i + 1) % rays.size()] - rays[i]), 1.0);
        }
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

    void addEdgeOfBox(const dvec3& from, const dvec3& to) {
        const dvec3 a(eye_.worldToView * dvec4(from, 1.0));
        const dvec3 b = dvec3(eye_.worldToView * dvec4(to, 1.0)) - a;
        double low = 0.0;
        double high = 1.0;
        cut(-a.z, -b.z, low, high);
        cut(farMeters_ + a.z, b.z, low, high);
        for (int axis = 0; axis < 2; ++axis) {
            const double wide = eye_.halfExtent[axis];
            cut(-a.z * wide - a[axis], -b.z * wide - b[axis], low, high);
            cut(-a.z * wide + a[axis], -b.z * wide + b[axis], low, high);
        }
        addEnds(from, to - from, low, high);
    }

    void addEdgeOfFrustum(const dvec3& from, const dvec3& along, double high) {
        double low = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            cut(from[axis] - box_.minimum[axis], along[axis], low, high);
            cut(box_.maximum[axis] - from[axis], -along[axis], low, high);
        }
        addEnds(from, along, low, high);
    }

    void addEnds(const dvec3& from, const dvec3& along, double low, double high) {
        if (low > high) return;
        for (const double t : {low, high}) {
            const dvec3 point = from + t * along;
            const double depth = -(eye_.worldToView * dvec4(point, 1.0)).z;
            seen_.nearestMeters = seen_.bounds.empty ? depth : std::min(seen_.nearestMeters, depth);
            seen_.farthestMeters =
                seen_.bounds.empty ? depth : std::max(seen_.farthestMeters, depth);
            seen_.bounds.include(point);
        }
    }

    const render::RasterView& eye_;
    glm::dmat4 toWorld_;
    scene::Bounds box_;
    double farMeters_;
    SeenPart seen_;
};

}  // namespace

SeenPart seenPartOf(const scene::Bounds& box, const render::RasterView& eye, double farMeters) {
    return Cut(box, eye, farMeters).part();
}

}  // namespace kaustik
