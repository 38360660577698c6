// SPDX-License-Identifier: MIT
// Runs independent batches on several threads and takes their results in the order of their
// numbers, so that neither the result nor where it stops depends on the threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "framework/reference/pixel_sums.h"

namespace kaustik::reference {

// The condition for stopping; what is reached first counts. At least one of them must be given.
struct StopCondition {
    std::optional<std::uint64_t> batches;  // in all, those of earlier runs included
    std::optional<std::uint64_t> photons;  // in all, rounded up to whole batches, two at least
    std::optional<double> seconds;         // of this run; two batches at least
    // PixelSums::relativeStandardError of layer 0; where no pixel is lit after 64 batches it is
    // given up, unless there is another end.
    std::optional<double> relativeError;
    std::uint64_t minimumBatches = 8;  // before the error is believed
};

struct Progress {
    std::uint64_t batches = 0;        // in the sums
    std::uint64_t targetBatches = 0;  // 0: not known
    std::uint64_t photons = 0;
    std::uint64_t targetPhotons = 0;  // 0: not known
    double seconds = 0.0;
    double relativeError = 0.0;  // infinite until known
};

struct RunOptions {
    StopCondition stop;
    BatchRange shard{0, UINT64_MAX};  // only these batches
    int threads = 0;                  // 0: all
    // Called after each batch, in order; false ends the run with what it has.
    std::function<bool(const Progress&)> progress;
    // Called on any thread in the middle of a batch, which may take seconds, with how many photons
    // this run has traced; false ends it at once, without the batches at hand.
    std::function<bool(std::uint64_t photons)> pulse;
    // Called with the sums after a batch when at least `saveEverySeconds` have passed, and at the
    // end.
    std::function<void(const PixelSums&)> save;
    double saveEverySeconds = 30.0;
};

// What a batch says of itself now and then while it is computed: so many photons more. False: it is
// not wanted any longer, and may end as it is.
using TracedMore = std::function<bool(std::uint64_t photons)>;
inline constexpr std::uint64_t kPhotonsPerPulse = 1u << 11;

// `compute` fills a cleared result for a batch and is called on several threads; batches that the
// sums hold already are skipped. Throws ConfigError when nothing says where to stop.
using ComputeBatch =
    std::function<void(std::uint64_t batch, BatchResult& result, const TracedMore& tracedMore)>;
void runBatches(PixelSums& sums, const RunOptions& options, const ComputeBatch& compute);

}  // namespace kaustik::reference
