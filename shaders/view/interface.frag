// SPDX-License-Identifier: MIT
// What the eye sees in the first specular surface of a pixel: one refraction and one reflection.
// The refracted ray is taken as far as the receiver lies straight beyond the surface, and what the
// picture shows there is looked up; the reflected one sees the environment. Radiance
// changes by T/n² where it leaves the medium that the receiver lies in (hard case 28a). A mirror
// shows the scene.
#include "include/views/scene_look.glsl"
#include "include/views/view_outputs.glsl"

// Where the refracted ray hits the receivers, as a pixel.
ivec2 pixelBehind(vec3 entry, vec3 direction, float distanceBehind, ivec2 pixel) {
    if (view_interface_refract == false) return pixel;
    vec3 there = entry + direction * distanceBehind;
    if (there.z > -view.frustum.z) return pixel;
    ivec2 found = ivec2(floor(pixelOf(there)));
    if (any(lessThan(found, ivec2(0))) || any(greaterThanEqual(found, ivec2(view.sizePixels.xy)))) {
        return pixel;
    }
    // What lies in front of the surface there is not beyond it.
    float depth = texelFetch(receiver, found, 0).x;
    float surface = texelFetch(interfaceDepth, found, 0).x;
    return depth > 0.0 && surface > 0.0 && depth > surface ? found : pixel;
}

void look(ivec2 pixel) {
    radiance = radianceStraight(pixel);
    exitPosition = vec4(0.0);
    exitDirection = vec4(0.0);
    float depth = firstDepth(pixel);
    if (depth <= 0.0) return;
    vec4 surface = firstSurface(pixel);
    uint material = uint(surface.w) - 1u;
    MaterialData data = materials[material];
    vec3 ray = viewRay(positionOfSample(pixel));
    vec3 direction = normalize(ray);
    if (uint(data.albedo.w) == kMaterialMirror) {
        MirrorView mirrored = lookIntoMirror(pixel, ray);
        radiance = vec4(mirrored.radiance, 1.0);
        exitPosition = mirrored.exitPosition;
        exitDirection = mirrored.exitDirection;
        return;
    }
    float index = data.absorption.w;
    bool enters = dot(direction, surface.xyz) < 0.0;
    Interface interaction =
        interactAt(direction, surface.xyz, enters ? 1.0 : index, enters ? index : 1.0);
    vec3 entry = ray * depth;
    float receiverDepth = texelFetch(receiver, pixel, 0).x;
    vec3 through = vec3(0.0);
    if (interaction.reflectance < 1.0) {
        float behind = receiverDepth > depth ? (receiverDepth - depth) * length(ray) : 0.0;
        ivec2 found = pixelBehind(entry, interaction.refracted, behind, pixel);
        bool isOpen = data.uv.w > 0.0;
        // Behind an open surface the receiver lies inside the medium; a closed object is left
        // again.
        float transmittance = 1.0 - interaction.reflectance;
        float factor = isOpen ? (enters ? transmittance / (index * index)
                                        : transmittance * index * index)
                              : transmittance * transmittance;
        through = factor * texelFetch(receiverRadiance, found, 0).rgb;
        if (isOpen && enters) through *= mediumTransmittance(material + 1u, behind);
    }
    bool goesThrough = interaction.reflectance < 1.0;
    vec3 onward = goesThrough ? interaction.refracted : interaction.reflected;
    exitPosition = vec4(entry, 1.0);
    exitDirection =
        vec4(goesThrough && !view_interface_refract ? direction : onward, kPathExited);
    radiance =
        vec4(through + interaction.reflectance * environmentRadiance(interaction.reflected), 1.0);
}

void main() {
    look(ivec2(gl_FragCoord.xy));
    finishPixel();
}
