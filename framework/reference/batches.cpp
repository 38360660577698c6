// SPDX-License-Identifier: MIT
#include "framework/reference/batches.h"

#include <tbb/concurrent_queue.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "framework/core/error.h"
#include "framework/reference/threads.h"

namespace kaustik::reference {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Job {
    std::uint64_t batch = 0;
    std::unique_ptr<BatchResult> result;
};

// One run; the first and the last stage of the pipeline are serial, so that this needs no lock but
// for what the batches in between tell and ask.
class Run {
  public:
    Run(PixelSums& sums, const RunOptions& options) : sums_(sums), options_(options) {
        next_ = options.shard.first;
        batchesAtStart_ = sums.batchCount();
    }

    // The next batch to compute; null at the end.
    [[nodiscard]] std::optional<Job> take() {
        while (next_ < options_.shard.end && sumsHeldAtStart(next_))
            ++next_;
        const auto& maximum = options_.stop.batches;
        if (stopped_.load() || next_ >= options_.shard.end ||
            (maximum && batchesAtStart_ + taken_ >= *maximum)) {
            return std::nullopt;
        }
        ++taken_;
        std::unique_ptr<BatchResult> result;
        if (!spare_.try_pop(result)) {
            result = std::make_unique<BatchResult>();
            result->values.resize(static_cast<std::size_t>(sums_.width()) *
                                  static_cast<std::size_t>(sums_.height()) *
                                  static_cast<std::size_t>(sums_.layers()) * 3);
        }
        result->clear();
        return Job{next_++, std::move(result)};
    }

    // On any thread.
    [[nodiscard]] bool shouldContinue(std::uint64_t photonsMore) {
        const std::uint64_t photons = traced_ += photonsMore;
        if (options_.pulse && !options_.pulse(photons)) stopped_.store(true);
        return !stopped_.load();
    }

    // In the order of the batches.
    void accept(Job& job) {
        if (stopped_.load()) return;
        sums_.add(job.batch, *job.result);
        spare_.push(std::move(job.result));
        const std::uint64_t count = sums_.batchCount();
        const StopCondition& stop = options_.stop;
        if (count >= stop.minimumBatches && count % kErrorInterval == 0)
            relativeError_ = sums_.relativeStandardError(0);
        bool isDone = stop.relativeError && relativeError_ <= *stop.relativeError;
        // Without light or specular surfaces no batch will ever send out a photon.
        isDone = isDone || (sums_.photons() == 0 && count >= kBatchesForAnError);
        // Nor will an error ever be known where no pixel is lit.
        isDone = isDone || (stop.relativeError && !stop.photons && !stop.seconds &&
                            std::isinf(relativeError_) && count >= kBatchesForALitPixel);
        // However little was asked for: one batch has no error, and is no reference.
        const bool hasError = count >= kBatchesForAnError;
        isDone = isDone || (hasError && stop.photons && sums_.photons() >= *stop.photons);
        isDone = isDone || (hasError && stop.seconds && secondsSince(start_) >= *stop.seconds);
        if (options_.progress) {
            const Progress progress{.batches = count,
                                    .targetBatches = stop.batches.value_or(0),
                                    .photons = sums_.photons(),
                                    .targetPhotons = stop.photons.value_or(0),
                                    .seconds = secondsSince(start_),
                                    .relativeError = relativeError_};
            isDone = !options_.progress(progress) || isDone;
        }
        if (isDone) stopped_.store(true);
        if (options_.save && secondsSince(lastSave_) >= options_.saveEverySeconds) {
            options_.save(sums_);
            lastSave_ = Clock::now();
        }
    }

  private:
    static constexpr std::uint64_t kErrorInterval = 4;
    static constexpr std::uint64_t kBatchesForAnError = 2;
    static constexpr std::uint64_t kBatchesForALitPixel = 64;

    [[nodiscard]] bool sumsHeldAtStart(std::uint64_t batch) const {
        return std::any_of(held_.begin(), held_.end(), [&](const BatchRange& range) {
            return batch >= range.first && batch < range.end;
        });
    }

    PixelSums& sums_;
    const RunOptions& options_;
    const std::vector<BatchRange> held_ = sums_.batches();
    std::uint64_t next_ = 0;
    std::uint64_t taken_ = 0;
    std::uint64_t batchesAtStart_ = 0;
    std::atomic<bool> stopped_{false};
    std::atomic<std::uint64_t> traced_{0};  // photons, those of unfinished batches too
    tbb::concurrent_queue<std::unique_ptr<BatchResult>> spare_;
    double relativeError_ = std::numeric_limits<double>::infinity();
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastSave_ = start_;
};

}  // namespace

void runBatches(PixelSums& sums, const RunOptions& options, const ComputeBatch& compute) {
    const bool endsByShard = options.shard.end != UINT64_MAX;
    const StopCondition& stop = options.stop;
    if (!stop.batches && !stop.photons && !stop.seconds && !stop.relativeError && !endsByShard) {
        throw ConfigError("A reference needs a number of photons, a time or an error to stop at.");
    }
    Run run(sums, options);
    const TracedMore tracedMore = [&](std::uint64_t photons) {
        return run.shouldContinue(photons);
    };
    runWithThreads(options.threads, [&] {
        // One more in flight than threads, so that none waits for the sums.
        tbb::parallel_pipeline(static_cast<std::size_t>(threadCount(options.threads)) + 1,
                               tbb::make_filter<void, std::shared_ptr<Job>>(
                                   tbb::filter_mode::serial_in_order,
                                   [&](tbb::flow_control& flow) -> std::shared_ptr<Job> {
                                       std::optional<Job> job = run.take();
                                       if (!job) {
                                           flow.stop();
                                           return nullptr;
                                       }
                                       return std::make_shared<Job>(std::move(*job));
                                   }) &
                                   tbb::make_filter<std::shared_ptr<Job>, std::shared_ptr<Job>>(
                                       tbb::filter_mode::parallel,
                                       [&](std::shared_ptr<Job> job) {
                                           compute(job->batch, *job->result, tracedMore);
                                           return job;
                                       }) &
                                   tbb::make_filter<std::shared_ptr<Job>, void>(
                                       tbb::filter_mode::serial_in_order,
                                       [&](const std::shared_ptr<Job>& job) { run.accept(*job); }));
    });
    if (options.save) options.save(sums);
}

}  // namespace kaustik::reference
