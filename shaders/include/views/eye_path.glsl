// SPDX-License-Identifier: MIT
// What the eye sees through bodies in image space: what its ray meets first, and what it sees
// beyond them. How it goes through them says whoever includes this: goThroughBodies.
#include "include/views/scene_look.glsl"
#include "include/views/view_outputs.glsl"

#ifdef DIELECTRICS
// A ray of the eye that has been refracted, or totally reflected, at the first interface.
struct EyePath {
    vec3 origin;
    vec3 direction;    // unit
    vec3 throughput;
    bool isInMedium;   // of the first interface
    float interfaces;  // that it has met
    float ending;      // kPath…
};

// From the front of a body that a pixel sees, at `depth`, to where it leaves the last one.
// `viewing`: the pixel's ray, of a depth of 1 m; `surface`: the front's normal and material + 1.
void goThroughBodies(inout EyePath path, ivec2 pixel, vec3 viewing, float depth, vec4 surface);

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
    uint mediumAtEye = enters ? 0u : material;
    vec3 reached = mediumTransmittance(mediumAtEye, length(entry));
    EyePath through =
        EyePath(entry, isTotal ? first.reflected : first.refracted,
                vec3(isTotal ? 1.0 : 1.0 - first.reflectance) * reached, enters != isTotal, 1.0,
                kPathExited);
    if (enters) goThroughBodies(through, pixel, viewing, depth, surface);
    uint medium = through.isInMedium && isOpen(material - 1u) ? material : 0u;
    float ratio = mediumIndex(mediumAtEye) / mediumIndex(through.isInMedium ? material : 0u);
    MirrorPath path = MirrorPath(through.origin, through.direction, vec3(1.0), 0u, 0);
    SceneHit seen = lookThrough(path.origin, path.direction, 0u);
    if (followMirrors(path, seen, medium)) through.ending = kPathMirrorLimit;
    exitPosition = vec4(path.origin, through.interfaces + float(path.mirrors));
    exitDirection = vec4(path.direction, through.ending);

    radiance.rgb = through.throughput * path.share * ratio * ratio *
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
    vec3 viewing = viewRay(positionOfSample(pixel));
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
    finishPixel();
}
