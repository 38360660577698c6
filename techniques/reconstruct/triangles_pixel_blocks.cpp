// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/triangles_pixel_blocks.h"

#include <string>

namespace kaustik {

// As the shaders have it.
struct PixelBlock {
    glm::vec4 receiver;
    std::uint32_t sums[6], unused[2];
};

namespace {

constexpr int kBlockSide = 4;  // px

int pixelBlockCount(const Views& views) {
    const auto along = [](int pixels) { return (pixels + kBlockSide - 1) / kBlockSide; };
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
    for (FluxMap& own : map.maps) {
        if (!own.pixelBlocks.valid()) continue;
        own = frame.pass<FluxMap>(
            "reconstruct.pixel_blocks", "what squares of pixels have of wide beams goes to pixels",
            [&](graph::PassSetup& setup, FluxMap& data) {
                data = own;
                setup.sample("receiver", own.on.receiver);
                setup.storage("PixelBlocks", own.pixelBlocks);
                data.pixelBlocks = {};
                data.flux = setup.image("fluxSums", setup.write(own.flux));
            },
            [views = own.on.views](const FluxMap&, gl::PassContext& context) {
                gl::Command command =
                    context.compute("reconstruct/triangles_pixel_blocks_share.comp");
                views->bindTo(command);
                command.dispatchOver(pixelBlockCount(views), 64);
            });
    }
    return map;
}

}  // namespace kaustik
