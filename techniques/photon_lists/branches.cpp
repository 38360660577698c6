// SPDX-License-Identifier: MIT
#include "techniques/photon_lists/branches.h"

#include <fmt/format.h>

namespace kaustik {

std::string whyBothBranches(const scene::SceneNeeds& needs) {
    if (needs.reflectedLight) {
        return fmt::format("{:.0f}% of the light on '{}' is reflected, and '{}' lies in its path",
                           100.0 * needs.reflectedLight->share, needs.reflectedLight->sheet,
                           needs.reflectedLight->receiver);
    }
    if (needs.closedDielectrics)
        return "bodies reflect a share of their light at every face, outside and within";
    return "";
}

int branchLevels(const FrameBuilder& frame) {
    const std::string& node = frame.inputs().params.choice(SpecularStage::name);
    const bool splits =
        node == "split" || (node == "auto" && !whyBothBranches(frame.needs()).empty());
    return splits ? frame.params<SplitParams>("specular.split").levels : 0;
}

}  // namespace kaustik
