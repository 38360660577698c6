// SPDX-License-Identifier: MIT
// The renderer on a thread and an OpenGL context of its own, so that the window stays awake however
// long a frame takes. The window submits what it wants to see; the newest order counts, and a frame
// of an older one is ended before its next pass. What was rendered comes back as values.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "framework/gui/frame_result.h"
#include "framework/gui/variant_renderer.h"

namespace kaustik::gui {

struct FrameOrder {
    Document document;
    Viewing viewing;
    // Frames until the order is settled; 0: for ever.
    int frames = 8;
    bool isPrecise = false;  // finishes the device around each pass
    bool isPreview = false;  // the view is being turned: be quick
    // A value is being dragged: the frame of the order before is worth finishing.
    bool isPassing = false;
    struct Probe {
        glm::ivec2 pixel{0};
        float radiusPixels = 1.0f;
        friend bool operator==(const Probe&, const Probe&) = default;
    };
    std::optional<Probe> probe;  // of variant A
    int sceneReloads = 0;        // counts how often the scene's file was to be read again
};

// What to write on the renderer's thread, of the document as it is in the order then.
struct RecordRequest {
    enum class RecordingKind { report, sequence };
    RecordingKind what = RecordingKind::report;
    std::filesystem::path folder;
    int frames = 8;  // timed, or of the sequence
    // Photons at least of the reference that a report is judged by, computed where there is none; 0
    // for a report without `error` and `hits`.
    std::uint64_t referencePhotons = 0;
    double secondsPerFrame = 1.0 / 30.0;  // sequence
};

class RenderWorker {
  public:
    // `onUpdate` is called on the worker's thread whenever there is something new to see.
    RenderWorker(const Registry& registry, std::function<void()> onUpdate);
    ~RenderWorker();  // ends the frame at its next pass
    RenderWorker(const RenderWorker&) = delete;
    RenderWorker& operator=(const RenderWorker&) = delete;

    // Gives the order's number.
    std::uint64_t submit(FrameOrder order);
    [[nodiscard]] std::shared_ptr<const FrameResult> latest() const;

    // What is being done right now, for a progress bar.
    struct Progress {
        bool isBusy = false;
        std::string what;  // "A: layers.peel"
        // The part that is done of all that the order asks for. It never falls until there is
        // another order. There is none where frames go on for ever.
        std::optional<double> share;
        double seconds = 0.0;  // since this frame began
    };
    [[nodiscard]] Progress progress() const;

    void record(RecordRequest request);
    void cancelRecording();
    struct Recording {
        bool isActive = false;
        std::string message;  // how far it is, or how it ended
        bool hasFailed = false;
        std::filesystem::path folder = {};  // RecordRequest::folder; record() knows it
    };
    [[nodiscard]] Recording recording() const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Device;  // context, scene, renderers and the order at hand; lives on the thread

    void run();
    void serve(Device& device);
    // Each does one piece of work; the next order is looked for between them.
    void renderOnce(Device& device);
    bool renderFirstPictures(Device& device);
    void renderExtras(Device& device);
    void look(Device& device);
    bool loadScene(Device& device);
    void reloadShaders(Device& device);
    void writeRecording(Device& device, const RecordRequest& request);
    void writeReport(Device& device, const RecordRequest& request);
    void writeSequence(Device& device, const RecordRequest& request);
    void post();
    void setRecording(Recording state);
    [[nodiscard]] VariantRenderer::ShouldContinue watch(const Device& device,
                                                        const std::string& what);

    const Registry& registry_;
    std::function<void()> onUpdate_;

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<FrameOrder> order_;                 // newest
    std::uint64_t number_ = 0;                        // its number
    std::atomic<std::uint64_t> endsFramesBefore_{0};  // numbers of orders
    std::optional<RecordRequest> request_;
    std::atomic<bool> cancelRecording_{false};
    std::atomic<bool> stop_{false};
    std::shared_ptr<const FrameResult> latest_;
    Progress progress_;
    Clock::time_point frameBegin_;
    Recording recording_;
    FrameResult working_;  // the thread's own, of which copies are posted

    std::thread thread_;  // last: everything else is there when it begins
};

}  // namespace kaustik::gui
