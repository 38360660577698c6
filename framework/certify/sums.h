// SPDX-License-Identifier: MIT
// Sums of bounds, W/m² a pixel and W. They are integers (fixed point, 128 bits), lower bounds
// rounded down and upper ones up, so that shards merge exactly and in any order, and a result does
// not depend on threads.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/certify/interval.h"

namespace kaustik::certify {

__extension__ using Int128 = __int128;
using Colors = std::array<Interval, 3>;

// Of all channels' mean, as the energy ledger counts.
struct Totals {
    Interval emitted;        // that the lights send to the first specular surface
    Interval deposited;      // on receivers, by the paths that are followed
    Interval limited;        // at a surface beyond the last interaction that is followed
    double undecided = 0.0;  // at most so much of what is deposited lies who knows where
};

class BoundSums {
  public:
    BoundSums() = default;
    BoundSums(std::size_t pixels, std::size_t facets, double irradianceScale, double wattScale);

    void addPixel(std::size_t pixel, const Colors& irradiance);
    // At most so much irradiance, of light that may lie in any of many pixels.
    void addOpen(std::size_t pixel, const std::array<double, 3>& irradiance);
    // At most so many watts that lie on the facet, at an unknown place; on any, where it is the
    // number of all facets.
    void addUndecided(std::size_t facet, const std::array<double, 3>& watts);
    void addEmitted(const Interval& watts) { addTotal(0, watts); }
    void addDeposited(const Interval& watts) { addTotal(1, watts); }
    // W, the mean of channels; what of the deposited light addOpen and addUndecided have told of.
    void addLost(double watts) { addTotal(3, Interval(0.0, watts)); }
    void addLimited(const Interval& watts) { addTotal(2, watts); }
    void countCells(std::uint64_t cells) { cells_ += cells; }
    void merge(const BoundSums& other);
    void clear();

    [[nodiscard]] Colors pixel(std::size_t pixel) const;
    [[nodiscard]] std::array<double, 3> open(std::size_t pixel) const;
    [[nodiscard]] std::array<double, 3> undecided(std::size_t facet) const;
    [[nodiscard]] Totals totals() const;
    [[nodiscard]] std::size_t pixels() const { return lower_.size() / 3; }
    [[nodiscard]] std::size_t facets() const { return undecided_.size() / 3; }
    [[nodiscard]] std::uint64_t cells() const { return cells_; }

    [[nodiscard]] std::string toBytes() const;
    // Throws IoError that names `name` for bytes that are of another size.
    void readBytes(std::string_view bytes, const std::string& name);

  private:
    void addTotal(std::size_t which, const Interval& watts);
    double quantum_ = 1.0;
    double wattQuantum_ = 1.0;
    std::vector<Int128> lower_;
    std::vector<Int128> upper_;
    std::vector<Int128> open_;
    std::vector<Int128> undecided_;
    std::array<Int128, 8> totals_{};  // lower and upper ones
    std::uint64_t cells_ = 0;
};

}  // namespace kaustik::certify
