// SPDX-License-Identifier: MIT
// Maps that a great many photons add to, summed up batch by batch with compensation (hard case 34):
// a plain 32-bit sum drifts, and 2^25 deposits of 0.1 are 15 % off.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// A plain sum of so many equal deposits is off by 1.5e-4 of its last ones at most, 6e-5 on the
// whole.
inline constexpr int kBatchPhotons = 4096;

// What a map is summed up with, where there is more than one batch.
template <class Texel>
struct BatchSum {
    graph::Texture<Texel> batch;
    graph::Texture<Texel> carry;  // what the sum so far is too large by
};
template <class Texel>
BatchSum<Texel> createBatchSum(graph::PassSetup& setup, const FrameBuilder& frame,
                               const std::string& stage, const std::string& name) {
    BatchSum<Texel> parts{
        setup.create<Texel>(stage + ".batch_" + name, frame.width(), frame.height()),
        setup.create<Texel>(stage + ".carry_" + name, frame.width(), frame.height())};
    setup.bypass(parts.batch, {0, 0, 0, 0});
    setup.bypass(parts.carry, {0, 0, 0, 0});
    return parts;
}
template <class Texel>
void clear(gl::PassContext& context, const BatchSum<Texel>& parts) {
    if (!parts.batch.valid()) return;
    context.texture(parts.batch).clear({0, 0, 0, 0});
    context.texture(parts.carry).clear({0, 0, 0, 0});
}
// Adds the batch to the sum and empties it.
template <class Texel>
void addBatch(gl::PassContext& context, const FrameInputs& inputs, const graph::Texture<Texel>& sum,
              const BatchSum<Texel>& parts) {
    context.compute("screen_space_photons/sum_batch.comp")
        .image("batchMap", parts.batch)
        .image("carryMap", parts.carry)
        .image("sumMap", sum)
        .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
}

}  // namespace kaustik
