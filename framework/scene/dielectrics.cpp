// SPDX-License-Identifier: MIT
#include "framework/scene/dielectrics.h"

#include <algorithm>

#include "framework/transport/media_stack.h"

namespace kaustik::scene {

using namespace transport;

Dielectrics numberDielectrics(const Scene& scene) {
    Dielectrics dielectrics;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const bool isDielectric = scene.materials[i].kind == MaterialKind::dielectric;
        if (isDielectric) dielectrics.materialOf.push_back(static_cast<std::uint32_t>(i));
        dielectrics.numberOf.push_back(
            isDielectric ? static_cast<std::uint32_t>(dielectrics.materialOf.size()) : 0);
    }
    dielectrics.base =
        std::max<std::uint32_t>(static_cast<std::uint32_t>(dielectrics.materialOf.size()) + 1, 2);
    dielectrics.end = dielectrics.base;
    while (dielectrics.end <= kMediaRoom / dielectrics.base) {
        dielectrics.end *= dielectrics.base;
        ++dielectrics.depth;
    }
    return dielectrics;
}

std::uint32_t packMedia(const Dielectrics& dielectrics, const std::vector<std::uint32_t>& media,
                        std::uint32_t leftSide) {
    std::uint32_t stack = 0;
    for (auto medium = media.rbegin(); medium != media.rend(); ++medium)
        stack = pushOn(stack, dielectrics.numberOf[*medium - 1], dielectrics.base);
    return withLeftSide(stack, leftSide);
}

std::vector<std::uint32_t> unpackMedia(const Dielectrics& dielectrics, std::uint32_t packed) {
    std::vector<std::uint32_t> media;
    for (std::uint32_t stack = stackOf(packed); stack > 0; stack /= dielectrics.base) {
        const std::uint32_t number = innermostOf(stack, dielectrics.base);
        // No packed stack has a gap; what is none has nothing more to say.
        if (number == 0 || number > dielectrics.materialOf.size()) break;
        media.push_back(dielectrics.materialOf[number - 1] + 1);
    }
    return media;
}

}  // namespace kaustik::scene
