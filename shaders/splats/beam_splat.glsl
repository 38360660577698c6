// SPDX-License-Identifier: MIT
// A splat as its beam is after all of its interactions: an ellipse on the receiver's plane, however
// long and thin, together with the pixel that it is seen by (elliptical weighted averages, Heckbert
// 1989): its kernel integrated over the pixel, to second order. What is smaller than a pixel, or
// thin as a line, keeps its flux.

#include "splats/pixel_on_plane.glsl"

uniform int isRound;  // a disc of the same area instead

Sprite splatOf(ivec2 texel, out float wanted, out float largest) {
    Hit hit = hitAt(texel);
    Photon photon = photonAt(texel);
    Sprite sprite;
    sprite.center = pointFromEye(hit.positionVs);
    sprite.normal = directionFromEye(hit.normalVs);
    sprite.direction = directionFromEye(photon.directionVs);
    mat2x3 spacing = beamOnPlane(beamAt(texel), photon.directionVs, hit.distanceMeters, hit.normalVs,
                                kMinSlant);
    sprite.tangents = basisAcross(sprite.normal);
    mat2 reach = transpose(sprite.tangents) *
                 mat2x3(directionFromEye(spacing[0]), directionFromEye(spacing[1]));
    if (isRound == 1) reach = mat2(sqrt(abs(determinant(reach))));
    reach *= reconstruct_sprites_footprints;
    wanted = max(length(reach[0]), length(reach[1]));
    largest = float(reconstruct_sprites_maximum) * splatFootprint(sprite.center);
    if (wanted > largest) reach *= largest / wanted;
    sprite.radius = max(min(wanted, largest), splatFootprint(sprite.center));

    mat2 pixel = transpose(sprite.tangents) *
                 pixelOnPlane(sprite.center, sprite.normal, splatFootprint(sprite.center));
    // A kernel ends at three standard deviations; a pixel's variance is a twelfth of its square's.
    const float kPixel = 9.0 / 12.0;
    mat2 spread = reach * transpose(reach) + kPixel * (pixel * transpose(pixel));
    sprite.metric = inverse(spread);
    mat2 onScreen = inverse(pixel) * reach;
    vec2 extent = sqrt(vec2(dot(vec2(onScreen[0].x, onScreen[1].x), vec2(onScreen[0].x, onScreen[1].x)),
                            dot(vec2(onScreen[0].y, onScreen[1].y), vec2(onScreen[0].y, onScreen[1].y))) +
                       kPixel);
#ifndef ORTHOGRAPHIC_VIEW
    // The nearer part of it is larger on the screen.
    vec2 slopes = vec2(sprite.tangents[0].z, sprite.tangents[1].z);
    float nearer = sqrt(max(dot(slopes, spread * slopes), 0.0)) / max(-sprite.center.z, 1e-20);
    extent /= max(1.0 - nearer, 0.25);
#endif
    sprite.pixels = ceil(extent) + 1.0;
    return sprite;
}
