// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/processor_triangles.h"

#include <algorithm>

#include "framework/gl/executor.h"
#include "techniques/thread_lists/thread_list.h"

namespace kaustik {
namespace {

void add(transport::LedgerEntry& entry, const LedgerSum& sum) {
    const std::uint64_t before = static_cast<std::uint64_t>(entry.high) << 32u | entry.low;
    const std::uint64_t after = before + sum.units;
    entry.low = static_cast<std::uint32_t>(after);
    entry.high = static_cast<std::uint32_t>(after >> 32u);
    entry.events += sum.events;
}

}  // namespace

void clearPixels(ProcessorPixels& pixels, const render::RasterView& eye, const Store& store,
                 const EdgeSamples& edges, const graph::Buffer<PixelBlock>& blocks,
                 const gl::PassContext& context) {
    const auto read = [&](const auto& texture) {
        const gl::Texture& from = context.texture(texture);
        return from.readRows(from.desc().height);
    };
    SeenPixels::Textures textures;
    textures.receiver = edges.valid() ? read(edges.receiver) : read(store.receivers.receiver);
    textures.surface = read(store.receivers.receiverSurface);
    if (edges.valid()) textures.samples = read(edges.samples);
    pixels.blocks = context.buffer(blocks).read<PixelBlock>();
    pixels.sums.assign(3 * textures.receiver.size(), 0);
    pixels.seen.look(eye, textures, pixels.blocks);
}

void coverOnProcessor(ProcessorPixels& pixels, const ListedPatches& listed, TriangleShading shading,
                      const FrameInputs& inputs, const Ledger& ledger,
                      const gl::PassContext& context) {
    if (context.isListing()) {
        for (std::size_t kind = 0; kind < listed.kinds; ++kind)
            listed.make(kind, 0);
        return;
    }
    std::vector<std::int64_t> begins = {0};  // of the kinds, and where the last one ends
    for (const ThreadListHeader& list :
         context.buffer(listed.lists).readFirst<ThreadListHeader>(listed.kinds)) {
        // What a lost device says is anything.
        begins.push_back(begins.back() +
                         static_cast<std::int64_t>(std::min<std::size_t>(list.count, listed.most)));
    }
    const auto room = static_cast<std::int64_t>(listed.room);
    LedgerSums all{};
    for (std::int64_t first = 0; first < begins.back(); first += room) {
        const std::int64_t end = std::min(first + room, begins.back());
        for (std::size_t kind = 0; kind < listed.kinds; ++kind) {
            if (std::max(begins[kind], first) < std::min(begins[kind + 1], end))
                listed.make(kind, static_cast<int>(begins[kind] - first));
        }
        const auto patches =
            context.buffer(listed.made)
                .readFirst<transport::PatchData>(static_cast<std::size_t>(end - first));
        coverPatches(patches, pixels.seen, shading,
                     {pixels.sums, pixels.blocks, 1.0f / inputs.ledgerQuantumWatts},
                     inputs.hasLedger ? &all : nullptr);
    }
    if (begins.back() == 0 || !inputs.hasLedger) return;
    const gl::Buffer& buffer = context.buffer(ledger);
    auto entries = buffer.read<transport::LedgerEntry>();
    for (std::size_t account = 0; account < all.size(); ++account)
        add(entries[account], all[account]);
    buffer.upload(entries);
}

}  // namespace kaustik
