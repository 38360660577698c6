// SPDX-License-Identifier: MIT
// What every panel of the workbench has at hand: the document that it edits, what is shown, what
// the threads have found, and the means to ask them for more. A panel is a function `void
// drawX(Bench&)` in panels/; it changes the document, and the workbench submits it.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/gui/canvas.h"
#include "framework/gui/document.h"
#include "framework/gui/frame_result.h"
#include "framework/gui/kept_variant.h"
#include "framework/gui/reference_worker.h"
#include "framework/gui/render_worker.h"
#include "framework/gui/screen_map.h"
#include "framework/gui/settled_points.h"
#include "framework/gui/shown.h"
#include "framework/gui/state.h"
#include "framework/gui/study_worker.h"
#include "framework/gui/thumbnails.h"
#include "framework/gui/time_history.h"
#include "framework/gui/variant_parameters.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {

// How long good news stands in the place of what is said of the picture.
inline constexpr std::chrono::seconds kGoodMessageTime{15};

struct Bench {
    const Registry& registry;
    RenderWorker* renderer;  // another one after the device was lost
    ReferenceWorker& referenceWorker;
    Canvas& canvas;
    ScreenMap& map;
    float scale;  // of the interface

    Document document;
    ViewState view;
    PanelState panels;

    // The newest of both threads; never null.
    std::shared_ptr<const FrameResult> result;
    std::shared_ptr<const ReferenceState> reference;
    std::vector<scene::SceneListing> scenes;
    // Asked for before `reference`: once nothing is computed, `reference` has what was.
    ReferenceWorker::Progress referenceProgress{};

    // The newest order, the one that first asked for the same picture, and the last document that
    // was rendered without an error.
    std::uint64_t order = 0;
    std::uint64_t pictureOrder = 0;
    std::optional<Document> whole{};

    // The newest difference that was asked for (Workbench::pollDifference), null before.
    std::vector<KeptVariant> kept{};
    std::shared_ptr<const ImageDifference> difference{};
    std::uint64_t keptCount = 0;
    // What was rendered in this session: times of A and B, and settings with their errors.
    std::array<TimeHistory, 2> histories{};
    VariantParametersCache parameters{};
    std::vector<SettledPoint> points{};
    // RMSE and FLIP of all pairs of caustic irradiances, once they are asked for.
    std::shared_ptr<const Table> pairs{};
    bool wantsPairs = false;
    // From the start of the renderer to its first whole picture; 0 before.
    double startSeconds = 0.0;
    // The newest study, never null once the workbench runs, and who does it.
    StudyWorker* studies = nullptr;
    std::shared_ptr<const StudyState> study{};
    // Who makes small pictures, and those that are looked at in this frame.
    ThumbnailWorker* thumbnails = nullptr;
    std::vector<ThumbnailSubject> wantedThumbnails{};
    bool wantsShownSaved = false;

    // Of the picture as it is drawn in this frame; "" where the mouse is on none of its pixels.
    std::string valueUnderMouse{};
    // One line for the status bar, until what it speaks of is gone.
    std::string message{};
    bool isMessageBad = false;
    std::function<bool(const Bench&)> isMessageOver{};

    bool isPlaying = false;
    // A value is being dragged; the camera, a light or the time by hand.
    bool isDragging = false;
    bool isTurning = false;
    // How long keys for flying were held in this frame, s: to the right, up, forward.
    glm::dvec3 flight{0.0};
    int sceneReloads = 0;
    bool wantsScreenshot = false;
    bool wantsExperiment = false;  // once the document is known to run
    bool wantsRestart = false;     // of the renderer
    bool showsHelp = false;

    // `isOver` says when it no longer holds; by default once the user has gone on and changed the
    // document, or after a while where nothing is wrong.
    void notify(std::string text, bool isBad = false,
                std::function<bool(const Bench&)> isOver = {}) {
        message = std::move(text);
        isMessageBad = isBad;
        isMessageOver = std::move(isOver);
        if (isMessageOver) return;
        isMessageOver = [said = withoutTime(document), isBad,
                         begin = std::chrono::steady_clock::now()](const Bench& bench) {
            const auto age = std::chrono::steady_clock::now() - begin;
            return !(withoutTime(bench.document) == said) || (!isBad && age > kGoodMessageTime);
        };
    }
    // Of a number that was typed: it is said for a while.
    void notifyTyped(std::string text) {
        notify(std::move(text), true, [begin = std::chrono::steady_clock::now()](const Bench&) {
            return std::chrono::steady_clock::now() - begin > kGoodMessageTime;
        });
    }
    // That something could not be written: of no interest once another folder is chosen.
    void notifyUnwritten(std::string text) {
        notify(std::move(text), true,
               [said = withoutTime(document), folder = panels.recordFolder](const Bench& bench) {
                   return !(withoutTime(bench.document) == said) ||
                          bench.panels.recordFolder != folder;
               });
    }
    void dropOldMessage() {
        if (!message.empty() && isMessageOver && isMessageOver(*this)) message.clear();
    }
    // Time passes by itself.
    [[nodiscard]] static Document withoutTime(Document document) {
        document.edits.timeSeconds.reset();
        return document;
    }
    // The variant that the panels edit, and what was rendered of it.
    [[nodiscard]] std::size_t editedIndex() const {
        return panels.edited == 1 && document.other ? 1 : 0;
    }
    [[nodiscard]] Variant& edited() {
        return editedIndex() == 1 ? *document.other : document.variant;
    }
    [[nodiscard]] const Variant& variantOf(std::size_t index) const {
        return index == 1 && document.other ? *document.other : document.variant;
    }
    [[nodiscard]] const VariantResult& editedResult() const {
        return result->variants[editedIndex()];
    }
    // Throws ConfigError where a setting is none of its technique's.
    [[nodiscard]] std::shared_ptr<const VariantParameters> editedParameters() {
        return parameters.of(document, editedIndex(), result, registry);
    }
    [[nodiscard]] ShownRequest requested() const {
        return {document, pictureOrder, view, editedIndex(), &kept, difference};
    }
    // Of the image left of the split; null before there is one.
    [[nodiscard]] Look* shownLook() {
        const auto& viewed = result->variants[requested().seen()].viewed;
        return viewed ? &view.looks[viewed->name] : nullptr;
    }
    // The camera as the document has it, which may be newer than what was rendered; so is the time.
    [[nodiscard]] scene::Camera camera() const {
        if (document.edits.camera) return *document.edits.camera;
        return result->scene ? result->scene->camera : scene::Camera();
    }
    [[nodiscard]] double timeSeconds() const {
        return document.edits.timeSeconds.value_or(result->scene ? result->scene->timeSeconds
                                                                 : 0.0);
    }
    [[nodiscard]] bool isSceneCurrent() const {
        return result->scene && result->document.scene == document.scene;
    }
    [[nodiscard]] double px(double atScale1) const { return atScale1 * double(scale); }
};

}  // namespace kaustik::gui
