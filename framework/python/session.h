// SPDX-License-Identifier: MIT
// A renderer that keeps its state between calls, on a thread and an OpenGL context of its own. It
// knows no Python. Every method waits for its work; `keepWaiting` is WorkThread::run's, and where
// it says no a frame ends before its next pass and the method throws Stopped; the session goes on
// as if it had not been called, but for the frames that were whole. Errors as the command line's.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/pipeline/renderer.h"
#include "framework/python/array.h"
#include "framework/python/work_thread.h"
#include "framework/report/run_report.h"
#include "framework/scene/scene_edits.h"

namespace kaustik::python {

// Every technique and node of the project.
[[nodiscard]] const Registry& registry();

struct SessionOptions {
    std::string technique;
    std::string size;                             // WxH, pixels
    std::map<std::string, std::string> settings;  // by any unique short name
    std::vector<std::string> disabled;            // passes
    std::optional<double> time;                   // s; the scene's own without
    std::uint64_t seed = 1;
    bool isPrecise = false;      // finishes the device around each pass
    bool debugs = false;         // OpenGL errors by pass, in the driver's words
    std::string device;          // as gl::Context::createHeadless takes it
    bool isAsPublished = false;  // the technique's row is its paper's
};

struct StepRequest {
    int frames = 1;
    int warmup = 0;              // frames before these that are not timed
    std::optional<double> time;  // s, of the first frame
    // s, from frame to frame; where no time is given also from the frame before to the first.
    double timeStep = 0.0;
};

// What a frame is compared with, as `kaustik run --reference` takes it.
struct Judgement {
    std::string reference = "none";
    std::uint64_t photons = std::uint64_t{1} << 26;  // of auto, at least
};

class Session {
  public:
    using KeepWaiting = WorkThread::ShouldContinue;
    using Json = nlohmann::json;

    Session(const std::function<scene::Scene()>& loadScene, const SessionOptions& options,
            const KeepWaiting& keepWaiting);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Ends the work at hand and gives device and memory back; anything but another close() is then
    // a ConfigError.
    void close();
    [[nodiscard]] bool isClosed() const { return isClosed_; }

    // Parameters by any unique short name. What does not go together is told by the next step.
    void set(const std::map<std::string, std::string>& settings, const KeepWaiting& keepWaiting);
    // The parameter as run::describe() gives it, with `value` ([w, h] of an extent), `default` as
    // text, and `is_set`.
    [[nodiscard]] Json param(const std::string& name, const KeepWaiting& keepWaiting);
    [[nodiscard]] Json params(const KeepWaiting& keepWaiting);
    // Switches exactly these passes off, at once: where that cannot be, nothing changes.
    void disable(const std::vector<std::string>& passes, const KeepWaiting& keepWaiting);
    void resize(const std::string& size, const KeepWaiting& keepWaiting);
    void setSeed(std::uint64_t seed, const KeepWaiting& keepWaiting);
    // Camera, lights, waves, medium, time; `read` makes them on the session's thread.
    void edit(const std::function<scene::SceneEdits()>& read, const KeepWaiting& keepWaiting);

    // Renders frames. Gives their times: {frames, frame_ms, passes}, as in report.json.
    Json step(const StepRequest& request, const KeepWaiting& keepWaiting);
    // A texture of the frame that was rendered last, all layers or one. One that was not kept is
    // rendered once more with that frame, and kept from then on.
    [[nodiscard]] Array read(const std::string& resource, std::optional<std::size_t> layer,
                             const KeepWaiting& keepWaiting);
    // report.json, of the frames since anything was changed.
    [[nodiscard]] Json report(const Judgement& judgement, const KeepWaiting& keepWaiting);
    // What `kaustik run` writes; gives the files.
    std::vector<std::filesystem::path> save(const std::filesystem::path& folder,
                                            const std::vector<std::string>& resources,
                                            const Judgement& judgement,
                                            const KeepWaiting& keepWaiting);

    [[nodiscard]] Json passes(const KeepWaiting& keepWaiting);
    [[nodiscard]] Json resources(const KeepWaiting& keepWaiting);
    [[nodiscard]] Json needs(const KeepWaiting& keepWaiting);
    [[nodiscard]] std::string explain(const KeepWaiting& keepWaiting);
    // Times as step() gives them, of all frames since something was changed; also `picture`, the
    // resource that is the picture, and `is_stale`, whether something was changed after the last
    // frame.
    [[nodiscard]] Json times(const KeepWaiting& keepWaiting);
    // {scene, technique, as_published, size, seed, time_s, device, disabled}
    [[nodiscard]] Json state(const KeepWaiting& keepWaiting);

  private:
    struct Device;  // lives on the thread
    using ShouldContinue = WorkThread::ShouldContinue;

    void run(const std::function<void(Device& device, const ShouldContinue& shouldContinue)>& work,
             const KeepWaiting& keepWaiting);

    std::unique_ptr<Device> device_;
    std::atomic<bool> isClosed_{false};
    WorkThread thread_;
};

}  // namespace kaustik::python
