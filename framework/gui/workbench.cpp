// SPDX-License-Identifier: MIT
#include "framework/gui/workbench.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/recording_name.h"
#include "framework/gui/shown_files.h"
#include "framework/gui/shown_image.h"
#include "framework/gui/widgets.h"
#include "framework/run/progress.h"
#include "framework/scene/files/scene_file.h"

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
    if (!settings_.problems.empty()) {
        const SettingsBackup aside = setSettingsAside(folder_, settings_.problems);
        canSave_ = aside.isDone;
        bench_.notify(aside.notice, true);
    }
    if (!options.scene.empty() && options.scene != bench_.document.scene) {
        bench_.document.scene = options.scene;
        bench_.document.edits = {};
    }
    if (bench_.view.comparedWith == ComparedImage::other && !bench_.document.other)
        bench_.view.comparedWith = ComparedImage::none;
    history_ = {bench_.document};
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
        // Dear ImGui needs a few frames to answer what it was told.
        if (hasInput) framesToDraw_ = 3;
        if (run::isInterrupted()) window_.close();
        pollWorkers();
        takeDropped();
        bench_.isDragging = false;
        bench_.isTurning = false;
        map_.beginFrame();
        draw();
        pushUndo();
        submitChanges();
        saveExperimentOnceRendered();
        aimReference();
        pollDifference();
        pollPairs();
        saveShown();
        describe();
        window_.drawFrame();
        saveScreenshot();
        window_.endFrame();
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
}

// How long the window may sleep, s: while the hand is at work not at all.
double Workbench::patience() const {
    // Who reads the description waits for it.
    if (framesToDraw_ > 0 || bench_.isPlaying || map_.isOn()) {
        const double since = std::chrono::duration<double>(Clock::now() - frameBegin_).count();
        return std::max(1.0 / 60.0 - since, 0.0);
    }
    return bench_.renderer->progress().isBusy || referenceWorker_.progress().isComputing ? 0.1
                                                                                         : 0.25;
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
    if (const auto latest = labelled(renderer_->latest()); latest && latest != bench_.result) {
        bench_.result = latest;
        framesToDraw_ = std::max(framesToDraw_, 2);
        dropAbsentPasses();
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
        bench_.reference = state;
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
        bench_.notify("The experiment is saved once it has been rendered.");
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
    bench_.notify(fmt::format("Opened {}.", file));
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
    order.viewing.resource =
        bench_.view.comparedWith == ComparedImage::reference && bench_.view.resource.empty()
            ? "caustic.irradiance"
            : bench_.view.resource;
    order.viewing.layer = bench_.view.layer;
    order.viewing.readsOutputs =
        bench_.reference->photons > 0 || !(bench_.panels.isEndless || bench_.isPlaying);
    const double frameMs = settledMedianOf(bench_.result->variants[0].frameMs);
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
    const bool isSamePicture = hasSubmitted_ && submitted_.document == order.document &&
                               submitted_.viewing == order.viewing &&
                               submitted_.isPreview == order.isPreview &&
                               submitted_.sceneReloads == order.sceneReloads;
    if (isSamePicture && submitted_.frames == order.frames &&
        submitted_.isPrecise == order.isPrecise && submitted_.probe == order.probe) {
        return;
    }
    submitted_ = order;
    hasSubmitted_ = true;
    bench_.order = renderer_->submit(std::move(order));
    if (!isSamePicture) bench_.pictureOrder = bench_.order;
}

void Workbench::aimReference() {
    const FrameResult& result = *bench_.result;
    const VariantResult& first = result.variants[0];
    // Only of what has been rendered as it stands, and not of every step of a movement.
    if (bench_.isPlaying || bench_.isDragging || first.isPreview || first.frame == 0 ||
        first.order != bench_.order || !first.error.empty() || !result.problem.empty()) {
        return;
    }
    const ReferenceAim aim{result.document.scene, result.document.edits, result.document.size,
                           first.paths, submitted_.sceneReloads};
    referenceWorker_.aim(aim);
    // Frames of one order and the same shaders are the same: one is judged.
    const bool isNew = result.order != judgedOrder_ ||
                       bench_.reference->photons != judgedPhotons_ ||
                       result.shaderReloads != judgedReloads_;
    const VariantResult& second = result.variants[1];
    const bool hasBoth = !result.document.other || (second.outputs && second.order == bench_.order);
    if (bench_.reference->photons == 0 || !first.outputs || !hasBoth || !isNew ||
        bench_.reference->aim != aim) {
        return;
    }
    judgedOrder_ = result.order;
    judgedPhotons_ = bench_.reference->photons;
    judgedReloads_ = result.shaderReloads;
    referenceWorker_.judge(
        {JudgedFrame{result.order, first.outputs}, JudgedFrame{result.order, second.outputs}});
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
    map_.status("document", toJson(bench_.document));
}

namespace {

template <class T>
bool isReady(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

// Takes what is asked for off what is shown, on a thread of its own: FLIP takes long.
void Workbench::pollDifference() {
    if (isReady(difference_)) {
        bench_.difference = difference_.get();
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    if (bench_.view.comparedWith != ComparedImage::difference || difference_.valid()) return;
    const Showing showing = showingOf(bench_.requested(), *bench_.result, *bench_.reference);
    if (!showing.main || !showing.subtrahend) return;
    const std::uint64_t first = showing.main->version;
    const std::uint64_t second = showing.subtrahend->version;
    if (bench_.difference && bench_.difference->isOf(first, second)) return;
    // Values of frames live as long as the result, those of kept ones as long as their owner.
    difference_ = std::async(
        std::launch::async,
        [=, result = bench_.result, one = *showing.main,
         other = *showing.subtrahend]() -> std::shared_ptr<const ImageDifference> {
            auto difference =
                std::make_shared<ImageDifference>(differenceBetween(*one.values, *other.values));
            difference->firstVersion = first;
            difference->secondVersion = second;
            Window::wake();
            return difference;
        });
}

void Workbench::pollPairs() {
    if (isReady(pairs_)) {
        bench_.pairs = pairs_.get();
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    if (!bench_.wantsPairs || pairs_.valid()) return;
    bench_.wantsPairs = false;
    struct Named {
        std::string name;
        Image irradiance;
    };
    std::vector<Named> images;
    const auto add = [&](const std::string& name, const std::shared_ptr<const ViewedTexture>& of) {
        if (of) images.push_back({name, colorsOf(of->values)});
    };
    for (const auto& texture : bench_.result->variants[0].outputTextures) {
        if (texture->name == "caustic.irradiance") add("A", texture);
    }
    for (std::size_t i = 0; i < bench_.kept.size(); ++i)
        add(fmt::format("{}", i + 1), bench_.kept[i].texture("caustic.irradiance"));
    if (bench_.reference->irradiance && hasSameView(*bench_.reference, bench_.document))
        images.push_back({"reference", *bench_.reference->irradiance});
    pairs_ = std::async(
        std::launch::async, [images = std::move(images)]() -> std::shared_ptr<const Table> {
            auto table = std::make_shared<Table>();
            table->columns = {"image", "compared with", "RMSE, W/m²", "FLIP"};
            for (std::size_t i = 0; i < images.size(); ++i) {
                for (std::size_t k = i + 1; k < images.size(); ++k) {
                    const ImageDifference difference =
                        differenceBetween(images[i].irradiance, images[k].irradiance);
                    const bool isKnown = difference.signedMean != nullptr;
                    table->rows.push_back(
                        {images[i].name, images[k].name,
                         isKnown ? fmt::format("{:.4g}", difference.rmse) : difference.problem,
                         difference.flip ? fmt::format("{:.4g}", *difference.flip) : "–"});
                }
            }
            Window::wake();
            return table;
        });
}

// Both sides of the split, as they are on the screen.
void Workbench::saveShown() {
    if (!bench_.wantsShownSaved || screenshot_.valid()) return;
    bench_.wantsShownSaved = false;
    const Showing showing = showingOf(bench_.requested(), *bench_.result, *bench_.reference);
    if (!showing.main) {
        bench_.notify("There is no image to save.", true);
        return;
    }
    struct Saved {
        std::string name;
        Image values;
        Image seen;
        Metadata metadata;
    };
    std::vector<Saved> images;
    const auto add = [&](const ShownImage& image, std::size_t slot, const std::string& end) {
        std::string name =
            fmt::format("{}-{}{}", recordingName(bench_.document.scene), image.name(), end);
        Image seen;
        bench_.canvas.show(slot, *image.values, image.version, image.mapping);
        seen = bench_.canvas.read(slot);
        images.push_back(
            {std::move(name), *image.values, std::move(seen), image.metadata(bench_.document)});
    };
    add(*showing.main, 0, "");
    if (showing.compared) add(*showing.compared, 1, "-" + showing.compared->source);
    for (Saved& image : images) {
        for (char& c : image.name) {
            if (c == ' ' || c == '/') c = '_';
        }
    }
    const fs::path folder = bench_.panels.recordFolder;
    bench_.notify(fmt::format("Writing {}.",
                              (folder / images.front().name).string() + floatImageExtension()));
    screenshot_ =
        std::async(std::launch::async, [folder, images = std::move(images)]() -> std::string {
            try {
                for (const Saved& image : images) {
                    static_cast<void>(
                        writeShown(folder, image.name, image.values, image.seen, image.metadata));
                }
                return {};
            } catch (const std::exception& error) {
                return error.what();
            }
        });
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
    bench_.notify(fmt::format("Writing {}.", file.string()));
}

void Workbench::finishScreenshot() {
    if (!screenshot_.valid() ||
        screenshot_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return;
    }
    const std::string problem = screenshot_.get();
    if (!problem.empty()) {
        bench_.notify(problem, true);
    } else if (bench_.message.starts_with("Writing ")) {
        bench_.notify("Wrote " + bench_.message.substr(8));
    }
    framesToDraw_ = std::max(framesToDraw_, 2);
}

}  // namespace kaustik::gui
