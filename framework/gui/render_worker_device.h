// SPDX-License-Identifier: MIT
// What the render worker's thread owns: the context, the scene, and how far the order at hand is.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "framework/gui/file_watch.h"
#include "framework/gui/render_worker.h"
#include "framework/gui/variant_renderer.h"

namespace kaustik::gui {

struct RenderWorker::Device {
    Device(std::unique_ptr<gl::Context> c, const Registry& registry);

    std::unique_ptr<gl::Context> context;
    FileWatch shaders;
    std::string sceneName;
    int sceneReloads = 0;
    std::unique_ptr<scene::Scene> base;  // as its file says
    std::unique_ptr<scene::Scene> scene;
    std::optional<scene::SceneShapes> shapes;
    std::optional<scene::SceneEdits> edits;  // that the scene has
    std::array<std::unique_ptr<VariantRenderer>, 2> renderers;

    // The number of the newest texture that was read back. Numbers start at a time, so that no
    // device of this program repeats those of another.
    std::uint64_t versions = static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
    FrameOrder order;
    std::uint64_t number = 0;
    int framesDone = 0;
    bool hasExtras = false;
    // Frames and the like that the order has had rendered, and those that it takes in all; 0 before
    // they are counted.
    int rendered = 0;
    int toRender = 0;

    // Begins to count for the order at hand.
    void countFrames() {
        const auto count = static_cast<int>(variants());
        int previews = 0;
        for (int i = 0; i < count; ++i)
            previews += hasPicture(static_cast<std::size_t>(i)) ? 0 : 1;
        const int extras = count + (order.probe ? 1 : 0);
        rendered = framesDone * count;
        toRender = order.isPreview ? count : previews + order.frames * count + extras;
    }
    [[nodiscard]] bool hasPicture(std::size_t variant) const {
        return renderers[variant] && renderers[variant]->result().viewed;
    }
    // Whether what a newer order of the same frame wants to see is there without rendering.
    [[nodiscard]] bool canLook(const FrameOrder& newer, const FrameResult& result) const {
        if (!hasExtras || order.isPreview || order.frames == 0 || newer.frames == 0) return false;
        if (newer.isPrecise != order.isPrecise || newer.probe != order.probe) return false;
        for (std::size_t i = 0; i < variants(); ++i) {
            if (!renderers[i] || !result.variants[i].isSettled) return false;
            if (!renderers[i]->canLook(newer.viewing)) return false;
        }
        return true;
    }
    [[nodiscard]] std::size_t variants() const { return order.document.other ? 2 : 1; }
    [[nodiscard]] const Variant& variant(std::size_t i) const {
        return i == 0 ? order.document.variant : *order.document.other;
    }
};

}  // namespace kaustik::gui
