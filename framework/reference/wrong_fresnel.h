// SPDX-License-Identifier: MIT
// What a scene's caustics would be if dielectrics divided light by a wrong law: mistakes that
// renderers make, for those who look for them (judge/judge.h). The photons go where those of the
// reference go, and their flux is weighted by the wrong law's share over Fresnel's at each
// interface that they have met (importance sampling), so that one run gives all laws, and what is
// the same in both has no noise.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "framework/image/image.h"
#include "framework/reference/embree_scene.h"

namespace kaustik::reference {

enum class WrongFresnel {
    lossless,  // refracted light loses nothing to what is reflected, which is as it should be
    schlick,   // R0 + (1 - R0) (1 - cos)^5 with the larger of both angles (Schlick 1994, Eq. 15)
    swapped,   // Fresnel's equations with the two indices exchanged; directions are right
};
inline constexpr std::array<WrongFresnel, 3> kWrongFresnels = {
    WrongFresnel::lossless, WrongFresnel::schlick, WrongFresnel::swapped};

// The share of light that is reflected by that law, 0 to 1, where Fresnel's is below 1; `cosine` >=
// 0, of the angle of incidence. What is refracted is the rest of it, but for `lossless`.
[[nodiscard]] double reflectanceOf(WrongFresnel law, double cosine, double from, double to);

struct WrongFresnelRequest {
    int width = 800;
    int height = 600;
    std::uint64_t photons = 1u << 22;  // rounded up to batches of 2^18
    std::uint64_t seed = 1;
    int threads = 0;                       // 0: all
    std::function<bool()> shouldContinue;  // asked on any thread, often; empty: goes on
};

// By how much the irradiance of each pixel would differ, W/m², rows from the top; in the order of
// kWrongFresnels. Images of nothing where it was told to end.
[[nodiscard]] std::array<Image, kWrongFresnels.size()> changesByWrongFresnel(
    const EmbreeScene& scene, const WrongFresnelRequest& request);

}  // namespace kaustik::reference
