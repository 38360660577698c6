// SPDX-License-Identifier: MIT
// What the directions of a scene's light say about its ways over specular surfaces, before any
// photon is traced: whether one can meet them again.
#pragma once

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Whether a surface bounds no volume and does not turn back: water, a pane, but not a teapot with
// open seams.
[[nodiscard]] bool isSheet(const Mesh& mesh);

// Whether light that has met a specular surface can meet one again.
struct MeetingsAgain {
    bool transmitted =
        false;               // where no branch is followed but the refracted one (or the only one)
    bool reflected = false;  // where the reflected one is, too
};
// Neither, where the scene's only specular surface is a plane, or water on which light comes from
// above and which is too flat to come in its way: a ray that leaves a surface more steeply than the
// surface is anywhere does not come back to it. Both, where nothing forbids it. Waves count with
// the sum of their slopes, so that this holds at every time.
[[nodiscard]] MeetingsAgain meetingsAgain(const Scene& scene);

}  // namespace kaustik::scene
