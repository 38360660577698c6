// SPDX-License-Identifier: MIT
// What the straight eye ray of each pixel ends on: how bright that is by direct light, and how much
// of an even irradiance it would send back; so that irradiance of other light becomes radiance, and
// someone else's picture can be taken apart (judge/judge.h).
#pragma once

#include <cstdint>

#include "framework/image/image.h"
#include "framework/reference/embree_scene.h"

namespace kaustik::reference {

struct DirectViewRequest {
    int width = 800;
    int height = 600;
    int samplesPerSide = 4;  // of a pixel's square, jittered: its box filter
    std::uint64_t seed = 1;
    int threads = 0;  // 0: all
};

// Rows from the top; means over the pixels.
struct DirectView {
    Image direct;  // radiance by direct light alone, W/m²/sr
    Image fill;    // albedo / π: radiance by an irradiance of 1 W/m²
    // 1 where all of the pixel is one diffuse receiver's that gives no light of its own: not where
    // there are mirrors, glossy surfaces, lamps, edges of objects, or nothing.
    Image isPlain;
    Image hasGlass;  // 1 where a ray through the pixel passes a dielectric before it
};

[[nodiscard]] DirectView traceDirectView(const EmbreeScene& scene,
                                         const DirectViewRequest& request);

}  // namespace kaustik::reference
