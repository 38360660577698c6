// SPDX-License-Identifier: MIT
#include "framework/gui/workbench.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/app/progress.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/recording_name.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kHistory = 200;
// A frame that takes longer is replaced by a quick one while the view is being turned.
constexpr double kSlowFrameMs = 150.0;
// Frames after a change, for a median; fewer where one takes long.
constexpr int kFramesUntilSettled = 8;
constexpr int kSlowFramesUntilSettled = 3;
constexpr std::size_t kInterfaceFramesKept = 1000;

json readKept(const fs::path& folder) {
    if (folder.empty()) return {};
    try {
        return json::parse(readFile(folder / "workbench.json"), nullptr, false);
    } catch (const Error&) {
        return {};  // the first start
    }
}

}  // namespace

Workbench::Workbench(const Registry& registry, const WorkbenchOptions& options)
    : registry_(registry),
      folder_(settingsFolder()),
      kept_(keptFromJson(readKept(folder_))),
      window_("Kaustik", kept_.window, folder_.empty() ? fs::path() : folder_ / "imgui.ini"),
      map_(options.describe),
      renderer_(std::make_unique<RenderWorker>(registry, &Window::wake)),
      truthWorker_(&Window::wake),
      bench_{registry_,
             renderer_.get(),
             truthWorker_,
             canvas_,
             map_,
             window_.scale(),
             {},
             kept_.view,
             kept_.panels,
             std::make_shared<const FrameResult>(),
             truthWorker_.state(),
             scene::listScenes()} {
    loadKept(options.scene);
}

Workbench::~Workbench() {
    keep();
}

void Workbench::loadKept(const std::string& scene) {
    const json all = readKept(folder_);
    if (all.is_object() && all.contains("document")) {
        bench_.document = documentFromJson(all.at("document"));
        try {
            // Settings of a version that had other names.
            static_cast<void>(settingsOf(bench_.document.variant, {1, 1}, registry_));
            if (bench_.document.other)
                static_cast<void>(settingsOf(*bench_.document.other, {1, 1}, registry_));
        } catch (const Error& error) {
            bench_.document.variant = {};
            bench_.document.other.reset();
            bench_.say(fmt::format("Some settings of the last time were dropped: {}", error.what()),
                       true);
        }
    }
    if (!scene.empty() && scene != bench_.document.scene) {
        bench_.document.scene = scene;
        bench_.document.edits = {};
    }
    if (bench_.view.beside == Beside::other && !bench_.document.other)
        bench_.view.beside = Beside::nothing;
    history_ = {bench_.document};
}

void Workbench::keep() {
    if (folder_.empty()) return;
    kept_.view = bench_.view;
    kept_.panels = bench_.panels;
    kept_.window = window_.placement();
    json all = toJson(kept_);
    all["document"] = toJson(bench_.document);
    std::string text = all.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    if (text == keptText_) return;
    keptText_ = std::move(text);
    try {
        writeFileWhole(folder_ / "workbench.json", keptText_);
    } catch (const Error& error) {
        bench_.say(error.what(), true);
    }
}

// A crash or a power cut loses two seconds at most.
void Workbench::keepNowAndThen() {
    if (Clock::now() - keptAt_ < std::chrono::seconds(2)) return;
    keptAt_ = Clock::now();
    keep();
}

void Workbench::run() {
    while (!window_.isClosing()) {
        window_.beginFrame(patience());
        frameBegin_ = Clock::now();
        if (framesToDraw_ > 0) --framesToDraw_;
        const ImGuiIO& io = ImGui::GetIO();
        const bool hasInput = io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f ||
                              io.MouseWheel != 0.0f || ImGui::IsAnyMouseDown() ||
                              ImGui::IsAnyItemActive() || window_.hadInput() || bench_.isTurning ||
                              Clock::now() - turnedAt_ < std::chrono::milliseconds(500);
        // Dear ImGui needs a few frames to answer what it was told.
        if (hasInput) framesToDraw_ = 3;
        if (app::isInterrupted()) window_.close();
        takeNews();
        takeDropped();
        bench_.isDragging = false;
        bench_.isTurning = false;
        map_.beginFrame();
        draw();
        rememberForUndo();
        submitChanges();
        aimTruth();
        describe();
        window_.drawFrame();
        saveScreenshot();
        window_.endFrame();
        map_.endFrame();
        finishScreenshot();
        keepNowAndThen();
        interfaceMs_.push_back(
            std::chrono::duration<double, std::milli>(Clock::now() - frameBegin_).count());
        if (interfaceMs_.size() > kInterfaceFramesKept) interfaceMs_.pop_front();
    }
    // The pass at hand may take seconds yet.
    keep();
    window_.hide();
}

// How long the window may sleep, s: while the hand is at work not at all.
double Workbench::patience() const {
    // Who reads the description waits for it.
    if (framesToDraw_ > 0 || bench_.isPlaying || map_.isOn()) {
        const double since = std::chrono::duration<double>(Clock::now() - frameBegin_).count();
        return std::max(1.0 / 60.0 - since, 0.0);
    }
    return bench_.renderer->progress().isBusy || bench_.truth->work == TruthState::Work::computing
               ? 0.1
               : 0.25;
}

void Workbench::takeNews() {
    if (bench_.wantsRestart) {
        bench_.wantsRestart = false;
        renderer_.reset();
        renderer_ = std::make_unique<RenderWorker>(registry_, &Window::wake);
        bench_.renderer = renderer_.get();
        bench_.result = std::make_shared<const FrameResult>();
        hasSubmitted_ = false;
        judgedOrder_ = 0;
        bench_.say("The renderer was started again.");
    }
    if (const auto latest = renderer_->latest(); latest && latest != bench_.result) {
        bench_.result = latest;
        framesToDraw_ = std::max(framesToDraw_, 2);
        if (!kept_.knowsDevice && !latest->device.renderer.empty()) {
            // What times mean on a software rasteriser is known without asking the user.
            bench_.panels.isPrecise = latest->device.isSoftware;
            kept_.knowsDevice = true;
        }
    }
    if (const auto state = truthWorker_.state(); state != bench_.truth) {
        bench_.truth = state;
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    // The next step of an animation, once this one is seen.
    const VariantResult& first = bench_.result->variants[0];
    if (bench_.isPlaying && bench_.isSceneCurrent() && first.frame != playedFrame_ &&
        first.order == orderNumber_) {
        playedFrame_ = first.frame;
        bench_.document.edits.timeSeconds =
            bench_.timeSeconds() + double(bench_.panels.sequenceStep);
    }
}

void Workbench::takeDropped() {
    const std::vector<std::string> dropped = window_.takeDropped();
    if (dropped.empty()) return;
    if (!scene::isSceneFile(dropped.front())) {
        bench_.say(
            fmt::format("'{}' is no scene: drop a .toml, .gltf or .glb file.", dropped.front()),
            true);
        return;
    }
    bench_.document.scene = dropped.front();
    bench_.document.edits = {};
    bench_.view.probePixel = glm::ivec2(-1);
    bench_.say(fmt::format("Opened {}.", dropped.front()));
}

// Whether the hand is at work, or was a moment ago: wheels and keys have no end of their own.
bool Workbench::isAtWork() {
    if (bench_.isTurning) turnedAt_ = Clock::now();
    return bench_.isDragging || ImGui::IsAnyItemActive() ||
           Clock::now() - turnedAt_ < std::chrono::milliseconds(250);
}

void Workbench::submitChanges() {
    FrameOrder order;
    order.document = bench_.document;
    order.viewing.resource = bench_.view.beside == Beside::truth && bench_.view.resource.empty()
                                 ? "caustic.irradiance"
                                 : bench_.view.resource;
    order.viewing.layer = bench_.view.layer;
    order.viewing.readsOutputs =
        bench_.truth->photons > 0 || !(bench_.panels.isEndless || bench_.isPlaying);
    const double frameMs = medianOf(bench_.result->variants[0].frameMs);
    const bool isSlow = frameMs > kSlowFrameMs;
    order.frames = bench_.panels.isEndless ? 0
                   : bench_.isPlaying      ? 1
                   : isSlow                ? kSlowFramesUntilSettled
                                           : kFramesUntilSettled;
    order.isPrecise = bench_.panels.isPrecise;
    order.sceneReloads = bench_.sceneReloads;
    const bool isHeld = isAtWork();
    order.isPreview = bench_.isTurning && isSlow;
    // Once the quick frames have begun they last until the hand lets go.
    if (hasSubmitted_ && submitted_.isPreview && isHeld) order.isPreview = true;
    // Else a hand that never rests would end every frame that it has asked for.
    const bool isFollowUp = order.isPreview && hasSubmitted_ && submitted_.isPreview;
    order.isPassing = (isHeld && !order.isPreview) || isFollowUp || bench_.isPlaying;
    if (bench_.view.probes && bench_.view.probePixel.x >= 0 && !order.isPreview)
        order.probe = {bench_.view.probePixel, bench_.view.probeRadius};
    const bool isSame =
        hasSubmitted_ && submitted_.document == order.document &&
        submitted_.viewing == order.viewing && submitted_.frames == order.frames &&
        submitted_.isPrecise == order.isPrecise && submitted_.isPreview == order.isPreview &&
        submitted_.probe == order.probe && submitted_.sceneReloads == order.sceneReloads;
    if (isSame) return;
    submitted_ = order;
    hasSubmitted_ = true;
    orderNumber_ = renderer_->submit(std::move(order));
}

void Workbench::aimTruth() {
    const FrameResult& result = *bench_.result;
    const VariantResult& first = result.variants[0];
    // Only of what has been rendered as it stands, and not of every step of a movement.
    if (bench_.isPlaying || bench_.isDragging || first.isPreview || first.frame == 0 ||
        first.order != orderNumber_ || !first.error.empty() || !result.problem.empty()) {
        return;
    }
    const TruthAim aim{result.document.scene, result.document.edits, result.document.size,
                       first.paths, submitted_.sceneReloads};
    truthWorker_.aim(aim);
    // Frames of one order and the same shaders are the same: one is judged.
    const bool isNew = result.order != judgedOrder_ || bench_.truth->photons != judgedPhotons_ ||
                       result.shaderReloads != judgedReloads_;
    const VariantResult& second = result.variants[1];
    const bool hasBoth = !result.document.other || (second.outputs && second.order == orderNumber_);
    if (bench_.truth->photons == 0 || !first.outputs || !hasBoth || !isNew ||
        bench_.truth->aim != aim) {
        return;
    }
    judgedOrder_ = result.order;
    judgedPhotons_ = bench_.truth->photons;
    judgedReloads_ = result.shaderReloads;
    truthWorker_.judge(
        {JudgedFrame{result.order, first.outputs}, JudgedFrame{result.order, second.outputs}});
}

void Workbench::rememberForUndo() {
    if (isAtWork() || bench_.isPlaying) return;
    if (bench_.document == history_[historyPlace_]) return;
    history_.resize(historyPlace_ + 1);
    history_.push_back(bench_.document);
    if (history_.size() > kHistory) history_.pop_front();
    historyPlace_ = history_.size() - 1;
}

void Workbench::undo(int direction) {
    const auto place = static_cast<std::ptrdiff_t>(historyPlace_) + direction;
    if (place < 0 || place >= static_cast<std::ptrdiff_t>(history_.size())) return;
    historyPlace_ = static_cast<std::size_t>(place);
    bench_.document = history_[historyPlace_];
    if (!bench_.document.other) bench_.panels.edited = 0;
}

void Workbench::useKeys() {
    ImGuiIO& io = ImGui::GetIO();
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (pressed(GLFW_KEY_F1)) bench_.showsHelp = !bench_.showsHelp;
    if (pressed(GLFW_KEY_F5)) ++bench_.sceneReloads;
    if (pressed(GLFW_KEY_F12)) bench_.wantsScreenshot = true;
    if (io.KeyCtrl) {
        if (pressed(GLFW_KEY_S)) saveExperiment(bench_);
        if (pressed(GLFW_KEY_Q)) window_.close();
        if (!io.WantTextInput && pressed(GLFW_KEY_Z)) undo(io.KeyShift ? 1 : -1);
        if (!io.WantTextInput && pressed(GLFW_KEY_Y)) undo(1);
        return;
    }
    if (io.WantTextInput) return;
    if (pressed(GLFW_KEY_SPACE) && !ImGui::IsAnyItemFocused()) bench_.isPlaying = !bench_.isPlaying;
    if (pressed(GLFW_KEY_PERIOD) && bench_.result->scene) {
        bench_.isPlaying = false;
        bench_.document.edits.timeSeconds =
            bench_.timeSeconds() + double(bench_.panels.sequenceStep);
    }
    if (pressed(GLFW_KEY_0)) bench_.view.zoom = 0.0f;
    if (pressed(GLFW_KEY_R)) bench_.document.edits.camera.reset();
    if (pressed(GLFW_KEY_L)) bench_.view.showsLights = !bench_.view.showsLights;
    if (pressed(GLFW_KEY_F)) bench_.view.isFalseColor = !bench_.view.isFalseColor;
    if (pressed(GLFW_KEY_P)) bench_.view.probes = !bench_.view.probes;
    if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD)) bench_.view.exposureStops += 0.5f;
    if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT)) bench_.view.exposureStops -= 0.5f;
}

void Workbench::describe() {
    if (!map_.isOn()) return;
    const FrameResult& result = *bench_.result;
    const VariantResult& first = result.variants[0];
    map_.status("scene", bench_.document.scene);
    map_.status("rendered_scene", result.scene ? result.scene->name : "");
    map_.status("order", orderNumber_);
    map_.status("rendered_order", first.order);
    map_.status("frame", first.frame);
    map_.status("settled", first.isSettled && first.order == orderNumber_);
    map_.status("preview", first.isPreview);
    map_.status("error", first.error);
    map_.status("problem", result.problem);
    map_.status("busy", renderer_->progress().isBusy);
    map_.status(
        "time_s",
        result.scene ? result.document.edits.timeSeconds.value_or(result.scene->timeSeconds) : 0.0);
    map_.status("playing", bench_.isPlaying);
    map_.status("truth_photons", bench_.truth->photons);
    map_.status("judged_order", bench_.truth->judgements[0].order);
    map_.status("message", bench_.message);
    map_.status("device", result.device.renderer);
    map_.status("window_device", window_.renderer());
    map_.status("interface_ms", interfaceMs_);
    map_.status("document", toJson(bench_.document));
}

void Workbench::saveScreenshot() {
    if (!bench_.wantsScreenshot || screenshot_.valid()) return;
    bench_.wantsScreenshot = false;
    Image image;
    image.values = window_.readPixels(image.width, image.height);
    image.channels = 3;
    const fs::path file =
        fs::path(bench_.panels.recordFolder) /
        (recordingName(bench_.document.scene) + "-window" + displayImageExtension());
    // A large picture takes longer to compress than the window may be asleep.
    screenshot_ =
        std::async(std::launch::async, [file, picture = std::move(image)]() -> std::string {
            try {
                writeImage(file, picture);
                return {};
            } catch (const std::exception& error) {
                return error.what();
            }
        });
    bench_.say(fmt::format("Writing {}.", file.string()));
}

void Workbench::finishScreenshot() {
    if (!screenshot_.valid() ||
        screenshot_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return;
    }
    const std::string problem = screenshot_.get();
    if (!problem.empty()) {
        bench_.say(problem, true);
    } else if (bench_.message.starts_with("Writing ")) {
        bench_.say("Wrote " + bench_.message.substr(8));
    }
    framesToDraw_ = std::max(framesToDraw_, 2);
}

}  // namespace kaustik::gui
