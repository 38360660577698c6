// SPDX-License-Identifier: MIT
// specular.split, for who chooses between it and another node.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Why light on both Fresnel branches counts in a scene; "" where the refracted one is enough.
[[nodiscard]] std::string whyBothBranches(const scene::SceneNeeds& needs);

struct SplitParams {
    int levels = 1;
    template <class R>
    void reflect(R& r) {
        r.field(levels, "levels",
                "Interactions at which both branches are followed, which doubles the transfer map; "
                "at later ones each photon takes one of them, drawn by its share",
                "", params::range(0, 6))
            .when([](const FrameFacts& facts) -> std::string {
                const bool isAuto = facts.settings.choice(SpecularStage::name) == "auto";
                if (!isAuto || facts.needs == nullptr || !whyBothBranches(*facts.needs).empty())
                    return "";
                return "specular=auto follows one branch here";
            });
    }
};

Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits,
                         Surfaces surfaces);

}  // namespace kaustik
