// SPDX-License-Identifier: MIT
// What patches of reconstruct.triangles cover of the eye's pixels, found by the processor on all
// cores: the same as shaders/reconstruct/triangles_cover.glsl and what it includes, where the names
// here come from and their reasons stand; there in builds with Embree alone. A thread of its own
// leaves a pixel that a patch does not reach at once, where a software rasteriser's eight go on
// together.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "framework/transport/patches.h"
#include "framework/transport/primitives.h"
#include "techniques/reconstruct/pixel_block.h"
#include "techniques/reconstruct/processor_pixels.h"
#include "techniques/reconstruct/triangles.h"

namespace kaustik {

// Where the flux goes: three sums of units a pixel, row by row, and those of squares.
struct PatchSums {
    std::span<std::uint64_t> pixels;
    std::span<PixelBlock> blocks;
    float unitsPerWatt;
};

// An account of the ledger, in its units.
struct LedgerSum {
    std::uint64_t units = 0;
    std::uint32_t events = 0;
};
using LedgerSums = std::array<LedgerSum, transport::kLedgerEntryCount>;

// Adds what the patches bring, to the ledger too, unless that is null. All sums are of whole
// numbers: the same to the bit whichever thread comes first.
void coverPatches(std::span<const transport::PatchData> patches, const SeenPixels& pixels,
                  TriangleShading shading, const PatchSums& sums, LedgerSums* ledger);

}  // namespace kaustik
