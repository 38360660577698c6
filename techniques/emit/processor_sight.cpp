// SPDX-License-Identifier: MIT
#include "techniques/emit/processor_sight.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace kaustik {
namespace {

// The rays of a light's view, from where its picture would begin.
class LightRays {
  public:
    LightRays(const reference::EmbreeScene& scene, const render::RasterView& light,
              glm::ivec2 parts)
        : scene_(scene), light_(light), parts_(parts) {
        const glm::dmat4 toWorld = glm::inverse(light.worldToView);
        rotation_ = glm::dmat3(toWorld);
        offset_ = glm::dvec3(toWorld[3]) - scene.center();
    }
    // Through the middles of parts of the view, numbered from 0; calls `tell` with each number and
    // what is seen there.
    template <class Part, class Tell>
    void through(int count, Part&& partOf, Tell&& tell) const {
        for (int first = 0; first < count; first += reference::kRaysTogether) {
            const int together = std::min(count - first, reference::kRaysTogether);
            std::array<reference::OpenRay, reference::kRaysTogether> rays;
            for (int i = 0; i < together; ++i)
                rays[static_cast<std::size_t>(i)] = rayThrough(partOf(first + i));
            const auto found = scene_.firstTriangles(rays, together);
            for (int i = 0; i < together; ++i)
                tell(first + i, found[static_cast<std::size_t>(i)]);
        }
    }

  private:
    [[nodiscard]] reference::OpenRay rayThrough(const glm::dvec2& part) const {
        const glm::dvec2 place = (2.0 * (part + 0.5) / parts_ - 1.0) * light_.halfExtent;
        const auto from = static_cast<float>(light_.nearMeters);
        if (light_.isOrthographic)
            return {rotation_ * glm::dvec3(place, 0.0) + offset_, -rotation_[2], from};
        return {offset_, rotation_ * glm::dvec3(place, -1.0), from};
    }
    const reference::EmbreeScene& scene_;
    render::RasterView light_;
    glm::dvec2 parts_;  // of the whole view
    glm::dmat3 rotation_;
    glm::dvec3 offset_;  // to the scene's local space
};

template <class Body>
void forEachRow(int count, Body&& body) {
    tbb::parallel_for(tbb::blocked_range<int>(0, count), [&](const tbb::blocked_range<int>& range) {
        for (int row = range.begin(); row < range.end(); ++row)
            body(row);
    });
}

// Objects through the middles of a band's cells, and of a row more on either side: which parts are
// looked at is then the same in any band.
class Middles {
  public:
    Middles(const reference::EmbreeScene& scene, const GridRows& rows, int band,
            const LightRays& rays)
        : width_(rows.grid.width), rows_(rows.seen() + 2), first_(rows.firstSeen(band) - 1) {
        for (const scene::Object& object : scene.scene().objects) {
            const scene::MaterialKind kind = scene.scene().materials[object.material].kind;
            isSpecular_.push_back(!isReceiver(kind));
        }
        cells_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows_));
        forEachRow(rows_, [&](int row) {
            const int ofGrid = first_ + row;
            if (ofGrid < 0 || ofGrid >= rows.grid.height) return;
            const auto middle = [&](int column) {
                return double(rows.subcells) * (glm::dvec2(column, ofGrid) + 0.5) - 0.5;
            };
            rays.through(width_, middle, [&](int column, const reference::TriangleId& seen) {
                if (!seen.exists()) return;
                SightOfCell& cell = cells_[index(column, row)];
                cell.object = seen.object + 1;
                cell.triangle = seen.triangle;
            });
        });
    }
    // Of the band alone.
    [[nodiscard]] SightOfCell at(int column, int row) const {
        return cells_[index(column, row + 1)];
    }
    // Whether something specular is seen through it or a neighbour, and something else too.
    [[nodiscard]] bool isAtBorder(int column, int row) const {
        const std::uint32_t own = at(column, row).object;
        bool isUneven = false;
        bool hasSpecular = false;
        for (int y = row; y <= row + 2; ++y) {
            for (int x = column - 1; x <= column + 1; ++x) {
                const bool isIn = x >= 0 && x < width_;
                const std::uint32_t object = isIn ? cells_[index(x, y)].object : 0;
                isUneven = isUneven || object != own;
                hasSpecular = hasSpecular || (object != 0 && isSpecular_[object - 1]);
            }
        }
        return isUneven && hasSpecular;
    }

  private:
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(column);
    }
    int width_, rows_, first_;
    std::vector<bool> isSpecular_;  // by object
    std::vector<SightOfCell> cells_;
};

}  // namespace

SightOfRows TracesSight::find(const render::RasterView& light, const GridRows& rows,
                              int band) const {
    const int width = rows.grid.width;
    const int subcells = rows.subcells;
    const LightRays rays(*scene_.scene, light, {width * subcells, rows.grid.height * subcells});
    const Middles middles(*scene_.scene, rows, band, rays);
    SightOfRows found;
    found.cells.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.seen()));
    const auto cellsOf = [&](int row) {
        return found.cells.data() + static_cast<std::ptrdiff_t>(row) * width;
    };
    const auto partsOfCell = static_cast<std::uint32_t>(subcells * subcells);
    std::vector<std::uint32_t> ends(static_cast<std::size_t>(rows.seen()) + 1, 0);
    forEachRow(rows.seen(), [&](int row) {
        const int ofGrid = rows.firstSeen(band) + row;
        const bool isInGrid = ofGrid >= 0 && ofGrid < rows.grid.height;
        std::uint32_t count = 0;
        for (int column = 0; column < width; ++column) {
            cellsOf(row)[column] = middles.at(column, row);
            if (subcells == 1 || !isInGrid || !middles.isAtBorder(column, row)) continue;
            cellsOf(row)[column].parts = 1 + partsOfCell * count++;
        }
        ends[static_cast<std::size_t>(row) + 1] = partsOfCell * count;
    });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    found.parts.resize(ends.back());
    forEachRow(rows.seen(), [&](int row) {
        for (int column = 0; column < width; ++column) {
            std::uint32_t& parts = cellsOf(row)[column].parts;
            if (parts == 0) continue;
            parts += ends[static_cast<std::size_t>(row)];
            std::uint32_t* const objects = found.parts.data() + (parts - 1);
            const glm::dvec2 corner(column * subcells, (rows.firstSeen(band) + row) * subcells);
            const auto part = [&](int i) {
                return corner + glm::dvec2(i % subcells, i / subcells);
            };
            rays.through(subcells * subcells, part, [&](int i, const reference::TriangleId& seen) {
                objects[i] = seen.exists() ? seen.object + 1 : 0;
            });
        }
    });
    return found;
}

}  // namespace kaustik
