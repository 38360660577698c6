// SPDX-License-Identifier: MIT
// What the eye sees through two interfaces, in image space (W05, as K06 and WN09 describe it): the
// point where a refracted ray leaves lies at a distance between that to the back faces along the
// eye's ray, d_V, and that along the inverse normal, d_N. The weight of d_V is the ratio of the
// angles of refraction and incidence: right for an index of 1, where the ray goes straight on, and
// for one without limit, where it follows the normal.
#include "include/scene_look.glsl"

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 exitPosition;
layout(location = 2) out vec4 exitDirection;

#ifdef DIELECTRICS
uniform sampler2D backDepth;
uniform sampler2D backSurface;

ivec2 texelAt(vec3 positionVs) {
    return ivec2(floor(pixelOf(vec3(positionVs.xy, min(positionVs.z, -view.frustum.z)))));
}

// Depth of the back faces, 0 where there are none.
float backAt(ivec2 texel) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(view.sizePixels.xy))))
        return 0.0;
    return texelFetch(backDepth, texel, 0).x;
}

// Along the inverse normal to the back faces, m: a point on that way is inside as long as the back
// faces lie beyond it. The paper's is precomputed for every vertex; this needs no preparation.
float distanceAlongNormal(vec3 entry, vec3 normal, float longest) {
    float inside = 0.0;
    float step = longest / float(view_image_space_steps);
    for (int i = 1; i <= view_image_space_steps; ++i) {
        vec3 p = entry - normal * (step * float(i));
        float back = backAt(texelAt(p));
        if (back <= 0.0 || -p.z > back) break;
        inside = step * float(i);
    }
    if (inside >= longest) return longest;
    // Between the last point inside and the first one outside.
    float outside = inside + step;
    for (int i = 0; i < 4; ++i) {
        float middle = 0.5 * (inside + outside);
        vec3 p = entry - normal * middle;
        float back = backAt(texelAt(p));
        if (back <= 0.0 || -p.z > back) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    return 0.5 * (inside + outside);
}

// The normal of the back faces around a point: bilinear between the pixels that have one.
vec3 backNormalAround(vec3 positionVs, ivec2 fallback) {
    vec2 corner = pixelOf(vec3(positionVs.xy, min(positionVs.z, -view.frustum.z))) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = first + step;
        if (backAt(texel) <= 0.0) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        sum += axis.x * axis.y * texelFetch(backSurface, texel, 0).xyz;
    }
    float size = length(sum);
    return size > 1e-3 ? sum / size : texelFetch(backSurface, fallback, 0).xyz;
}

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
        float alongRay = (back - depth) * length(viewing);
        float cosI = clamp(-dot(direction, surface.xyz), 0.0, 1.0);
        float cosT = clamp(-dot(onward, surface.xyz), 0.0, 1.0);
        float angleI = acos(cosI);
        float weight = angleI > 1e-3 ? acos(cosT) / angleI : 1.0 / index;
        float inside = alongRay;
        if (view_image_space_steps > 0) {
            // No object is thicker than twice what the eye sees of it, or the search ends there.
            float alongNormal = distanceAlongNormal(entry, surface.xyz, 2.0 * alongRay);
            inside = weight * alongRay + (1.0 - weight) * alongNormal;
        }
        vec3 exit = entry + inside * onward;
        // Beside the silhouette: the last pixel on the way there that has back faces.
        ivec2 there = texelAt(exit);
        const int kTries = 8;
        for (int i = 1; i <= kTries && backAt(there) <= 0.0; ++i)
            there = texelAt(mix(exit, entry, float(i) / float(kTries)));
        vec3 normal = backNormalAround(exit, there);
        throughput *= mediumTransmittance(material, inside);
        origin = exit;
        interfaces = 2.0;
        Interface second = interactAt(onward, normal, index, 1.0);
        if (second.reflectance < 1.0 && dot(onward, normal) > 0.0) {
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
