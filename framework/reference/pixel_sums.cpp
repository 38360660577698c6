// SPDX-License-Identifier: MIT
#include "framework/reference/pixel_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/core/error.h"

namespace kaustik::reference {
namespace {

// A value of one batch uses at most this many units: the square of it, summed over 2^22 batches,
// still fits.
constexpr double kMaxUnits = 0x1.0p52;

double powerOfTwoNear(double value) {
    return std::exp2(std::round(std::log2(value > 0.0 ? value : 1.0)));
}

}  // namespace

void BatchResult::clear() {
    std::fill(values.begin(), values.end(), 0.0);
    energy = {};
    photons = 0;
    rays = 0;
}

PixelSums::PixelSums(int width, int height, int layers, double scale, double fluxWatts)
    : width_(width),
      height_(height),
      layers_(layers),
      quantum_(powerOfTwoNear(scale) * 0x1.0p-34),
      energyQuantum_(powerOfTwoNear(fluxWatts) * 0x1.0p-54) {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(layers) * 3;
    sums_.resize(count);
    squares_.resize(count);
}

bool PixelSums::holds(std::uint64_t batch) const {
    return std::any_of(batches_.begin(), batches_.end(), [&](const BatchRange& range) {
        return batch >= range.first && batch < range.end;
    });
}

// Keeps the ranges sorted and joins those that touch.
void PixelSums::addRange(const BatchRange& range) {
    batches_.push_back(range);
    std::sort(batches_.begin(), batches_.end(),
              [](const BatchRange& a, const BatchRange& b) { return a.first < b.first; });
    std::vector<BatchRange> joined;
    for (const BatchRange& next : batches_) {
        if (!joined.empty() && joined.back().end == next.first) {
            joined.back().end = next.end;
        } else {
            joined.push_back(next);
        }
    }
    batches_ = std::move(joined);
}

void PixelSums::add(std::uint64_t batch, const BatchResult& result) {
    if (holds(batch)) throw ConfigError(fmt::format("Batch {} is in these sums already.", batch));
    addRange({batch, batch + 1});
    const double unitsPerValue = 1.0 / quantum_;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (result.values[i] == 0.0) continue;
        const double units = std::nearbyint(result.values[i] * unitsPerValue);
        if (!(std::abs(units) <= kMaxUnits)) {
            ++rejectedValues_;
            continue;
        }
        const auto whole = static_cast<std::int64_t>(units);
        sums_[i] += whole;
        squares_[i] += static_cast<Int128>(whole) * whole;
    }
    const auto toUnits = [&](double watts) {
        const double units = std::nearbyint(watts / energyQuantum_);
        return std::abs(units) < 0x1.0p62 ? static_cast<std::int64_t>(units) : 0;
    };
    for (std::size_t account = 0; account < result.energy.watts.size(); ++account)
        energy_[account] += toUnits(result.energy.watts[account]);
    energy_.back() += toUnits(result.energy.visibleWatts);
    photons_ += result.photons;
    rays_ += result.rays;
}

void PixelSums::merge(const PixelSums& other) {
    if (width_ != other.width_ || height_ != other.height_ || layers_ != other.layers_ ||
        quantum_ != other.quantum_ || energyQuantum_ != other.energyQuantum_) {
        throw ConfigError("These shards belong to different references; they cannot be merged.");
    }
    for (const BatchRange& mine : batches_) {
        for (const BatchRange& range : other.batches_) {
            if (mine.first < range.end && range.first < mine.end) {
                throw ConfigError(fmt::format("Both shards hold batch {}; each may count once.",
                                              std::max(mine.first, range.first)));
            }
        }
    }
    for (const BatchRange& range : other.batches_)
        addRange(range);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        sums_[i] += other.sums_[i];
        squares_[i] += other.squares_[i];
    }
    for (std::size_t account = 0; account < energy_.size(); ++account)
        energy_[account] += other.energy_[account];
    photons_ += other.photons_;
    rays_ += other.rays_;
    rejectedValues_ += other.rejectedValues_;
}

std::uint64_t PixelSums::batchCount() const {
    std::uint64_t count = 0;
    for (const BatchRange& range : batches_)
        count += range.end - range.first;
    return count;
}

double PixelSums::mean(std::size_t value) const {
    const std::uint64_t count = batchCount();
    if (count == 0) return 0.0;
    return static_cast<double>(sums_[value]) * quantum_ / static_cast<double>(count);
}

double PixelSums::standardError(std::size_t value) const {
    const std::uint64_t count = batchCount();
    if (count < 2) return std::numeric_limits<double>::infinity();
    // Where the error is small, both terms of the difference have their leading digits in common.
    const auto n = static_cast<long double>(count);
    const auto sum = static_cast<long double>(sums_[value]);
    const long double spread = static_cast<long double>(squares_[value]) - sum * sum / n;
    return static_cast<double>(std::sqrt(std::max(spread, 0.0L) / (n * (n - 1.0L)))) * quantum_;
}

Image PixelSums::meanImage(int layer) const {
    Image image(width_, height_, 3);
    const std::size_t first = static_cast<std::size_t>(layer) * image.values.size();
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = static_cast<float>(mean(first + i));
    return image;
}

Image PixelSums::standardErrorImage(int layer) const {
    Image image(width_, height_, 3);
    const std::size_t first = static_cast<std::size_t>(layer) * image.values.size();
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = static_cast<float>(standardError(first + i));
    return image;
}

double PixelSums::relativeStandardError(int layer) const {
    const std::size_t count = sums_.size() / static_cast<std::size_t>(std::max(layers_, 1));
    const std::size_t first = static_cast<std::size_t>(layer) * count;
    double squares = 0.0;
    double total = 0.0;
    std::size_t lit = 0;
    for (std::size_t i = first; i < first + count; ++i) {
        if (sums_[i] == 0) continue;
        const double error = standardError(i);
        squares += error * error;
        total += mean(i);
        ++lit;
    }
    if (lit == 0 || total <= 0.0) return std::numeric_limits<double>::infinity();
    return std::sqrt(squares / static_cast<double>(lit)) / (total / static_cast<double>(lit));
}

Energy PixelSums::energy() const {
    Energy result;
    const double scale = energyQuantum_ / std::max(1.0, static_cast<double>(batchCount()));
    for (std::size_t account = 0; account < result.watts.size(); ++account)
        result.watts[account] = static_cast<double>(energy_[account]) * scale;
    result.visibleWatts = static_cast<double>(energy_.back()) * scale;
    return result;
}

}  // namespace kaustik::reference
