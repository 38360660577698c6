// SPDX-License-Identifier: MIT
#include "framework/pipeline/eye_rays.h"

#include <vector>

#include "framework/transport/types.h"

namespace kaustik {

using namespace transport;

double EyeRays::shareOf(std::size_t rays) const {
    return pixels > 0 ? static_cast<double>(rays) / static_cast<double>(pixels) : 0.0;
}

EyeRays countEyeRays(const gl::Texture& exitDirection) {
    EyeRays rays;
    const std::vector<float> texels = exitDirection.read();
    for (std::size_t i = 0; i + 3 < texels.size(); i += 4) {
        const float ending = texels[i + 3];
        const bool hasDirection =
            texels[i] != 0.0f || texels[i + 1] != 0.0f || texels[i + 2] != 0.0f;
        if (!hasDirection && ending == kPathLost) continue;  // it met nothing specular
        ++rays.pixels;
        if (ending == kPathExited) {
            ++rays.cameOut;
        } else if (ending == kPathEndedInside) {
            ++rays.endedInside;
        } else if (ending == kPathReflectionLimit) {
            ++rays.reflectionLimit;
        } else if (ending == kPathMirrorLimit) {
            ++rays.mirrorLimit;
        } else if (ending == kPathNestingLimit) {
            ++rays.nestingLimit;
        } else {
            ++rays.lost;
        }
    }
    return rays;
}

}  // namespace kaustik
