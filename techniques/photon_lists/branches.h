// SPDX-License-Identifier: MIT
// Into how many photons an emitted one may part: how long lists become where both Fresnel branches
// are followed (specular.split), and whether a scene asks for that.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Why light on both Fresnel branches counts in a scene; "" where the refracted one is enough.
[[nodiscard]] std::string whyBothBranches(const scene::SceneNeeds& needs);

struct SplitParams {
    int levels = 3;
    template <class R>
    void reflect(R& r) {
        r.field(levels, "levels",
                "Both branches are followed until one emitted photon has become 2 to the power of "
                "this, which is also how much longer lists may be. Room is shared out as the light "
                "is, so that neighbours take the same paths; who has none left follows the "
                "stronger branch",
                "", params::range(0, 6))
            .when([](const FrameFacts& facts) -> std::string {
                const bool isAuto = facts.settings.choice(SpecularStage::name) == "auto";
                if (!isAuto || facts.needs == nullptr || !whyBothBranches(*facts.needs).empty())
                    return "";
                return "specular=auto follows one branch here";
            });
    }
};

// specular.split.levels where the frame's specular node follows both branches, else 0: a list has
// room for 2^levels photons of each that is emitted.
[[nodiscard]] int branchLevels(const FrameBuilder& frame);

}  // namespace kaustik
