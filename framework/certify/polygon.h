// SPDX-License-Identifier: MIT
// Convex polygons in the plane of a cell, cut by lines that are known up to a band. What is kept
// for sure and what may be kept are two polygons, an inner and an outer one, whose areas enclose
// the area of what is kept in truth.
//
// Corners are computed in doubles. A cut puts a corner on the segment that it cuts, off by a few
// units in the last place along it, which is the same as a line moved by as much: bands hold that
// already (jet.cpp), and kAreaSlack holds what the corners' own rounding changes of an area: at
// most some 30 cuts of some 1e-15 on a border shorter than 4.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace kaustik::certify {

inline constexpr double kAreaSlack = 1e-12;

struct Point {
    double x = 0.0;
    double y = 0.0;
};

// What is kept is where value + slope x + slope y + (something from low to high) >= 0.
struct HalfPlane {
    double value = 0.0;
    double slopeX = 0.0;
    double slopeY = 0.0;
    double low = 0.0;
    double high = 0.0;
    [[nodiscard]] double at(const Point& p) const { return value + slopeX * p.x + slopeY * p.y; }
};

enum class Side { inner, outer };

class Polygon {
  public:
    static constexpr std::size_t kCapacity = 40;
    Polygon() = default;
    [[nodiscard]] static Polygon cell();  // (0,0), (1,0), (0,1)

    void add(const Point& point);
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool isEmpty() const { return count_ < 3; }
    void clear() { count_ = 0; }
    [[nodiscard]] const Point& operator[](std::size_t i) const { return points_[i]; }

    // Keeps what is for sure on the half-plane's side, or what may be.
    void cut(const HalfPlane& line, Side side);
    // Keeps where value + slope p + shift >= 0.
    void cut(double value, double slopeX, double slopeY, double shift);

    // Area and first moments.
    struct Moments {
        double area = 0.0;
        double x = 0.0;
        double y = 0.0;
    };
    [[nodiscard]] Moments moments() const;

  private:
    std::array<Point, kCapacity> points_;
    std::size_t count_ = 0;
};

// A convex region that is taken away.
using Region = std::vector<HalfPlane>;
using Polygons = std::vector<Polygon>;

// All of `from` that is not in the region. Side::outer: takes away all that may be in it;
// Side::inner: only what is for sure. Whether anything is taken away.
bool subtract(Polygons& from, const Region& region, Side side);

[[nodiscard]] double areaOf(const Polygons& polygons);

}  // namespace kaustik::certify
