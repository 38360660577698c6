// SPDX-License-Identifier: MIT
// The normal by which a fragment's surface is lit and bends light.
#include "include/surfaces/normal_map.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface_data.glsl"

// Unit; never on the other side of the surface than the geometric one.
vec3 fragmentNormal(vec3 geometric) {
    vec3 normal = shadingNormal(normalVs, geometric);
#ifdef NORMAL_MAPS
    mat2x3 steps = mat2x3(dFdx(positionVs), dFdy(positionVs));
    mat2 uvSteps = mat2(dFdx(uv), dFdy(uv));
    if (hasNormalMap(material))
        normal = shadingNormal(mappedNormalAt(material, normal, steps, uvSteps, uv), geometric);
#endif
    return normal;
}
