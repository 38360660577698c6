// SPDX-License-Identifier: MIT
// What the workbench orders: frames of what is worked on, quick ones while the view is turned, and
// the reference that they are judged by.
#include <imgui.h>

#include "framework/gui/medians.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {
namespace {

// A frame that takes longer is replaced by a quick one while the view is being turned.
constexpr double kSlowFrameMs = 150.0;
// Frames after a change, for a median; fewer where one takes long.
constexpr int kFramesUntilSettled = 8;
constexpr int kSlowFramesUntilSettled = 3;

}  // namespace

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
    order.viewing.pass = bench_.view.pass;
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
                               submitted_.viewing.wantsSameFrame(order.viewing) &&
                               submitted_.isPreview == order.isPreview &&
                               submitted_.sceneReloads == order.sceneReloads;
    if (isSamePicture && submitted_.frames == order.frames &&
        submitted_.isPrecise == order.isPrecise && submitted_.probe == order.probe &&
        submitted_.viewing == order.viewing) {
        return;
    }
    // Thumbnails are not worth ending a frame for.
    if (isSamePicture) order.isPassing = order.isPassing || submitted_.viewing != order.viewing;
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
    if (referenceWorker_.aim(aim)) {
        bench_.notify(
            "The reference that was being computed is of another view, or of other modelled paths; "
            "computing it has ended.",
            true);
    }
    // Frames of one order and the same shaders are the same: one is judged.
    const bool isNew = result.order != judgedOrder_ ||
                       bench_.reference->allPhotons != judgedPhotons_ ||
                       result.shaderReloads != judgedReloads_;
    const VariantResult& second = result.variants[1];
    const bool hasBoth = !result.document.other || (second.outputs && second.order == bench_.order);
    if (bench_.reference->photons == 0 || !first.outputs || !hasBoth || !isNew ||
        bench_.reference->aim != aim) {
        return;
    }
    judgedOrder_ = result.order;
    judgedPhotons_ = bench_.reference->allPhotons;
    judgedReloads_ = result.shaderReloads;
    referenceWorker_.judge(
        {JudgedFrame{result.order, first.outputs}, JudgedFrame{result.order, second.outputs}});
}

}  // namespace kaustik::gui
