// SPDX-License-Identifier: MIT
// On which side of a specular surface light is, and by which normal it is bent (hard case 26).
#include "include/surfaces/dielectrics.glsl"
#include "include/surfaces/fresnel.glsl"
#include "include/photons/transfer_map.glsl"

// Whether light in `media` is inside of something that has an inside, other than water.
bool isInsideClosed(uint media) {
    uint medium = innerMedium(media);
    return medium != 0u && !isOpen(medium - 1u);
}

// The indices of refraction in front of and beyond a surface of a dielectric (material index + 1)
// for light in `media`; the same twice where one ends inside of another. The side is the
// triangle's, never the shading normal's.
vec2 indicesAt(uint material, uint media, bool enters) {
    uint inner = innerMedium(media);
    float before = mediumIndex(inner);
    if (enters) return vec2(before, mediumIndex(material));
    return vec2(before, inner == material ? mediumIndex(outerMedium(media)) : before);
}

// The shading normal bends light as the smooth surface would. Where it would send light to the
// wrong side of the triangle, the triangle's own normal does: nothing leaks through a surface, and
// whoever takes the sign of the result takes the triangle's side. All unit; both normals outward.
vec3 bendingNormal(vec3 direction, vec3 shading, vec3 geometric, uint material, uint media) {
    uint kind = materialKind(material - 1u);
    if (isReceiver(kind)) return shading;
    bool enters = dot(direction, geometric) < 0.0;
    float side = enters ? 1.0 : -1.0;
    vec3 outer = side * geometric;
    vec3 normal = side * shading;
    if (!(dot(direction, normal) < 0.0)) return geometric;
    if (kind == kMaterialMirror) {
        return dot(reflect(direction, normal), outer) > 0.0 ? shading : geometric;
    }
    vec2 indices = indicesAt(material, media, enters);
    Interface interaction = interactAt(direction, normal, indices.x, indices.y);
    bool isRight = dot(interaction.reflected, outer) > 0.0 &&
                   (interaction.reflectance >= 1.0 || dot(interaction.refracted, outer) < 0.0);
    return isRight ? shading : geometric;
}
