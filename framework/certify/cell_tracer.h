// SPDX-License-Identifier: MIT
// The light that first meets one specular triangle, cell by cell: each is followed to the pixels,
// and split into four where that leaves too much open. One step, one file: the start from the light
// in cell_tracer.cpp, shadows.cpp, what happens at a surface in interaction.cpp, the way to the
// next facet in flight.cpp and visibility.cpp, pixels in deposit.cpp, and what is given up in
// undecided.cpp.
//
// Steps return false where the cell is to be split.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framework/certify/beams.h"
#include "framework/certify/ray.h"
#include "framework/certify/shadows.h"
#include "framework/certify/visibility.h"

namespace kaustik::certify {

// The mean of channels, rounded up.
[[nodiscard]] inline double meanAbove(const std::array<double, 3>& watts) {
    return rounding::up(rounding::up(rounding::up(watts[0] + watts[1]) + watts[2]) / 3.0);
}

// A triangle of the first facet, in its barycentrics.
struct Cell {
    std::array<double, 2> corner{};
    std::array<std::array<double, 2>, 2> sides{};
    int depth = 0;
};

// What a cell brings: sent to the sums when all of it is done, forgotten when it is split.
struct CellResult {
    struct Deposit {
        std::size_t pixel = 0;
        Colors irradiance;
    };
    // Anywhere.
    struct Lost {
        std::array<double, 3> watts{};
    };
    // Somewhere in pixels [left, right] and [top, bottom] that see the facet.
    struct Open {
        std::uint32_t facet = 0;
        EyeView::Extent extent;
        std::array<double, 3> watts{};
    };
    std::vector<Deposit> deposits;
    std::vector<Lost> undecided;
    std::vector<Open> open;
    double lost = 0.0;   // W
    Interval emitted;    // W
    Interval deposited;  // W
    Interval limited;    // W, of paths with more interactions than are certified
    // Forgets where the light went, but not how much there is.
    void clearWays();
    void clear();
};

class CellTracer {
  public:
    // `power`: of the light by channels, W/m² or W/sr.
    CellTracer(const BeamTracer& tracer, const Source& source, std::uint32_t first,
               const std::array<Interval, 3>& power, BoundSums& sums);

    // Adds all of the triangle's light to the sums.
    void trace();

    // Follows the light on from a surface.
    bool advance(const Ray& ray);
    // What is given up: light from the range of the ray's places, in any direction of the boxes;
    // none of these: nobody knows where. True: wherever it may go, it is in the upper bounds.
    bool giveUp(const Ray& ray, const Polygons& may, const std::vector<Vec>& directions);

    [[nodiscard]] const BeamTracer& tracer() const { return tracer_; }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    // How many fluxes differ: 1 or 3.
    [[nodiscard]] int channels() const { return channels_; }

  private:
    void split(const Cell& cell);
    bool traceCell(const Cell& cell);
    // Takes away what is in shadow.
    void shade(const Cell& cell, Ray& ray) const;
    bool advanceTo(const Ray& ray, const Candidate& target, const Visible& visible);
    bool deposit(const Ray& ray, const Candidate& target, const Visible& visible);
    void send() const;
    void sendOpen(const CellResult::Open& open) const;
    [[nodiscard]] const Facet& facet(std::uint32_t i) const { return geometry_.facets()[i]; }

    const BeamTracer& tracer_;
    const Geometry& geometry_;
    const EyeView& eye_;
    const Source& source_;
    std::uint32_t first_;
    BoundSums& sums_;
    int channels_;
    std::array<Interval, 3> power_;
    std::vector<Shadow> shadows_;
    bool isFinal_ = false;  // what cannot be decided is not split but given up
    CellResult found_;
};

// What happens to light at a specular facet, met at the barycentrics b and c of its second and
// third corner.
bool interact(CellTracer& tracer, const Ray& ray, std::uint32_t facet, bool enters, const Both& b,
              const Both& c);

}  // namespace kaustik::certify
