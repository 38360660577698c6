// SPDX-License-Identifier: MIT
// What was this frame's view becomes the one before. One thread.
#include "include/views/view.glsl"
#include "techniques/temporal/reproject_views.h"

layout(local_size_x = 1) in;

layout(std430) buffer Views {
    PastViews views;
};
uniform vec3 eyeWholeMeters;
uniform vec3 eyeRest;

void main() {
    views.before = views.now;
    views.now = PastView(vec4(eyeWholeMeters, 0.0), vec4(eyeRest, 0.0), view.viewToWorld,
                         view.frustum);
    views.turn.x = 1u - views.turn.x;
}
