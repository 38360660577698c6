// SPDX-License-Identifier: MIT
// What the eye sees through two interfaces, in image space (W05): include/views/two_interfaces.glsl.
#include "include/views/eye_path.glsl"

#ifdef DIELECTRICS
#include "include/views/back_faces.glsl"
#include "include/views/two_interfaces.glsl"

void goThroughBodies(inout EyePath path, ivec2 pixel, vec3 viewing, float depth, vec4 surface) {
    float back = faceDepth(pixel, kBackFace);
    if (back <= depth) return;
    uint material = uint(surface.w);
    float index = mediumIndex(material);
    float through = (back - depth) * length(viewing);
    InnerPath way = innerPath(viewing * depth, normalize(viewing), path.direction, surface.xyz,
                              through, index, view_image_space_steps, view_image_space_distance);
    path.throughput *= mediumTransmittance(material, way.lengthMeters);
    path.origin = way.exit;
    path.interfaces = 2.0;
    Interface second = interactAt(path.direction, way.normal, index, 1.0);
    if (second.reflectance < 1.0 && dot(path.direction, way.normal) > 0.0) {
        path.direction = second.refracted;
        path.throughput *= 1.0 - second.reflectance;
    } else {
        path.ending = kPathLost;  // total internal reflection is not followed
    }
    path.isInMedium = false;
}
#endif
