// SPDX-License-Identifier: MIT
// Whose caustic light may come to what the eye sees (U08, section 4.1: generators that "may cast
// caustics onto caustic receivers that are visible from the camera"), by proof: an object is left
// out only where flat opaque receivers stand in every way from its box to what is in the picture.
// Light is taken to leave a specular object from anywhere in its box in all directions, and to do
// so again wherever it meets another; so is what the eye sees in and through specular objects.
// World space, m.
#pragma once

#include <vector>

#include "framework/render/view.h"
#include "framework/scene/scene.h"

namespace kaustik {

// By object of the scene: false for a specular one none of whose light can come, directly or by
// other specular objects, to the side of a receiver that the eye sees, directly or by these. True
// for all else, and wherever that is not proved: by one flat receiver a way, within a budget of
// steps. Light in a medium is seen wherever it goes, so that all are true where one scatters.
[[nodiscard]] std::vector<bool> mayReachPicture(const scene::Scene& scene,
                                                const render::RasterView& eye);

}  // namespace kaustik
