// SPDX-License-Identifier: MIT
#include "framework/gui/thumbnails.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/experiment/fingerprint.h"
#include "framework/experiment/process.h"
#include "framework/gui/priority.h"
#include "framework/run/cache_folder.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kThisProgram = "/proc/self/exe";
// Enough for a small picture, whatever a technique has by default.
constexpr const char* kPhotons = "128x128";

fs::path sceneFile(const std::string& scene) {
    if (scene::isSceneFile(scene)) return scene;
    return projectRoot() / "experiments/scenes" / (scene + ".toml");
}

// A folder that is gone with it.
class WorkFolder {
  public:
    explicit WorkFolder(fs::path path) : path_(std::move(path)) {}
    ~WorkFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

// Nothing where it is not there, or damaged.
std::shared_ptr<const Image> readCached(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return nullptr;
    try {
        return std::make_shared<const Image>(readImage(file));
    } catch (const IoError&) {
        return nullptr;
    }
}

}  // namespace

std::string thumbnailName(const ThumbnailSubject& subject) {
    const std::string text =
        fmt::format("{}\n{}\n{}x{}\n{}\n{}", versionString(), subject.technique,
                    kThumbnailSize.width, kThumbnailSize.height, kPhotons,
                    experiment::fingerprint(readFile(sceneFile(subject.scene))));
    return experiment::fingerprint(text) + displayImageExtension();
}

ThumbnailWorker::ThumbnailWorker(std::function<void()> onUpdate)
    : onUpdate_(std::move(onUpdate)), thread_([this] { run(); }) {}

ThumbnailWorker::~ThumbnailWorker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void ThumbnailWorker::want(std::vector<ThumbnailSubject> subjects) {
    {
        const std::lock_guard lock(mutex_);
        if (wanted_ == subjects) return;
        wanted_ = std::move(subjects);
    }
    wake_.notify_all();
}

Thumbnail ThumbnailWorker::of(const ThumbnailSubject& subject) const {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(subject);
    return found != known_.end() ? found->second : Thumbnail();
}

bool ThumbnailWorker::isWanted(const ThumbnailSubject& subject) const {
    const std::lock_guard lock(mutex_);
    return !stop_ && std::find(wanted_.begin(), wanted_.end(), subject) != wanted_.end();
}

void ThumbnailWorker::set(const ThumbnailSubject& subject, Thumbnail thumbnail) {
    {
        const std::lock_guard lock(mutex_);
        if (thumbnail.image) thumbnail.version = ++versions_;
        known_[subject] = std::move(thumbnail);
    }
    onUpdate_();
}

void ThumbnailWorker::run() {
    lowerPriority(kBackgroundPriority);
    for (;;) {
        std::optional<ThumbnailSubject> next;
        const auto find = [&] {
            next.reset();
            for (const ThumbnailSubject& subject : wanted_) {
                const auto found = known_.find(subject);
                if (found != known_.end() && found->second.state != Thumbnail::State::waiting)
                    continue;
                next = subject;
                return true;
            }
            return stop_;
        };
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, find);
            if (stop_) return;
        }
        try {
            make(*next);
        } catch (const std::exception& error) {
            set(*next, {Thumbnail::State::failed, nullptr, 0, error.what()});
        }
    }
}

void ThumbnailWorker::make(const ThumbnailSubject& subject) {
    const fs::path folder = run::cacheFolder() / "thumbnails";
    const fs::path file = folder / thumbnailName(subject);
    std::shared_ptr<const Image> image = readCached(file);
    if (!image) {
        set(subject, {Thumbnail::State::rendering, nullptr, 0, ""});
        fs::create_directories(folder);
        const WorkFolder work(unfinishedPath(file));
        const experiment::ProcessOutcome outcome = experiment::runProcess(
            kThisProgram,
            {"kaustik", "run", subject.scene, "--technique=" + subject.technique,
             fmt::format("--size={}x{}", kThumbnailSize.width, kThumbnailSize.height), "--frames=1",
             "--warmup=0", fmt::format("--set=emit.photons={}", kPhotons),
             "--out=" + work.path().string()},
            experiment::StandardOutput::dropped, [&] { return !isWanted(subject); });
        if (outcome.interrupted) return set(subject, {});
        if (const std::string problem = outcome.problem(); !problem.empty())
            return set(subject, {Thumbnail::State::failed, nullptr, 0, problem});
        fs::rename(work.path() / ("beauty" + displayImageExtension()), file);
        image = std::make_shared<const Image>(readImage(file));
    }
    set(subject, {Thumbnail::State::there, std::move(image), 0, ""});
}

}  // namespace kaustik::gui
