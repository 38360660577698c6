// SPDX-License-Identifier: MIT
#include "framework/certify/sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/core/error.h"

namespace kaustik::certify {
namespace {

// A power of two, so that dividing by it is exact.
double quantumOf(double scale) {
    return std::ldexp(1.0, std::ilogb(scale > 0.0 ? scale : 1.0) - 70);
}

Int128 floorOf(double value, double quantum) {
    return static_cast<Int128>(std::floor(value / quantum));
}
Int128 ceilOf(double value, double quantum) {
    return static_cast<Int128>(std::ceil(value / quantum));
}

// To the nearest double, and outwards by one unit.
double lowOf(Int128 sum, double quantum) {
    const double value = static_cast<double>(sum) * quantum;
    return value == 0.0 ? 0.0 : rounding::down(value);
}
double highOf(Int128 sum, double quantum) {
    const double value = static_cast<double>(sum) * quantum;
    return value == 0.0 ? 0.0 : rounding::up(value);
}

void requireBounded(const Interval& value, double quantum) {
    if (value.isFinite() && value.magnitude() < 0x1p110 * quantum) return;
    throw Error("certify: a bound is no number; this is an error of the program.", kExitFailed);
}

}  // namespace

BoundSums::BoundSums(std::size_t pixels, std::size_t facets, double irradianceScale,
                     double wattScale)
    : quantum_(quantumOf(irradianceScale)),
      wattQuantum_(quantumOf(wattScale)),
      lower_(pixels * 3),
      upper_(pixels * 3),
      open_(pixels * 3),
      undecided_(facets * 3) {}

void BoundSums::addPixel(std::size_t pixel, const Colors& irradiance) {
    for (std::size_t c = 0; c < 3; ++c) {
        requireBounded(irradiance[c], quantum_);
        lower_[pixel * 3 + c] += floorOf(irradiance[c].lo, quantum_);
        upper_[pixel * 3 + c] += ceilOf(irradiance[c].hi, quantum_);
    }
}

void BoundSums::addOpen(std::size_t pixel, const std::array<double, 3>& irradiance) {
    for (std::size_t c = 0; c < 3; ++c) {
        requireBounded(Interval(irradiance[c]), quantum_);
        open_[pixel * 3 + c] += ceilOf(irradiance[c], quantum_);
    }
}

void BoundSums::addUndecided(std::size_t facet, const std::array<double, 3>& watts) {
    for (std::size_t c = 0; c < 3; ++c) {
        requireBounded(Interval(watts[c]), wattQuantum_);
        undecided_[facet * 3 + c] += ceilOf(watts[c], wattQuantum_);
    }
}

void BoundSums::addTotal(std::size_t which, const Interval& watts) {
    requireBounded(watts, wattQuantum_);
    totals_[2 * which] += floorOf(watts.lo, wattQuantum_);
    totals_[2 * which + 1] += ceilOf(watts.hi, wattQuantum_);
}

void BoundSums::merge(const BoundSums& other) {
    for (std::size_t i = 0; i < lower_.size(); ++i) {
        lower_[i] += other.lower_[i];
        upper_[i] += other.upper_[i];
        open_[i] += other.open_[i];
    }
    for (std::size_t i = 0; i < undecided_.size(); ++i)
        undecided_[i] += other.undecided_[i];
    for (std::size_t i = 0; i < totals_.size(); ++i)
        totals_[i] += other.totals_[i];
    cells_ += other.cells_;
}

void BoundSums::clear() {
    for (auto* values : {&lower_, &upper_, &open_, &undecided_})
        std::fill(values->begin(), values->end(), Int128{0});
    totals_.fill(0);
    cells_ = 0;
}

Colors BoundSums::pixel(std::size_t pixel) const {
    Colors result;
    for (std::size_t c = 0; c < 3; ++c) {
        result[c] = {lowOf(lower_[pixel * 3 + c], quantum_),
                     highOf(upper_[pixel * 3 + c], quantum_)};
    }
    return result;
}

std::array<double, 3> BoundSums::open(std::size_t pixel) const {
    std::array<double, 3> result;
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = highOf(open_[pixel * 3 + c], quantum_);
    return result;
}

std::array<double, 3> BoundSums::undecided(std::size_t facet) const {
    std::array<double, 3> result;
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = highOf(undecided_[facet * 3 + c], wattQuantum_);
    return result;
}

Totals BoundSums::totals() const {
    const auto total = [&](std::size_t which) {
        return Interval(lowOf(totals_[2 * which], wattQuantum_),
                        highOf(totals_[2 * which + 1], wattQuantum_));
    };
    Totals result{total(0), total(1), total(2), total(3).hi};
    return result;
}

std::string BoundSums::toBytes() const {
    std::string bytes;
    const auto put = [&](const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    };
    put(&cells_, sizeof cells_);
    put(totals_.data(), sizeof totals_);
    for (const auto* values : {&lower_, &upper_, &open_, &undecided_})
        put(values->data(), values->size() * sizeof(Int128));
    return bytes;
}

void BoundSums::readBytes(std::string_view bytes, const std::string& name) {
    const std::size_t size =
        sizeof cells_ + sizeof totals_ +
        (lower_.size() + upper_.size() + open_.size() + undecided_.size()) * sizeof(Int128);
    if (bytes.size() != size) {
        throw IoError(fmt::format("{} is damaged: it has {} bytes of sums, and not {}.", name,
                                  bytes.size(), size));
    }
    const auto take = [&](void* data, std::size_t count) {
        std::memcpy(data, bytes.data(), count);
        bytes.remove_prefix(count);
    };
    take(&cells_, sizeof cells_);
    take(totals_.data(), sizeof totals_);
    for (auto* values : {&lower_, &upper_, &open_, &undecided_})
        take(values->data(), values->size() * sizeof(Int128));
}

}  // namespace kaustik::certify
