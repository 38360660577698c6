// SPDX-License-Identifier: MIT
// What independent batches have found for every pixel: sums, sums of squares and counts. The sums
// are integers (fixed point, 128 bits), so that shards merge exactly, in any order, and a result
// does not depend on how its batches were divided among threads, runs or machines.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "framework/reference/energy.h"

namespace kaustik::reference {

__extension__ using Int128 = __int128;

// Batches [first, end).
struct BatchRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;
    bool operator==(const BatchRange&) const = default;
};

// The values of one batch: one set of pixels after the other, by channel (`Output`), RGB
// interleaved, rows from the top.
struct BatchResult {
    std::vector<double> values;
    Energy energy;
    std::uint64_t photons = 0;
    std::uint64_t rays = 0;
    void clear();
};

class PixelSums {
  public:
    PixelSums() = default;
    // `layers`: how many RGB images a batch gives. A unit of the sums is a power of two near
    // 2^-34 `scale` (W/m²), or for the ledger near 2^-54 `fluxWatts`.
    PixelSums(int width, int height, int layers, double scale, double fluxWatts);

    // Adds a batch. Throws ConfigError when it is in the sums already.
    void add(std::uint64_t batch, const BatchResult& result);
    // Adds all of the other's batches. Throws ConfigError where the two do not belong together or
    // hold a batch in common.
    void merge(const PixelSums& other);

    [[nodiscard]] std::uint64_t batchCount() const;
    [[nodiscard]] const std::vector<BatchRange>& batches() const { return batches_; }
    [[nodiscard]] bool holds(std::uint64_t batch) const;
    [[nodiscard]] std::uint64_t photons() const { return photons_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    // Values that were too large or no numbers, and were left out.
    [[nodiscard]] std::uint64_t rejectedValues() const { return rejectedValues_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] int layers() const { return layers_; }
    // A unit of the sums, a power of two: values that are whole numbers of it, up to 2^52 of them,
    // are summed exactly.
    [[nodiscard]] double quantum() const { return quantum_; }

    // The mean and its standard error of one value, by its index within BatchResult::values. The
    // error is infinite below two batches.
    [[nodiscard]] double mean(std::size_t value) const;
    [[nodiscard]] double standardError(std::size_t value) const;
    [[nodiscard]] Image meanImage(int layer) const;
    // Infinity where there is no estimate.
    [[nodiscard]] Image standardErrorImage(int layer) const;
    // Root mean square of the standard error over the mean, of the values that are not 0.
    [[nodiscard]] double relativeStandardError(int layer) const;
    // Mean of a batch.
    [[nodiscard]] Energy energy() const;

    // The sums as bytes, with a checksum at the end; `key` says what they belong to.
    [[nodiscard]] std::string toBytes(const std::string& key) const;
    // Throws IoError that names `name` when the bytes are damaged or of another version, and
    // ConfigError when they belong to another key.
    [[nodiscard]] static PixelSums fromBytes(std::string_view bytes, const std::string& key,
                                             const std::string& name);
    bool operator==(const PixelSums&) const = default;

  private:
    void addRange(const BatchRange& range);

    int width_ = 0;
    int height_ = 0;
    int layers_ = 0;
    double quantum_ = 0.0;
    double energyQuantum_ = 0.0;
    std::uint64_t photons_ = 0;
    std::uint64_t rays_ = 0;
    std::uint64_t rejectedValues_ = 0;
    std::vector<BatchRange> batches_;  // sorted, apart from each other
    std::vector<Int128> sums_;
    std::vector<Int128> squares_;
    std::array<Int128, transport::kReferenceAccounts + 1> energy_{};  // last: visible
};

}  // namespace kaustik::reference
