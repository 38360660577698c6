// SPDX-License-Identifier: MIT
#include "framework/gui/workbench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"
#include "framework/run/progress.h"
#include "framework/scene/files/own_mesh.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kHistory = 200;
constexpr std::size_t kInterfaceFrameHistory = 1000;

}  // namespace

Workbench::Workbench(const Registry& registry, const WorkbenchOptions& options)
    : registry_(registry),
      folder_(settingsFolder()),
      settings_(readSettings(folder_, registry)),
      window_("Kaustik", settings_.kept.window,
              folder_.empty() ? fs::path() : folder_ / "imgui.ini"),
      map_(options.describe),
      renderer_(std::make_unique<RenderWorker>(registry, &Window::wake)),
      referenceWorker_(&Window::wake),
      studyWorker_(&Window::wake),
      thumbnailWorker_(&Window::wake),
      bench_{registry_,
             renderer_.get(),
             referenceWorker_,
             canvas_,
             map_,
             window_.scale(),
             settings_.document,
             settings_.kept.view,
             settings_.kept.panels,
             std::make_shared<const FrameResult>(),
             referenceWorker_.state(),
             scene::listScenes()} {
    if (!options.scene.empty() && options.scene != bench_.document.scene) {
        bench_.document.scene = options.scene;
        bench_.document.edits = {};
    }
    if (!settings_.problems.empty()) {
        const SettingsBackup aside = setSettingsAside(folder_, settings_.problems);
        canSave_ = aside.isDone;
        bench_.notify(aside.notice, true);
    }
    if (bench_.view.comparedWith == ComparedImage::other && !bench_.document.other)
        bench_.view.comparedWith = ComparedImage::none;
    bench_.studies = &studyWorker_;
    bench_.study = studyWorker_.state();
    bench_.thumbnails = &thumbnailWorker_;
    history_ = {bench_.document};
    rendererBegin_ = Clock::now();
    isUnattended_ = options.isUnattended;
    // A program holds a key as long as a frame takes, and means one stroke.
    if (isUnattended_) ImGui::GetIO().KeyRepeatDelay = 1e9f;
}

Workbench::~Workbench() {
    keep();
}

void Workbench::keep() {
    if (folder_.empty() || !canSave_) return;
    SavedState& kept = settings_.kept;
    kept.view = bench_.view;
    kept.panels = bench_.panels;
    kept.window = window_.placement();
    json all = toJson(kept);
    all["document"] = toJson(bench_.document);
    std::string text = all.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    if (text == savedText_) return;
    savedText_ = std::move(text);
    try {
        writeSettings(folder_, savedText_);
    } catch (const Error& error) {
        bench_.notify(error.what(), true);
    }
}

// A crash or a power cut loses two seconds at most.
void Workbench::saveRegularly() {
    if (Clock::now() - savedAt_ < std::chrono::seconds(2)) return;
    savedAt_ = Clock::now();
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
        // Dear ImGui needs a few frames to answer what it was told; who reads the description, some
        // after these to know that it has.
        if (hasInput) framesToDraw_ = map_.isOn() ? 8 : 3;
        if (run::isInterrupted()) window_.close();
        pollWorkers();
        takeDropped();
        bench_.dropOldMessage();
        bench_.isDragging = false;
        bench_.isTurning = false;
        map_.beginFrame();
        bench_.wantedThumbnails.clear();
        draw();
        thumbnailWorker_.want(bench_.wantedThumbnails);
        pushUndo();
        submitChanges();
        saveExperimentOnceRendered();
        aimReference();
        pollDifference();
        pollPairs();
        saveShown();
        describe();
        drawPixels();
        map_.endFrame();
        finishScreenshot();
        saveRegularly();
        interfaceMs_.push_back(
            std::chrono::duration<double, std::milli>(Clock::now() - frameBegin_).count());
        if (interfaceMs_.size() > kInterfaceFrameHistory) interfaceMs_.pop_front();
    }
    // The pass at hand may take seconds yet.
    keep();
    window_.hide();
    if (const auto study = studyWorker_.state();
        study->isRunning && !study->isEnding && !study->experiment.empty()) {
        fmt::print(stderr,
                   "The study ends with the window, after {} of {} runs; this does the rest:\n"
                   "{}\n",
                   study->finished(), study->runs.size(), resumeCommand(*study));
    }
}

void Workbench::drawPixels() {
    constexpr auto longestPause = std::chrono::milliseconds(250);
    const bool isAnotherToCome = framesToDraw_ > 0 && !bench_.wantsScreenshot;
    if (isUnattended_ && isAnotherToCome && Clock::now() - drawnAt_ < longestPause) {
        ImGui::EndFrame();
        return;
    }
    window_.drawFrame();
    saveScreenshot();
    window_.endFrame();
    drawnAt_ = Clock::now();
    drawnFrame_ = ImGui::GetFrameCount();
}

// How long the window may sleep, s: while the hand is at work not at all.
double Workbench::patience() const {
    if (framesToDraw_ > 0 || bench_.isPlaying) {
        if (isUnattended_) return 0.0;
        const double since = std::chrono::duration<double>(Clock::now() - frameBegin_).count();
        return std::max(1.0 / 60.0 - since, 0.0);
    }
    // Who reads the description waits for it.
    const bool isWatched = map_.isOn() || bench_.renderer->progress().isBusy ||
                           referenceWorker_.progress().isComputing;
    return isWatched ? 0.1 : 0.25;
}

// Results have the letters of the document: where A and B have just changed places, before the
// renderer knows.
std::shared_ptr<const FrameResult> Workbench::labelled(std::shared_ptr<const FrameResult> latest) {
    if (!latest || !areSwapped(latest->document, bench_.document)) return latest;
    if (relabelledOf_ == latest) return relabelled_;
    auto exchanged = std::make_shared<FrameResult>(*latest);
    std::swap(exchanged->variants[0], exchanged->variants[1]);
    std::swap(exchanged->document.variant, *exchanged->document.other);
    exchanged->probe.reset();  // of what was A
    relabelledOf_ = std::move(latest);
    relabelled_ = std::move(exchanged);
    return relabelled_;
}

void Workbench::pollWorkers() {
    if (bench_.wantsRestart) {
        bench_.wantsRestart = false;
        renderer_.reset();
        renderer_ = std::make_unique<RenderWorker>(registry_, &Window::wake);
        bench_.renderer = renderer_.get();
        bench_.result = std::make_shared<const FrameResult>();
        hasSubmitted_ = false;
        bench_.order = 0;
        bench_.pictureOrder = 0;
        judgedOrder_ = 0;
        bench_.notify("The renderer was started again.");
    }
    bool hasNews = false;
    if (const auto latest = labelled(renderer_->latest()); latest && latest != bench_.result) {
        hasNews = true;
        bench_.result = latest;
        framesToDraw_ = std::max(framesToDraw_, 2);
        dropAbsentPasses();
        for (std::size_t i = 0; i < bench_.histories.size(); ++i)
            bench_.histories[i].note(*latest, i);
        if (isRendered({latest->document, latest->order, bench_.view}, *latest))
            bench_.whole = latest->document;
        if (!settings_.kept.isDeviceKnown && !latest->device.renderer.empty()) {
            // What times mean on a software rasteriser is known without asking the user.
            bench_.panels.isPrecise = latest->device.isSoftware;
            settings_.kept.isDeviceKnown = true;
        }
    }
    bench_.referenceProgress = referenceWorker_.progress();
    if (const auto state = referenceWorker_.state(); state != bench_.reference) {
        hasNews = true;
        bench_.reference = state;
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    if (hasNews) notePoints();
    if (bench_.startSeconds == 0.0 && bench_.result->variants[0].frame > 0)
        bench_.startSeconds = std::chrono::duration<double>(Clock::now() - rendererBegin_).count();
    if (auto study = studyWorker_.state(); study != bench_.study) {
        bench_.study = std::move(study);
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    // The next step of an animation, once this one is seen.
    const VariantResult& first = bench_.result->variants[0];
    const std::uint64_t frame = first.frame + first.previews;
    if (bench_.isPlaying && bench_.isSceneCurrent() && frame != playedFrame_ &&
        first.order == bench_.order) {
        playedFrame_ = frame;
        bench_.document.edits.timeSeconds =
            bench_.timeSeconds() + double(bench_.panels.sequenceStep);
    }
}

// Once a setting is settled and judged it is a point among those of the session.
void Workbench::notePoints() {
    for (std::size_t i = 0; i < bench_.result->variants.size(); ++i) {
        std::optional<SettledPoint> point =
            settledPoint(*bench_.result, i, *bench_.reference, bench_.panels.isPrecise);
        if (point) addPoint(bench_.points, std::move(*point));
    }
}

// Those that were left out of what was rendered, because the settings have no such pass any more.
void Workbench::dropAbsentPasses() {
    const FrameResult& result = *bench_.result;
    if (result.order != bench_.order || !(result.document == bench_.document)) return;
    const Document before = bench_.document;
    std::set<std::string> dropped;
    for (std::size_t i = 0; i < result.variants.size(); ++i) {
        const VariantResult& rendered = result.variants[i];
        if (rendered.order != bench_.order || (i == 1 && !bench_.document.other)) continue;
        Variant& variant = i == 0 ? bench_.document.variant : *bench_.document.other;
        for (const std::string& name : rendered.absentPasses) {
            if (variant.disabled.erase(name) > 0) dropped.insert(name);
        }
    }
    if (dropped.empty()) return;
    // A part of the change that it comes from: else undo would lead to where it comes back.
    if (history_[historyPlace_] == before) history_[historyPlace_] = bench_.document;
    bench_.notify(fmt::format(
        "Forgot that {} off: with these settings there is no such pass.",
        joinNames({dropped.begin(), dropped.end()}) + (dropped.size() == 1 ? " is" : " are")));
}

// What cannot run is not saved, and whether it can is known once it has been rendered.
void Workbench::saveExperimentOnceRendered() {
    if (!bench_.wantsExperiment) return;
    bench_.isPlaying = false;
    if (isRendered(bench_.requested(), *bench_.result)) {
        bench_.wantsExperiment = false;
        saveExperiment(bench_);
        return;
    }
    const bool isKnown = bench_.result->order >= bench_.pictureOrder || bench_.result->isLost;
    const std::string reason = isKnown ? runObstacle(bench_.requested(), *bench_.result) : "";
    if (!reason.empty()) {
        bench_.wantsExperiment = false;
        bench_.notify("Not saved, for it would not run: " + reason, true);
    } else {
        bench_.notify("The experiment is saved once it has been rendered.", false,
                      [](const Bench& bench) { return !bench.wantsExperiment; });
    }
}

void Workbench::takeDropped() {
    const std::vector<std::string> dropped = window_.takeDropped();
    if (dropped.empty()) return;
    const std::string& file = dropped.front();
    if (!scene::isSceneFile(file)) {
        bench_.notify(fmt::format("'{}' is neither a scene (.toml, .gltf, .glb) nor a mesh (.obj, "
                                  ".ply, .stl, .3ds).",
                                  file),
                      true);
        return;
    }
    bench_.document.scene = file;
    bench_.document.edits = {};
    bench_.view.probePixel = glm::ivec2(-1);
    bench_.notify(scene::isMeshFile(file)
                      ? fmt::format("Opened {}, which stands on a table, as with --on table.", file)
                      : fmt::format("Opened {}.", file));
}

void Workbench::pushUndo() {
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

void Workbench::describe() {
    if (!map_.isOn()) return;
    const FrameResult& result = *bench_.result;
    const VariantResult& first = result.variants[0];
    map_.status("scene", bench_.document.scene);
    map_.status("rendered_scene", result.scene ? result.scene->name : "");
    map_.status("order", bench_.order);
    map_.status("rendered_order", first.order);
    map_.status("frame", first.frame);
    map_.status("settled", first.isSettled && first.order == bench_.order);
    map_.status("preview", first.isPreview);
    map_.status("error", first.error);
    map_.status("problem", result.problem);
    map_.status("busy", renderer_->progress().isBusy);
    map_.status(
        "time_s",
        result.scene ? result.document.edits.timeSeconds.value_or(result.scene->timeSeconds) : 0.0);
    map_.status("playing", bench_.isPlaying);
    map_.status("truth_photons", bench_.reference->photons);
    map_.status("judged_order", bench_.reference->judgements[0].order);
    map_.status("message", bench_.message);
    map_.status("device", result.device.renderer);
    map_.status("window_device", window_.renderer());
    map_.status("interface_ms", interfaceMs_);
    map_.status("drawn_frame", drawnFrame_);
    map_.status("strokes", window_.strokes());
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsMousePosValid(&mouse)) map_.status("mouse", std::array{mouse.x, mouse.y});
    map_.status("frame_ms", first.frameMs);
    map_.status("document", toJson(bench_.document));
}

}  // namespace kaustik::gui
