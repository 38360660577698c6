// SPDX-License-Identifier: MIT
// The receiver of each pixel of a view: depth, the area seen, normal, material, reflectance. A
// mirror is none but hides what is beyond it: its depth is negative, and the normal and the
// material are its own.
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"
#include "include/views/view.glsl"

layout(location = 0) out vec4 receiver;
layout(location = 1) out vec4 receiverSurface;
layout(location = 2) out vec4 receiverAlbedo;

#ifdef MANY_VIEWS
uniform int face;
#endif

void main() {
#ifdef MANY_VIEWS
    viewIndex = face;
#endif
    float depth = -positionVs.z;
    vec3 geometric = geometricNormal(positionVs, towardsViewer(positionVs));
    vec3 albedo = surfaceAlbedo(material, uv);
    bool isLit = isReceiver(materialKind(material));
    vec3 ray = viewRay(gl_FragCoord.xy);
    receiver = isLit ? vec4(depth, pixelArea(ray, depth, geometric), 0.0, 0.0)
                     : vec4(-depth, 0.0, 0.0, 0.0);
    receiverSurface = vec4(fragmentNormal(geometric), float(material + 1u));
    receiverAlbedo = isLit ? vec4(albedo, 1.0) : vec4(0.0);
}
