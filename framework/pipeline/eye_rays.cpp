// SPDX-License-Identifier: MIT
#include "framework/pipeline/eye_rays.h"

#include <vector>

#include "framework/transport/types.h"

namespace kaustik {

using namespace transport;

double EyeRays::shareOf(std::size_t rays) const {
    return pixels > 0 ? static_cast<double>(rays) / static_cast<double>(pixels) : 0.0;
}

EyeRays countEyeRays(const gl::Texture& ending) {
    EyeRays rays;
    for (const float texel : ending.read()) {
        if (texel == 0.0f) continue;
        const float ended = texel - kPathMet;
        ++rays.pixels;
        if (ended == kPathExited) {
            ++rays.cameOut;
        } else if (ended == kPathEndedInside) {
            ++rays.endedInside;
        } else if (ended == kPathReflectionLimit) {
            ++rays.reflectionLimit;
        } else if (ended == kPathMirrorLimit) {
            ++rays.mirrorLimit;
        } else if (ended == kPathNestingLimit) {
            ++rays.nestingLimit;
        } else {
            ++rays.lost;
        }
    }
    return rays;
}

}  // namespace kaustik
