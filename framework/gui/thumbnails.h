// SPDX-License-Identifier: MIT
// Small pictures of scenes and techniques to choose by: rendered once by `kaustik run`, a process
// each at the lowest priority, kept in the cache, and made only while somebody looks at them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "framework/image/image.h"
#include "framework/params/field.h"

namespace kaustik::gui {

inline constexpr params::Extent kThumbnailSize{160, 120};

// What it is of.
struct ThumbnailSubject {
    std::string scene;  // a name or a file's path, as `kaustik run` takes it
    std::string technique;
    friend auto operator<=>(const ThumbnailSubject&, const ThumbnailSubject&) = default;
};

struct Thumbnail {
    enum class State { waiting, rendering, there, failed };
    State state = State::waiting;
    std::shared_ptr<const Image> image;  // display-encoded; null unless it is there
    std::uint64_t version = 0;           // no other thumbnail has it
    std::string problem;                 // why there is none
};

class ThumbnailWorker {
  public:
    // `onUpdate` is called on the worker's thread.
    explicit ThumbnailWorker(std::function<void()> onUpdate);
    ~ThumbnailWorker();
    ThumbnailWorker(const ThumbnailWorker&) = delete;
    ThumbnailWorker& operator=(const ThumbnailWorker&) = delete;

    // Those that are looked at now, the first first; of others none is made from then on, and one
    // that is being rendered ends.
    void want(std::vector<ThumbnailSubject> subjects);
    // What there is of it.
    [[nodiscard]] Thumbnail of(const ThumbnailSubject& subject) const;

  private:
    void run();
    [[nodiscard]] bool isWanted(const ThumbnailSubject& subject) const;
    void set(const ThumbnailSubject& subject, Thumbnail thumbnail);
    void make(const ThumbnailSubject& subject);

    std::function<void()> onUpdate_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool stop_ = false;
    std::vector<ThumbnailSubject> wanted_;
    std::map<ThumbnailSubject, Thumbnail> known_;
    std::uint64_t versions_ = 0;
    std::thread thread_;  // last: everything else is there when it begins
};

// The file in the cache's folder "thumbnails": its name is made of the program's version, the
// scene's own file as it is now, and the technique. What the scene's file only names, such as a
// mesh, does not count. Throws IoError for a scene's file that cannot be read.
[[nodiscard]] std::string thumbnailName(const ThumbnailSubject& subject);

}  // namespace kaustik::gui
