// SPDX-License-Identifier: MIT
// The ray-traced reference in the background: looked for in the cache, computed when asked for, and
// what each frame is worth next to it. On a thread of its own at low priority, which nothing waits
// for. Without Embree it says so and does nothing.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "framework/gui/document.h"
#include "framework/gui/histogram.h"
#include "framework/image/image.h"

namespace kaustik::run {
struct Outputs;
}

namespace kaustik::gui {

// What a reference depends on.
struct ReferenceAim {
    std::string scene;
    scene::SceneEdits edits;
    params::Extent size;
    ModelledPaths paths;   // interactions 0: nothing is modelled
    int sceneReloads = 0;  // FrameOrder::sceneReloads: another one, another scene of that name
    [[nodiscard]] bool operator==(const ReferenceAim& other) const;
};

// A frame to be judged.
struct JudgedFrame {
    std::uint64_t order = 0;
    std::shared_ptr<const run::Outputs> outputs;
};

struct ReferenceState {
    bool isLooking = false;  // in the cache
    std::string problem;
    std::uint64_t version = 0;        // of the pictures below: no other ones have it
    std::optional<ReferenceAim> aim;  // that all of the following is of
    std::uint64_t photons = 0;        // 0: there is no reference
    std::uint64_t allPhotons = 0;     // with those of the reference of modelled paths
    double relativeError = 0.0;
    std::shared_ptr<const Image> irradiance;  // W/m², top row first
    std::shared_ptr<Histograms> histograms = std::make_shared<Histograms>();  // of that
    struct Judgement {
        std::uint64_t order = 0;  // that the frame answered; 0: none yet
        nlohmann::json whole;     // as `error` of report.json
        nlohmann::json modelled;  // as `error.modelled_paths`; null where unknown
        // Of the caustic irradiance, the reference's taken off, W/m²: the mean of the channels by
        // pixel, NaN where none is judged. Null where there is none.
        std::shared_ptr<const Image> error;
        Histogram errorHistogram;
    };
    std::array<Judgement, 2> judgements;  // of A and B
};

class ReferenceWorker {
  public:
    // `onUpdate` is called on the worker's thread.
    explicit ReferenceWorker(std::function<void()> onUpdate);
    ~ReferenceWorker();  // what has been computed is kept
    ReferenceWorker(const ReferenceWorker&) = delete;
    ReferenceWorker& operator=(const ReferenceWorker&) = delete;

    // What the reference should be of, from now on; true where it ends a computation of something
    // else.
    [[nodiscard]] bool aim(const ReferenceAim& aim);
    // Goes on computing until there are so many photons.
    void compute(std::uint64_t photons);
    // Ends it within a moment; what there is by whole batches stays.
    void stopComputing();
    // Answers compute() and stopComputing() at once, whatever the thread is doing.
    struct Progress {
        bool isComputing = false;  // or will, after what is at hand
        bool isEnding = false;
        double share = 0.0;   // of what was asked for; never less than before
        std::string reached;  // "3.1 of 8.0 million photons, standard error 2.1 %"
    };
    [[nodiscard]] Progress progress() const;
    // The newest frames of A and B; those before are forgotten.
    void judge(const std::array<JudgedFrame, 2>& frames);

    [[nodiscard]] std::shared_ptr<const ReferenceState> state() const;

  private:
    struct Loaded;  // scene and references, on the thread

    void run();
    void post();
    void look(Loaded& loaded, const ReferenceAim& aim);
    void computeMore(Loaded& loaded, std::uint64_t photons);
    // Begins to trace so many more photons for both references, each of which has `photons` in the
    // end.
    void beginRun(const Loaded& loaded, std::uint64_t photonsMore, std::uint64_t photons);
    void judgeFrames(Loaded& loaded, const std::array<JudgedFrame, 2>& frames);
    void useLoaded(const Loaded& loaded);
    [[nodiscard]] bool isSuperseded() const;

    std::function<void()> onUpdate_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool stop_ = false;
    std::optional<ReferenceAim> wantedAim_;  // newest
    std::optional<ReferenceAim> currentAim_;
    std::uint64_t wantedPhotons_ = 0;  // 0: none
    std::optional<std::array<JudgedFrame, 2>> wantedFrames_;
    bool isAtWork_ = false;  // in computeMore()
    // Photons: before the run at hand, that it may add, that are asked for; of all references.
    struct Run {
        std::uint64_t before = 0;
        std::uint64_t more = 0;
        std::uint64_t wanted = 0;
        std::uint64_t references = 1;
        double relativeError = 0.0;  // not finite where unknown
    };
    std::optional<Run> progress_;           // nothing before the first
    std::atomic<std::uint64_t> traced_{0};  // in the run at hand
    std::shared_ptr<const ReferenceState> state_ = std::make_shared<const ReferenceState>();
    ReferenceState working_;  // the thread's own
    std::uint64_t versions_ = 0;
    std::thread thread_;
};

}  // namespace kaustik::gui
