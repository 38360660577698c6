// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/triangles_pixel_blocks.h"

#include <memory>
#include <string>

#include "framework/gl/executor.h"
#include "techniques/reconstruct/pixel_block.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/reconstruct/processor_triangles.h"
#endif

namespace kaustik {

namespace {

int pixelBlockCount(const Views& views) {
    const auto along = [](int pixels) {
        return (pixels + transport::kPixelBlockSide - 1) / transport::kPixelBlockSide;
    };
    return along(views->width()) * along(views->height());
}

}  // namespace

graph::Buffer<PixelBlock> putIntoPixelBlocks(graph::PassSetup& setup, const Store& store,
                                             const FluxMap& before) {
    graph::Buffer<PixelBlock> blocks;
    if (before.pixelBlocks.valid()) {
        blocks = setup.write(before.pixelBlocks);
        setup.bypass(blocks, before.pixelBlocks);
    } else {
        blocks = setup.createBuffer<PixelBlock>(
            "caustic.pixel_blocks" + store.suffix,
            static_cast<std::size_t>(pixelBlockCount(store.receivers.views)));
        setup.bypass(blocks, {0, 0, 0, 0});
    }
    return setup.storage("PixelBlocks", blocks);
}

void makePixelBlocks(gl::Command command, const Store& store) {
    command.dispatchOver(pixelBlockCount(store.receivers.views), 64);
}

CausticMap shareOutPixelBlocks(FrameBuilder& frame, CausticMap map) {
    struct Data {
        FluxMap map;
        graph::Buffer<PixelBlock> blocks;
        graph::Buffer<std::uint32_t> sums;  // where the processor has some
    };
    for (FluxMap& own : map.maps) {
        if (!own.pixelBlocks.valid()) continue;
        const auto pixels = static_cast<std::size_t>(own.on.views->width()) *
                            static_cast<std::size_t>(own.on.views->height());
        own = frame
                  .pass<Data>(
                      "reconstruct.pixel_blocks",
                      "what squares of pixels have of wide beams goes to pixels",
                      [&](graph::PassSetup& setup, Data& data) {
                          data.map = own;
                          data.map.pixelBlocks = {};
                          data.map.byProcessor = nullptr;
                          const bool isByProcessor = own.byProcessor != nullptr;
                          setup.sample("receiver", own.on.receiver);
                          data.blocks = setup.storage(
                              "PixelBlocks",
                              isByProcessor ? setup.write(own.pixelBlocks) : own.pixelBlocks);
                          data.map.flux = setup.image("fluxSums", setup.write(own.flux));
                          if (isByProcessor) {
                              data.sums =
                                  setup.storage("PixelSums", setup.createBuffer<std::uint32_t>(
                                                                 "caustic.pixel_sums", 6 * pixels));
                          }
                      },
                      [views = own.on.views, processor = own.byProcessor, pixels](
                          const Data& data, gl::PassContext& context) {
                          const auto shader = [&](const char* name) {
                              gl::Command command = context.compute(name);
                              views->bindTo(command);
                              return command;
                          };
#ifdef KAUSTIK_HAS_EMBREE
                          if (processor) {
                              if (!context.isListing()) {
                                  context.buffer(data.blocks).upload(processor->blocks);
                                  // There are none where the pass that makes them is off.
                                  if (processor->sums.empty()) {
                                      context.buffer(data.sums).clear();
                                  } else {
                                      context.buffer(data.sums).upload(processor->sums);
                                  }
                              }
                              shader("reconstruct/triangles_pixel_sums.comp")
                                  .dispatchOver(static_cast<int>(pixels), 64);
                          }
#else
                          static_cast<void>(data), static_cast<void>(processor),
                              static_cast<void>(pixels);
#endif
                          shader("reconstruct/triangles_pixel_blocks_share.comp")
                              .dispatchOver(pixelBlockCount(views), 64);
                      })
                  .map;
    }
    return map;
}

}  // namespace kaustik
