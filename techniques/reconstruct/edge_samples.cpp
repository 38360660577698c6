// SPDX-License-Identifier: MIT
// reconstruct.edges: the pixels in which a surface ends, and what is seen at four places of each.
// In: eye buffer; out: a receiver by place, view space, m and m².
#include "techniques/reconstruct/edge_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/gl/executor.h"
#include "framework/transport/edges.h"
#include "techniques/thread_lists/thread_list.h"
#include "techniques/tracing/bvh_rays.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/reconstruct/processor_edges.h"
#include "techniques/tracing/processor_scene.h"
#endif

namespace kaustik {
namespace {

// One of so many pixels may be at an edge.
constexpr int kPixelsPerEdge = 4;

struct EdgePass {
    EdgeSamples edges;
    ThreadList pixels;
    graph::Buffer<SeenAtPlace> seen;  // invalid where the device looks
};

// Looks at the places of pixels at an edge, on the device or the processor.
class PlacesFinder {
  public:
    PlacesFinder(FrameBuilder& frame, const Geometry& geometry) {
#ifdef KAUSTIK_HAS_EMBREE
        if (frame.inputs().isOnProcessor) {
            processor_ = processorScene(frame, geometry);
            return;
        }
#endif
        device_ = bvhOfFrame(frame, geometry);
    }
    void declare(graph::PassSetup& setup, EdgePass& pass, std::size_t capacity) const {
#ifdef KAUSTIK_HAS_EMBREE
        if (isTraced()) {
            processor_.read(setup);
            pass.seen = setup.createBuffer<SeenAtPlace>("edges.seen_at_places",
                                                        transport::kEdgeSamples * capacity);
            return;
        }
#endif
        static_cast<void>(pass);
        static_cast<void>(capacity);
        device_.read(setup);
    }
    // False: the device looks.
    [[nodiscard]] bool isTraced() const {
#ifdef KAUSTIK_HAS_EMBREE
        return processor_.scene != nullptr;
#else
        return false;
#endif
    }
    // For a command that looks at the pixels of the list.
    void bindTo(gl::Command& command, const EdgePass& pass, const FrameInputs& inputs,
                gl::PassContext& context) const {
        if (!pass.seen.valid()) return device_.bindTo(command, inputs);
        command.define("SEEN_BY_PROCESSOR").texels("seenAtPlaces", pass.seen, Format::rgba32f);
#ifdef KAUSTIK_HAS_EMBREE
        if (context.isListing()) return;
        const auto list = context.buffer(pass.pixels.buffer()).read<std::uint32_t>();
        const std::span<const std::uint32_t> pixels = ThreadList::listedIn(list);
        context.buffer(pass.seen).upload(seenAtPlaces(*processor_.scene, inputs.view, pixels));
#else
        static_cast<void>(context);
#endif
    }

  private:
    BvhOfFrame device_;
#ifdef KAUSTIK_HAS_EMBREE
    ProcessorScene processor_;
#endif
};

EdgeSamples makeEdgeSamples(FrameBuilder& frame, const Geometry& geometry,
                            const ReceiverView& eye) {
    const FrameBuilder::PassScope shared(frame);
    const PlacesFinder finder(frame, geometry);
    const int pixels = frame.width() * frame.height();
    constexpr int kPixelsOfRow = transport::kEdgePixelsOfRow;
    const int rows = std::max((pixels / kPixelsPerEdge + kPixelsOfRow - 1) / kPixelsOfRow, 1);
    const int capacity = rows * kPixelsOfRow;
    const EdgePass& made = frame.pass<EdgePass>(
        "reconstruct.edges",
        fmt::format("pixels see more than one surface where one ends; the {} looks there",
                    finder.isTraced() ? "processor" : "device"),
        [&](graph::PassSetup& setup, EdgePass& data) {
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            finder.declare(setup, data, static_cast<std::size_t>(capacity));
            data.edges.receiver = setup.image(
                "edgeReceiver",
                setup.create<EdgeReceiver>("edges.receiver", frame.width(), frame.height()));
            data.edges.samples = setup.image(
                "edgeSamples", setup.create<EdgeSample>(
                                   "edges.samples", kPixelsOfRow * transport::kEdgeSamples, rows));
            // Nothing stands in for these: reconstruct.triangles.coverage=middle goes without.
            data.pixels = ThreadList::create(setup, "EdgePixels", "edges.pixels",
                                             static_cast<std::size_t>(capacity));
        },
        [&inputs = frame.inputs(), finder, capacity](const EdgePass& pass,
                                                     gl::PassContext& context) {
            context.texture(pass.edges.samples).clear({0, 0, 0, 0});
            pass.pixels.clear(context);
            context.compute("reconstruct/edges_list.comp")
                .set("edgeCapacity", static_cast<unsigned>(capacity))
                .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
            gl::Command command = context.compute("reconstruct/edges.comp");
            finder.bindTo(command, pass, inputs, context);
            command.set("edgeCapacity", static_cast<unsigned>(capacity));
            pass.pixels.close(context);
            pass.pixels.dispatchOver(std::move(command));
        });
    frame.reportLimit(
        {"reconstruct.edges",
         {made.pixels.buffer()},
         [list = made.pixels.buffer(),
          capacity](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const std::uint32_t found = executor.buffer(list).read<std::uint32_t>().front();
             if (found <= static_cast<std::uint32_t>(capacity)) return {};
             return ReachedLimit{.parameter = "reconstruct.triangles.coverage",
                                 .unit = "pixels",
                                 .value = static_cast<double>(capacity),
                                 .needed = static_cast<double>(found),
                                 .sentence = "all show what is at their middles",
                                 .counted = "pixels see a surface end, too many to be kept",
                                 .count = found};
         }});
    return made.edges;
}

}  // namespace

EdgeSamples edgeSamplesOf(FrameBuilder& frame, const Geometry& geometry, const ReceiverView& eye) {
    return *frame.once<EdgeSamples>("reconstruct.edges", [&] {
        return std::make_shared<EdgeSamples>(makeEdgeSamples(frame, geometry, eye));
    });
}

}  // namespace kaustik
