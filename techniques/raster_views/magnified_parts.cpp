// SPDX-License-Identifier: MIT
#include "techniques/raster_views/magnified_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "framework/scene/triangles.h"
#include "techniques/raster_views/map_border.h"

namespace kaustik {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr int kPlacesAcross = 160;

// The nearest surface along the rays through the middles of a grid's cells. A triangle's edges are
// planes through the eye, so that none needs to be cut where it goes behind it (Olano, Greer 1997).
class PlaceGrid {
  public:
    PlaceGrid(const render::RasterView& eye)
        : eye_(eye), step_(std::max(1.0, std::ceil(eye.width / double{kPlacesAcross}))) {
        columns_ = std::max(1, static_cast<int>(std::ceil(eye.width / step_)));
        rows_ = std::max(1, static_cast<int>(std::ceil(eye.height / step_)));
        cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    }

    void add(const std::array<dvec3, 3>& corners, bool receives) {
        const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double volume = glm::dot(normal, corners[0]);
        if (!(std::abs(volume) > 0.0)) return;  // edge-on, or no triangle at all
        std::array<dvec3, 3> edges;
        for (std::size_t i = 0; i < 3; ++i)
            edges[i] = glm::cross(corners[i], corners[(i + 1) % 3]);
        const auto [low, high] = cellsOf(corners);
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                const dvec3 ray = rayOf(x, y);
                const double depth = volume / glm::dot(normal, ray);
                Cell& cell = cells_[static_cast<std::size_t>(y * columns_ + x)];
                if (!(depth > eye_.nearMeters) || depth >= cell.depth) continue;
                bool isIn = true;
                for (const dvec3& edge : edges)
                    isIn = isIn && glm::dot(edge, ray) * volume >= 0.0;
                if (isIn) cell = {depth, glm::normalize(normal), receives};
            }
        }
    }

    [[nodiscard]] std::vector<SeenPlace> places() const {
        const glm::dmat4 toWorld = glm::inverse(eye_.worldToView);
        std::vector<SeenPlace> places;
        for (int y = 0; y < rows_; ++y) {
            for (int x = 0; x < columns_; ++x) {
                const Cell& cell = cells_[static_cast<std::size_t>(y * columns_ + x)];
                if (!cell.receives) continue;
                const dvec3 ray = rayOf(x, y);
                const double facing = glm::dot(cell.normal, ray);
                const double across = eye_.footprintPerMeter() * cell.depth;
                if (!(std::abs(facing) > 1e-6)) continue;
                SeenPlace& seen = places.emplace_back();
                seen.place = dvec3(toWorld * dvec4(cell.depth * ray, 1.0));
                seen.normal = glm::dmat3(toWorld) * (facing < 0.0 ? cell.normal : -cell.normal);
                seen.pixelSquareMeters = across * across / std::abs(facing);
                seen.step = step_;
            }
        }
        return places;
    }

  private:
    struct Cell {
        double depth = 1e300;
        dvec3 normal{0.0};
        bool receives = false;
    };

    [[nodiscard]] dvec3 rayOf(int x, int y) const {
        const dvec2 pixel = (dvec2(x, y) + 0.5) * step_;
        const dvec2 share = 2.0 * pixel / dvec2(eye_.width, eye_.height) - 1.0;
        return {share * eye_.halfExtent, -1.0};
    }

    // The first and the last cell that may see it.
    [[nodiscard]] std::pair<glm::ivec2, glm::ivec2> cellsOf(
        const std::array<dvec3, 3>& corners) const {
        const glm::ivec2 last(columns_ - 1, rows_ - 1);
        dvec2 low(1e300);
        dvec2 high(-1e300);
        for (const dvec3& corner : corners) {
            if (-corner.z <= eye_.nearMeters) return {glm::ivec2(0), last};
            const dvec2 at = (dvec2(corner) / (-corner.z * eye_.halfExtent) * 0.5 + 0.5) *
                             dvec2(eye_.width, eye_.height) / step_;
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        // Far beyond the picture a number of cells would have no room in an int.
        low = glm::clamp(low - 1.0, dvec2(0.0), dvec2(last) + 1.0);
        high = glm::clamp(high + 1.0, dvec2(-1.0), dvec2(last));
        return {glm::ivec2(low), glm::ivec2(glm::floor(high))};
    }

    const render::RasterView& eye_;
    double step_;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<Cell> cells_;
};

// Where a view sees a point, -1 to 1 across it.
std::optional<dvec2> seenAt(const render::RasterView& view, const dvec3& point) {
    const dvec3 p(view.worldToView * dvec4(point, 1.0));
    if (-p.z <= view.nearMeters) return {};
    return dvec2(p) / (view.isOrthographic ? 1.0 : -p.z) / view.halfExtent;
}

// A place in one of the map's views, and what a texel covers of the screen there.
struct Magnified {
    int face = 0;
    dvec2 at{0.0};       // 0 to 1 across it
    double ofMap = 0.0;  // pixels a texel of the map before it has parts
    double now = 0.0;
    double reach = 0.0;  // of what it stands for, as a share of the view
};

// A square of the quadtree, or one between two of them.
struct Candidate {
    dvec2 low{1e300};
    dvec2 high{-1e300};
    int face = 0;
    double octaves = 0.0;  // by which it makes texels smaller, of all places
    void include(const Magnified& place) {
        low = glm::min(low, place.at - place.reach);
        high = glm::max(high, place.at + place.reach);
        face = place.face;
    }
    // With the border, which is not looked up.
    [[nodiscard]] double side() const {
        return std::max(high.x - low.x, high.y - low.y) / (1.0 - 2.0 * double{kBorderOfPart});
    }
};

double octavesOf(const Magnified& place, double then) {
    return std::log2(place.now / std::clamp(then, 1.0, place.now));
}

constexpr int kLevels = 7;  // of the quadtree

Candidate bestPart(const std::vector<Magnified>& places) {
    Candidate best;
    for (int level = 0; level <= kLevels; ++level) {
        for (int shift = 0; shift < (level == 0 ? 1 : 4); ++shift) {
            const dvec2 offset(0.5 * (shift & 1), 0.5 * (shift >> 1));
            const auto squareOf = [&](const Magnified& place) {
                const dvec2 square = glm::floor(place.at * std::exp2(level) + offset);
                return std::tuple(place.face, static_cast<int>(square.x),
                                  static_cast<int>(square.y));
            };
            std::map<std::tuple<int, int, int>, Candidate> squares;
            for (const Magnified& place : places) {
                if (place.now > 1.0) squares[squareOf(place)].include(place);
            }
            for (const Magnified& place : places) {
                if (place.now <= 1.0) continue;
                Candidate& square = squares[squareOf(place)];
                square.octaves += octavesOf(place, place.ofMap * square.side());
            }
            for (const auto& [key, square] : squares) {
                if (square.octaves > best.octaves) best = square;
            }
        }
    }
    return best;
}

render::RasterView viewOf(const Candidate& part, const render::RasterView& map) {
    render::RasterView view = map;
    view.isClipped = false;
    const dvec2 low = (2.0 * part.low - 1.0) * map.halfExtent;
    const dvec2 high = (2.0 * part.high - 1.0) * map.halfExtent;
    const dvec2 middle = 0.5 * (low + high);
    const double wider = 1.0 / (1.0 - 2.0 * double{kBorderOfPart});
    if (map.isOrthographic) {
        view.worldToView = glm::translate(glm::dmat4(1.0), dvec3(-middle, 0.0)) * map.worldToView;
        view.halfExtent = dvec2(0.5 * wider * std::max(high.x - low.x, high.y - low.y));
        return view;
    }
    const glm::dmat4 toWorld = glm::inverse(map.worldToView);
    const dvec3 from(toWorld[3]);
    view.worldToView =
        render::lookAlong(from, glm::dmat3(toWorld) * dvec3(middle, -1.0), dvec3(toWorld[1]));
    double half = 0.0;
    for (const dvec2& corner : {low, high, dvec2(low.x, high.y), dvec2(high.x, low.y)}) {
        const dvec3 p = glm::dmat3(view.worldToView) * (glm::dmat3(toWorld) * dvec3(corner, -1.0));
        half = std::max(half, std::max(std::abs(p.x), std::abs(p.y)) / std::max(-p.z, 1e-9));
    }
    view.halfExtent = dvec2(wider * half);
    return view;
}

// The median, and what 95 % have less than.
dvec2 spreadOf(const std::vector<Magnified>& places) {
    if (places.empty()) return dvec2(0.0);
    std::vector<double> all;
    for (const Magnified& place : places)
        all.push_back(place.now);
    std::sort(all.begin(), all.end());
    const auto at = [&](double share) {
        return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
    };
    return {at(0.5), at(0.95)};
}

}  // namespace

std::vector<SeenPlace> seenPlaces(const scene::Scene& scene, const render::RasterView& eye) {
    PlaceGrid grid(eye);
    for (const scene::Object& object : scene.objects) {
        const scene::MaterialKind kind = scene.materials[object.material].kind;
        if (kind == scene::MaterialKind::dielectric) continue;
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        const glm::dmat4 toView = eye.worldToView * object.toWorld;
        for (const glm::uvec3& triangle : mesh.triangles) {
            grid.add(scene::cornersOf(mesh, triangle, toView), isReceiver(kind));
        }
    }
    return grid.places();
}

double pixelsPerTexel(const SeenPlace& seen, const render::RasterView& view, double border) {
    const std::optional<dvec2> at = seenAt(view, seen.place);
    const double end = 1.0 - 2.0 * border;
    if (!at || std::max(std::abs(at->x), std::abs(at->y)) > end) return 0.0;
    const dvec3 place(view.worldToView * dvec4(seen.place, 1.0));
    const dvec3 normal = glm::dmat3(view.worldToView) * seen.normal;
    const dvec3 ray = view.isOrthographic ? dvec3(0, 0, -1) : place / -place.z;
    const double facing = -glm::dot(normal, ray);
    if (!(facing > 1e-6)) return 0.0;
    const double across = view.footprintPerMeter() * (view.isOrthographic ? 1.0 : -place.z);
    return std::sqrt(across * across / facing / seen.pixelSquareMeters);
}

MagnifiedParts magnifiedParts(const std::vector<SeenPlace>& places,
                              const std::vector<render::RasterView>& map, int side, int count) {
    std::vector<Magnified> magnified;
    std::vector<const SeenPlace*> seenOf;
    for (const SeenPlace& seen : places) {
        for (std::size_t face = 0; face < map.size(); ++face) {
            const double pixels = pixelsPerTexel(seen, map[face]);
            if (!(pixels > 0.0)) continue;
            Magnified& place = magnified.emplace_back();
            place.face = static_cast<int>(face);
            place.at = 0.5 * *seenAt(map[face], seen.place) + 0.5;
            place.now = pixels;
            // A part has as many texels as one view of `side`.
            place.ofMap = pixels * map[face].width / side;
            place.reach = 0.5 * seen.step / pixels / map[face].width;
            seenOf.push_back(&seen);
            break;
        }
    }
    MagnifiedParts parts;
    parts.before = spreadOf(magnified);
    while (static_cast<int>(parts.views.size()) < count) {
        const Candidate best = bestPart(magnified);
        if (!(best.octaves > 0.02 * static_cast<double>(magnified.size()))) break;
        const render::RasterView view =
            render::inPixels(viewOf(best, map[static_cast<std::size_t>(best.face)]), side, side);
        for (std::size_t i = 0; i < magnified.size(); ++i) {
            const double pixels = pixelsPerTexel(*seenOf[i], view, double{kBorderOfPart});
            if (pixels > 0.0) magnified[i].now = std::min(magnified[i].now, pixels);
        }
        parts.views.push_back(view);
    }
    // The last of those that hold a place is looked up.
    std::stable_sort(parts.views.begin(), parts.views.end(),
                     [](const auto& a, const auto& b) { return a.halfExtent.x > b.halfExtent.x; });
    parts.after = spreadOf(magnified);
    return parts;
}

}  // namespace kaustik
