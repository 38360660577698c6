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
    unsigned followed = 0;  // bits of the branches that are done for a cell that this is a part of
};

// Ways on from the first surface. They are followed apart, each in cells as small as it needs.
enum Branch : unsigned {
    kReflected = 1u,
    kRefracted = 2u,
    kReflectedByTriangle = 4u,  // by the triangle's own normal, where its interpolated one fails
    kRefractedByTriangle = 8u,
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
    // What was there by then.
    struct Mark {
        std::size_t deposits = 0;
        std::size_t undecided = 0;
        std::size_t open = 0;
        double lost = 0.0;
        Interval deposited;
        Interval limited;
    };
    [[nodiscard]] Mark mark() const;
    void goBack(const Mark& mark);
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
    // The same, of a branch of the first interaction: true also where it is left to the cell's
    // parts.
    bool advanceBranch(const Ray& ray, Branch branch);
    // What is given up: light from the range of the ray's places, in any direction of the boxes;
    // none of these: nobody knows where. True: wherever it may go, it is in the upper bounds.
    bool giveUp(const Ray& ray, const Polygons& may, const std::vector<Vec>& directions);

    // The same, of branches of the first interaction.
    bool giveUpBranches(const Ray& ray, const Polygons& may, const std::vector<Vec>& directions,
                        unsigned branches);

    // Whether light ends at the surface of the closed body that it is in, in any direction of the
    // boxes: it is then counted.
    bool endsInBody(const Ray& ray, const std::vector<Vec>& directions);

    [[nodiscard]] const BeamTracer& tracer() const { return tracer_; }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    // How many fluxes differ: 1 or 3.
    [[nodiscard]] int channels() const { return channels_; }

  private:
    void split(const Cell& cell);
    bool traceCell(const Cell& cell);
    // Takes away what is in shadow.
    void shade(const Cell& cell, Ray& ray) const;
    // Whether the ray is in a closed body, out of which it does not get without one interaction too
    // many: wherever it meets the body's surface, it ends there.
    [[nodiscard]] bool isLimited(const Ray& ray, const Vec& start, const Vec& velocity) const;
    bool advanceTo(const Ray& ray, const Candidate& target, const Visible& visible);
    bool deposit(const Ray& ray, const Candidate& target, const Visible& visible);
    void send() const;
    void sendFound() const;
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
    bool isFinal_ = false;        // what cannot be decided is not split but given up
    unsigned followed_ = 0;       // of the cell: before, and now
    bool isLeftToParts_ = false;  // a branch is
    CellResult found_;
};

// What happens to light at a specular facet, met at the barycentrics b and c of its second and
// third corner.
bool interact(CellTracer& tracer, const Ray& ray, std::uint32_t facet, bool enters, const Both& b,
              const Both& c);

}  // namespace kaustik::certify
