// SPDX-License-Identifier: MIT
// What a pixel covers of a receiver's plane.

// To the next column and to the next row, m. `footprint`: metres that a pixel covers at the point
// of a plane that faces the view.
mat2x3 pixelOnPlane(vec3 point, vec3 normal, float footprint) {
    vec3 ray = viewRay(pixelOf(point));
    float facing = dot(normal, ray);
    facing = (facing < 0.0 ? -1.0 : 1.0) * max(abs(facing), 1e-2 * length(ray));
    mat2x3 across = mat2x3(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
    return (across - outerProduct(ray, (normal * across) / facing)) * footprint;
}
