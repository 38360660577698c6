// SPDX-License-Identifier: MIT
// What the eye sees through two interfaces, in image space (W05): include/two_interfaces.glsl.
#include "include/scene_look.glsl"

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 exitPosition;
layout(location = 2) out vec4 exitDirection;

#ifdef DIELECTRICS
#include "include/two_interfaces.glsl"

// What is seen at an interface: all outputs.
void lookThroughInterfaces(ivec2 pixel, vec3 viewing, float depth, vec4 surface) {
    vec3 direction = normalize(viewing);
    uint material = uint(surface.w);
    float index = mediumIndex(material);
    vec3 entry = viewing * depth;
    bool enters = dot(direction, surface.xyz) < 0.0;
    Interface first =
        interactAt(direction, surface.xyz, enters ? 1.0 : index, enters ? index : 1.0);
    bool isTotal = first.reflectance >= 1.0;
    vec3 origin = entry;
    vec3 onward = isTotal ? first.reflected : first.refracted;
    vec3 throughput = vec3(isTotal ? 1.0 : 1.0 - first.reflectance);
    uint mediumAtEye = enters ? 0u : material;
    vec3 reached = mediumTransmittance(mediumAtEye, length(entry));
    throughput *= reached;
    bool isInMedium = enters != isTotal;
    float interfaces = 1.0;
    float ending = kPathCameOut;
    float back = texelFetch(backDepth, pixel, 0).x;
    if (enters && back > depth) {
        float through = (back - depth) * length(viewing);
        WayInside way = wayInside(entry, direction, onward, surface.xyz, through, index,
                                  view_image_space_steps, view_image_space_distance);
        throughput *= mediumTransmittance(material, way.length);
        origin = way.exit;
        interfaces = 2.0;
        Interface second = interactAt(onward, way.normal, index, 1.0);
        if (second.reflectance < 1.0 && dot(onward, way.normal) > 0.0) {
            onward = second.refracted;
            throughput *= 1.0 - second.reflectance;
        } else {
            ending = kPathLost;  // total internal reflection is not followed
        }
        isInMedium = false;
    }
    uint medium = isInMedium && isOpen(material - 1u) ? material : 0u;
    float ratio = mediumIndex(mediumAtEye) / mediumIndex(isInMedium ? material : 0u);
    MirrorPath path = MirrorPath(origin, onward, vec3(1.0), 0u, 0);
    SceneHit seen = lookThrough(origin, onward, 0u);
    if (followMirrors(path, seen, medium)) ending = kPathMirroredTooOften;
    exitPosition = vec4(path.origin, interfaces + float(path.mirrors));
    exitDirection = vec4(path.direction, ending);

    radiance.rgb = throughput * path.share * ratio * ratio *
                   radianceAlong(path.origin, path.direction, medium, seen, pixel);
    if (!isTotal) {
        uint outside = isOpen(material - 1u) ? mediumAtEye : 0u;
        radiance.rgb += reached * first.reflectance *
                        radianceReflected(entry, first.reflected, outside, 0u, pixel);
    }
    radiance.a = 1.0;
}
#endif

void look(ivec2 pixel) {
    radiance = radianceStraight(pixel);
    exitPosition = vec4(0.0);
    exitDirection = vec4(0.0);
    float depth = firstDepth(pixel);
    if (depth <= 0.0) return;
    vec3 viewing = viewRay(positionOfSample());
    vec4 surface = firstSurface(pixel);
    if (materialKind(uint(surface.w) - 1u) == kMaterialMirror) {
        MirrorView mirrored = lookIntoMirror(pixel, viewing);
        radiance = vec4(mirrored.radiance, 1.0);
        exitPosition = mirrored.exitPosition;
        exitDirection = mirrored.exitDirection;
        return;
    }
#ifdef DIELECTRICS
    lookThroughInterfaces(pixel, viewing, depth, surface);
#endif
}

void main() {
    look(ivec2(gl_FragCoord.xy));
    weigh(radiance);
}
