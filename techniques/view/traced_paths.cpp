// SPDX-License-Identifier: MIT
#include "techniques/view/traced_paths.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/view/processor_paths.h"
#endif

namespace kaustik {

#ifndef KAUSTIK_HAS_EMBREE
class TracesPaths {
  public:
    void read(graph::PassSetup& /*setup*/) const {}
};
#endif

namespace {

// Followed together: what they come to is held by buffers of this size.
constexpr std::size_t kPixelsTogether = 32768;

}  // namespace

PathsFinder::PathsFinder(FrameBuilder& frame, const BvhViewParams& params, const Geometry& geometry)
    : endsOfPixel_(1 << params.branches), lights_(frame.needs().lights) {
    if (!isProcessorAsked(frame, params.rays, "view.bvh.rays")) return;
#ifdef KAUSTIK_HAS_EMBREE
    traces_ = std::make_shared<TracesPaths>(processorScene(frame, geometry), params, lights_);
#else
    static_cast<void>(geometry);
#endif
}

TracedPaths PathsFinder::create(graph::PassSetup& setup, const EyeBuffer& eye) const {
    if (!isTraced()) return {};
    traces_->read(setup);
    const std::size_t ends = kPixelsTogether * static_cast<std::size_t>(endsOfPixel_);
    const std::size_t lit = ends * static_cast<std::size_t>(std::max(litWords(), 1));
    TracedPaths paths{eye.receiver, setup.createBuffer<PathsOfPixel>("view.paths", kPixelsTogether),
                      setup.createBuffer<PathEnd>("view.path_ends", ends),
                      setup.createBuffer<std::uint32_t>("view.lit_ends", lit)};
    for (const graph::ResourceRef& made :
         std::initializer_list<graph::ResourceRef>{paths.pixels, paths.ends, paths.lit}) {
        setup.bypass(made, {0, 0, 0, 0});
    }
    return paths;
}

void PathsFinder::find(const FrameInputs& inputs, gl::PassContext& context,
                       const TracedPaths& paths, const ThreadList& listed, const glm::vec2& offset,
                       const std::function<gl::Command()>& shader) const {
    const auto draw = [&](std::size_t first, std::size_t count) {
        shader()
            .texels("pathsOfPixels", paths.pixels, Format::rgba32f)
            .texels("pathEnds", paths.ends, Format::rgba32f)
            .texels("litEnds", paths.lit, Format::r32ui)
            .set("litWords", litWords())
            .set("firstPixel", static_cast<unsigned>(first))
            .set("pixelCount", static_cast<unsigned>(count))
            .dispatchOver(static_cast<int>(count), 64);
    };
    if (context.isListing()) return draw(0, 1);
#ifdef KAUSTIK_HAS_EMBREE
    const std::vector<std::uint32_t> list = context.buffer(listed.buffer()).read<std::uint32_t>();
    const std::span<const std::uint32_t> pixels = ThreadList::listedIn(list);
    const std::vector<glm::vec4> receivers =
        context.texture(paths.receivers).readRows(inputs.view.height);
    for (std::size_t first = 0; first < pixels.size(); first += kPixelsTogether) {
        const auto part = pixels.subspan(first, std::min(pixels.size() - first, kPixelsTogether));
        const FoundPaths found = traces_->find(inputs.view, {part, offset, receivers});
        context.buffer(paths.pixels).upload(found.pixels);
        context.buffer(paths.ends).upload(found.ends);
        context.buffer(paths.lit).upload(found.lit);
        draw(first, part.size());
    }
#else
    static_cast<void>(inputs);
    static_cast<void>(listed);
    static_cast<void>(offset);
#endif
}

}  // namespace kaustik
