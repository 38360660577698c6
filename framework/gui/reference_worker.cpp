// SPDX-License-Identifier: MIT
#include "framework/gui/reference_worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/core/error.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/gui/priority.h"
#include "framework/reference/reference.h"
#include "framework/run/caustic_errors.h"
#include "framework/run/reference_work.h"
#endif

namespace kaustik::gui {

bool ReferenceAim::operator==(const ReferenceAim& other) const {
    return scene == other.scene && edits == other.edits && size == other.size &&
           paths.transmissionOnly == other.paths.transmissionOnly &&
           paths.reflectionOnly == other.paths.reflectionOnly &&
           paths.interactions == other.paths.interactions && sceneReloads == other.sceneReloads;
}

ReferenceWorker::ReferenceWorker(std::function<void()> onUpdate)
    : onUpdate_(std::move(onUpdate)), thread_([this] { run(); }) {}

ReferenceWorker::~ReferenceWorker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

bool ReferenceWorker::aim(const ReferenceAim& aim) {
    bool hasEnded = false;
    {
        const std::lock_guard lock(mutex_);
        if (wantedAim_ == aim) return false;
        wantedAim_ = aim;
        hasEnded = std::exchange(wantedPhotons_, 0) > 0;
        wantedFrames_.reset();
    }
    wake_.notify_all();
    return hasEnded;
}

void ReferenceWorker::compute(std::uint64_t photons) {
    {
        const std::lock_guard lock(mutex_);
        wantedPhotons_ = photons;
        progress_.reset();
    }
    wake_.notify_all();
}

void ReferenceWorker::stopComputing() {
    const std::lock_guard lock(mutex_);
    wantedPhotons_ = 0;
}

ReferenceWorker::Progress ReferenceWorker::progress() const {
    const std::lock_guard lock(mutex_);
    Progress now;
    now.isComputing = wantedPhotons_ > 0;
    now.isEnding = !now.isComputing && isAtWork_;
    if (!progress_) {
        now.reached = "beginning";
        return now;
    }
    // What is traced beyond the run's end is not kept.
    const Run& run = *progress_;
    const std::uint64_t done = run.before + std::min<std::uint64_t>(traced_, run.more);
    now.share = std::min(1.0, static_cast<double>(done) / static_cast<double>(run.wanted));
    const double each = 1e-6 / static_cast<double>(run.references);
    now.reached = fmt::format("{:.1f} of {:.1f} million photons", static_cast<double>(done) * each,
                              static_cast<double>(run.wanted) * each);
    if (std::isfinite(run.relativeError))
        now.reached += fmt::format(", standard error {:.2f} %", 100.0 * run.relativeError);
    return now;
}

void ReferenceWorker::judge(const std::array<JudgedFrame, 2>& frames) {
    {
        const std::lock_guard lock(mutex_);
        wantedFrames_ = frames;
    }
    wake_.notify_all();
}

std::shared_ptr<const ReferenceState> ReferenceWorker::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void ReferenceWorker::post() {
    {
        const std::lock_guard lock(mutex_);
        state_ = std::make_shared<const ReferenceState>(working_);
    }
    onUpdate_();
}

bool ReferenceWorker::isSuperseded() const {
    const std::lock_guard lock(mutex_);
    return stop_ || wantedAim_ != currentAim_ || wantedPhotons_ == 0;
}

#ifndef KAUSTIK_HAS_EMBREE

struct ReferenceWorker::Loaded {};
void ReferenceWorker::run() {
    working_.problem = "This program was built without Embree and knows no reference.";
    post();
}

#else

namespace {

using reference::Reference;
using reference::ReferenceRequest;

// Between two looks at what else there is to do, and two pictures of the reference.
constexpr std::uint64_t kPhotonsPerBatch = 1u << 22;

// While it lives something is at work.
class AtWork {
  public:
    AtWork(std::mutex& mutex, bool& isAtWork) : mutex_(mutex), isAtWork_(isAtWork) { set(true); }
    ~AtWork() { set(false); }
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;

  private:
    void set(bool isAtWork) {
        const std::lock_guard lock(mutex_);
        isAtWork_ = isAtWork;
    }
    std::mutex& mutex_;
    bool& isAtWork_;
};

// The mean of the channels' differences by pixel, NaN where the pair leaves one out.
Image signedError(const measure::ImagePair& pair) {
    Image error(pair.width(), pair.height(), 1);
    const auto channels = static_cast<std::size_t>(pair.image().channels);
    for (std::size_t pixel = 0; pixel < pair.pixelCount(); ++pixel) {
        double sum = 0.0;
        for (std::size_t c = 0; c < channels; ++c) {
            sum += static_cast<double>(pair.image().values[channels * pixel + c]) -
                   static_cast<double>(pair.reference().values[channels * pixel + c]);
        }
        error.values[pixel] = pair.counts(pixel)
                                  ? static_cast<float>(sum / static_cast<double>(channels))
                                  : std::numeric_limits<float>::quiet_NaN();
    }
    return error;
}

std::filesystem::path cache() {
    return run::cacheFolder() / "references";
}

}  // namespace

struct ReferenceWorker::Loaded {
    explicit Loaded(scene::Scene s) : scene(std::move(s)) {}
    scene::Scene scene;
    std::optional<reference::EmbreeScene> embree;  // made when first computed with
    ReferenceRequest request;
    std::optional<ReferenceRequest> modelledRequest;
    std::optional<Reference> whole;
    std::optional<Reference> modelled;
};

void ReferenceWorker::run() {
    lowerPriority(kBackgroundPriority);
    std::unique_ptr<Loaded> loaded;
    for (;;) {
        bool hasNewAim = false;
        std::uint64_t photons = 0;
        std::optional<std::array<JudgedFrame, 2> > frames;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] {
                return stop_ || wantedAim_ != currentAim_ || wantedPhotons_ > 0 || wantedFrames_;
            });
            if (stop_) return;
            hasNewAim = wantedAim_ != currentAim_;
            currentAim_ = wantedAim_;
            if (!hasNewAim) {
                frames = std::exchange(wantedFrames_, {});
                photons = wantedPhotons_;
            }
        }
        try {
            if (hasNewAim) {
                loaded.reset();
                working_ = {};
                working_.isLooking = true;
                post();
                loaded = std::make_unique<Loaded>(
                    sceneOf({currentAim_->scene, currentAim_->edits, currentAim_->size, {}, {}}));
                look(*loaded, *currentAim_);
            } else if (loaded && frames && loaded->whole) {
                judgeFrames(*loaded, *frames);
            } else if (loaded && photons > 0) {
                computeMore(*loaded, photons);
            } else {
                stopComputing();
            }
        } catch (const std::exception& error) {
            working_.problem = error.what();
            working_.isLooking = false;
            stopComputing();
            post();
        }
    }
}

void ReferenceWorker::useLoaded(const Loaded& loaded) {
    working_.version = ++versions_;
    working_.photons = loaded.whole ? loaded.whole->photons : 0;
    working_.allPhotons = working_.photons + (loaded.modelled ? loaded.modelled->photons : 0);
    working_.relativeError = loaded.whole ? loaded.whole->relativeError : 0.0;
    working_.irradiance =
        loaded.whole ? std::make_shared<const Image>(loaded.whole->irradiance) : nullptr;
    working_.histograms = std::make_shared<Histograms>();
    if (working_.irradiance) static_cast<void>(working_.histograms->all(*working_.irradiance));
}

void ReferenceWorker::look(Loaded& loaded, const ReferenceAim& aim) {
    loaded.request.width = aim.size.width;
    loaded.request.height = aim.size.height;
    if (aim.paths.interactions > 0) {
        loaded.modelledRequest = loaded.request;
        loaded.modelledRequest->filter = run::modelledFilter(loaded.request.filter, aim.paths);
    }
    loaded.whole = findCached(loaded.scene, loaded.request, cache());
    if (loaded.modelledRequest)
        loaded.modelled = findCached(loaded.scene, *loaded.modelledRequest, cache());
    working_.aim = aim;
    working_.isLooking = false;
    useLoaded(loaded);
    post();
}

void ReferenceWorker::beginRun(const Loaded& loaded, std::uint64_t photonsMore,
                               std::uint64_t photons) {
    const auto done = [&](const std::optional<Reference>& reference) {
        return reference ? std::min(reference->photons, photons) : std::uint64_t{0};
    };
    const std::uint64_t references = loaded.modelledRequest ? 2 : 1;
    const std::lock_guard lock(mutex_);
    traced_ = 0;
    progress_ = {done(loaded.whole) + done(loaded.modelled), photonsMore, references * photons,
                 references, loaded.whole ? loaded.whole->relativeError : HUGE_VAL};
}

void ReferenceWorker::computeMore(Loaded& loaded, std::uint64_t photons) {
    const AtWork atWork(mutex_, isAtWork_);
    if (!loaded.embree) loaded.embree.emplace(loaded.scene);
    photons = std::max(photons, 2 * loaded.request.photonsPerBatch);  // else its error is unknown
    const auto photonsOf = [](const std::optional<Reference>& reference) {
        return reference ? reference->photons : std::uint64_t{0};
    };
    const std::uint64_t before = photonsOf(loaded.whole);
    const std::uint64_t target = std::min(
        photons, before + std::max(kPhotonsPerBatch / 8, std::min(before, kPhotonsPerBatch)));
    working_.problem.clear();
    reference::RunOptions options;
    options.stop.photons = target;
    options.progress = [&](const reference::Progress&) { return !isSuperseded(); };
    options.pulse = [&](std::uint64_t traced) {
        traced_ = traced;
        return !isSuperseded();
    };
    const auto ignore = [](const std::string&) {};
    const auto bring = [&](std::optional<Reference>& reference, const ReferenceRequest& request) {
        const std::uint64_t has = photonsOf(reference);
        if (has >= target || isSuperseded()) return;
        beginRun(loaded, target - has, photons);
        reference = loadOrCompute(*loaded.embree, request, cache(), options, ignore);
    };
    try {
        bring(loaded.whole, loaded.request);
        if (loaded.modelledRequest) bring(loaded.modelled, *loaded.modelledRequest);
    } catch (const ConfigError&) {
        if (!isSuperseded())
            throw;  // else: ended below two batches, of which there is no reference
    }
    const std::uint64_t after = photonsOf(loaded.whole);
    // Where no light hits a specular surface there are no photons, however long it takes.
    if (loaded.whole && after == 0)
        working_.problem = "No light hits a specular surface: there is no caustic to compare.";
    if (after >= photons || (loaded.whole && after == 0)) stopComputing();
    const std::uint64_t allBefore = working_.allPhotons;
    useLoaded(loaded);
    if (working_.allPhotons != allBefore) {
        for (ReferenceState::Judgement& judgement : working_.judgements)
            judgement.order = 0;  // by a worse reference: frames are to be judged again
    }
    post();
}

void ReferenceWorker::judgeFrames(Loaded& loaded, const std::array<JudgedFrame, 2>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        ReferenceState::Judgement judgement;
        if (frames[i].outputs) {
            const run::Outputs& outputs = *frames[i].outputs;
            const Image& image = outputs.images.front().image;
            if (image.width != loaded.request.width || image.height != loaded.request.height)
                continue;
            judgement.order = frames[i].order;
            judgement.whole = errorsAgainst(outputs, *loaded.whole);
            if (loaded.modelled) judgement.modelled = errorsAgainst(outputs, *loaded.modelled);
            if (outputs.seesReceivers && !judgement.whole.at("caustic_irradiance").is_null()) {
                judgement.error = std::make_shared<const Image>(
                    signedError(pairOf(outputs, outputs.images.front(), *loaded.whole)));
                judgement.errorHistogram = histogramOf(*judgement.error);
            }
        }
        working_.judgements[i] = std::move(judgement);
    }
    working_.version = ++versions_;
    post();
}

#endif

}  // namespace kaustik::gui
