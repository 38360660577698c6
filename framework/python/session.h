// SPDX-License-Identifier: MIT
// A renderer that keeps its state between calls, on a thread and an OpenGL context of its own. It
// knows no Python. Every method waits for its work; `mayWait` is WorkThread::run's, and where it
// says no a frame ends before its next pass and the method throws Stopped; the session goes on as
// if it had not been called, but for the frames that were whole. Errors as the command line's.
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
    bool isPrecise = false;  // finishes the device around each pass
    bool debugs = false;     // OpenGL errors by pass, in the driver's words
    std::string device;      // as gl::Context::createHeadless takes it
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
    using MayWait = WorkThread::GoesOn;
    using Json = nlohmann::json;

    Session(const std::function<scene::Scene()>& loadScene, const SessionOptions& options,
            const MayWait& mayWait);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Ends the work at hand and gives device and memory back; anything but another close() is then
    // a ConfigError.
    void close();
    [[nodiscard]] bool isClosed() const { return isClosed_; }

    // Parameters by any unique short name. What does not go together is told by the next step.
    void set(const std::map<std::string, std::string>& settings, const MayWait& mayWait);
    // As run::describe(), with `value` ([w, h] of an extent), `default` as text, `is_set`.
    [[nodiscard]] Json param(const std::string& name, const MayWait& mayWait);
    [[nodiscard]] Json params(const MayWait& mayWait);
    // Switches exactly these passes off, at once: where that cannot be, nothing changes.
    void disable(const std::vector<std::string>& passes, const MayWait& mayWait);
    void resize(const std::string& size, const MayWait& mayWait);
    void setSeed(std::uint64_t seed, const MayWait& mayWait);
    // Camera, lights, waves, medium, time; `read` makes them on the session's thread.
    void edit(const std::function<scene::SceneEdits()>& read, const MayWait& mayWait);

    // Renders frames. Gives their times: {frames, frame_ms, passes}, as in report.json.
    Json step(const StepRequest& request, const MayWait& mayWait);
    // A texture of the frame that was rendered last, all layers or one. One that was not kept is
    // rendered once more with that frame, and kept from then on.
    [[nodiscard]] Array read(const std::string& resource, std::optional<std::size_t> layer,
                             const MayWait& mayWait);
    // report.json, of the frames since anything was changed.
    [[nodiscard]] Json report(const Judgement& judgement, const MayWait& mayWait);
    // What `kaustik run` writes; gives the files.
    std::vector<std::filesystem::path> save(const std::filesystem::path& folder,
                                            const std::vector<std::string>& resources,
                                            const Judgement& judgement, const MayWait& mayWait);

    [[nodiscard]] Json passes(const MayWait& mayWait);
    [[nodiscard]] Json resources(const MayWait& mayWait);
    [[nodiscard]] Json needs(const MayWait& mayWait);
    [[nodiscard]] std::string explain(const MayWait& mayWait);
    // As step() gives them, of all frames since something was changed; also `picture`, the resource
    // that is the picture, and `is_stale`, whether something was changed after the last frame.
    [[nodiscard]] Json times(const MayWait& mayWait);
    // {scene, technique, size, seed, time_s, device, disabled}
    [[nodiscard]] Json state(const MayWait& mayWait);

  private:
    struct Device;  // lives on the thread
    using GoesOn = WorkThread::GoesOn;

    void run(const std::function<void(Device& device, const GoesOn& goesOn)>& work,
             const MayWait& mayWait);

    std::unique_ptr<Device> device_;
    std::atomic<bool> isClosed_{false};
    WorkThread thread_;
};

}  // namespace kaustik::python
