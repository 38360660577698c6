// SPDX-License-Identifier: MIT
// specular.auto: what the scene needs of the other two. specular.split where there are bodies, each
// of whose faces reflects a share, outside and within, or where a sheet of water or glass sends
// light back to a receiver (scene/light_paths.h); else specular.interface. What that costs and
// brings: results/defaults.md.
#include <fmt/format.h>

#include <string>

#include "framework/pipeline/frame_builder.h"
#include "techniques/specular/interface.h"
#include "techniques/specular/split.h"

namespace kaustik {
namespace {

// Why both branches are followed; "" where one is enough.
Photons interactAuto(FrameBuilder& frame, const params::NoParams&, Hits hits, Surfaces surfaces) {
    const std::string reason = whyBothBranches(frame.needs());
    const bool isFirst = frame.runsOf(SpecularStage::name) == 1;
    if (!reason.empty()) {
        if (isFirst) frame.skip("specular.interface", reason + ": both branches are followed");
        return splitAtInterface(frame, frame.params<SplitParams>("specular.split"), hits, surfaces);
    }
    if (isFirst) {
        frame.skip("specular.split",
                   "no sheet reflects more than 1% of its light towards a receiver, and there are "
                   "no bodies; specular=split follows what is reflected all the same");
    }
    return interactAtInterface(frame, {}, hits, surfaces);
}

}  // namespace

void registerSpecularAuto(Registry& registry) {
    registry.node<SpecularStage>(
        "auto",
        {"Follows both Fresnel branches where there are bodies, or where water or a pane reflects "
         "light to a receiver, else the refracted one.",
         "",
         "It decides once for the whole scene, by its bodies and its sheets' reflectance. What it "
         "then leaves out is in the ledger as untraced_branch.",
         {"specular.split"}},
        &interactAuto);
}

}  // namespace kaustik
