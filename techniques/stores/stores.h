// SPDX-License-Identifier: MIT
// The stores into which reconstructions put light (reconstruct.space): one code for the screen, a
// light's map and the faces of a cube around a light or a caustic generator.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct Store {
    ReceiverView receivers;
    int light = -1;                          // whose photons alone it takes; -1: all
    std::string suffix;                      // of its resources
    int generator = -1;                      // what they must have left last; -1: anything
    const gl::Buffer* generators = nullptr;  // by which it is told; where there is one
    // The number of the map among those of its light (reconstruct.map_cascades). Those after the
    // first hold again what that holds, and nothing of them is in the ledger.
    int cascade = 0;
    [[nodiscard]] bool isEyeView() const { return receivers.views->isEyeView(); }
};

// The eye's receivers, or those that each light or each caustic generator sees.
[[nodiscard]] std::vector<Store> storesOf(FrameBuilder& frame, const Surfaces& surfaces);

// What a store holds after a pass, and the account of what it has not taken.
struct Stored {
    FluxMap map;
    Ledger ledger;
    bool isFirst = false;  // the map is new
};
// Adds what these hits bring to every store in turn. `deposit`: adds it to one, whose map before is
// invalid where this is the first to come.
using Deposit = std::function<Stored(const Store&, const Hits&, const FluxMap& before)>;
[[nodiscard]] CausticMap storeEverywhere(FrameBuilder& frame, const Surfaces& surfaces, Hits hits,
                                         const CausticMap& before, const Deposit& deposit);

// What a map of this layout holds there: more where a receiver of the scene is glossy.
[[nodiscard]] FluxSets setsIn(const FrameBuilder& frame, const Store& store,
                              SetLayout layout = SetLayout::one);

// Declares what a pass does that deposits: "fluxSums" and "LedgerEntries", what it reads of the
// hits and of their photons, and "receiver" and "receiverSurface" of the store.
[[nodiscard]] Stored depositIn(graph::PassSetup& setup, const Store& store, const Hits& hits,
                               const FluxMap& before, const FluxSets& sets);
// The first thing that such a pass does: a new map is empty.
void clearIfFirst(gl::PassContext& context, const Stored& stored);
// Makes the shaders of its command see the store's views and take its light, or what comes from its
// generator (include/photons/arriving.glsl); of those that include include/maps/deposit.glsl the
// second.
gl::Command& bindStore(gl::Command& command, const Store& store);
void setDeposit(gl::Command& command, const FluxSets& sets);

}  // namespace kaustik
