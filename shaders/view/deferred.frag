// SPDX-License-Identifier: MIT
// view.deferred: what the eye sees through one body after the other, of each by its fronts and
// backs in the eye's view (WN09, section 3.1.1), in one pass over the screen.
#include "include/views/eye_path.glsl"

#ifdef DIELECTRICS
#ifdef BODIES
#include "deferred_buffers/bodies.glsl"
#include "include/views/two_interfaces.glsl"

void goThroughBodies(inout EyePath path, ivec2 pixel, vec3 viewing, float depth, vec4 surface) {
    if (isOpen(uint(surface.w) - 1u)) return;
    vec3 entry = viewing * depth;
    int body = bodyAround(entry);
    path.isInMedium = false;
    if (body < 0) {
        // One of those beyond view.deferred.layers.
        path.direction = normalize(viewing);
        return;
    }
#ifdef SEVERAL_BODIES
    PlaneSearch how = PlaneSearch(view_deferred_iterations, false, view_deferred_search_steps,
                                  view_deferred_refinements);
#endif
    vec3 along = normalize(viewing);
    vec3 normal = surface.xyz;
    uint material = uint(surface.w);
    bool isUnrefracted = true;
    uint visited = 0u;
    for (int i = 0; i < bodyCount; ++i) {
        visited |= 1u << uint(body);
        bodyIndex = body;
        ivec2 there = texelAt(entry);
        float through = (backDepthAt(there) + entry.z) * length(viewRay(pixelOf(entry)));
        path.origin = entry;
        if (backDepthAt(there) > 0.0 && through > 0.0) {
            float index = mediumIndex(material);
            if (!isUnrefracted && view_deferred_steps > 0 &&
                view_deferred_distance == view_deferred_distance_estimates)
                through = distanceInside(entry, along, through, view_deferred_steps);
            InnerPath way = innerPath(entry, along, path.direction, normal, through, index,
                                      view_deferred_steps, view_deferred_distance);
            path.throughput *= mediumTransmittance(material, way.lengthMeters);
            path.origin = way.exit;
            path.interfaces += 1.0;
            Interface second = interactAt(path.direction, way.normal, index, 1.0);
            if (second.reflectance >= 1.0 || dot(path.direction, way.normal) <= 0.0) {
                path.ending = kPathLost;  // total internal reflection is not followed
                break;
            }
            path.direction = second.refracted;
            path.throughput *= 1.0 - second.reflectance;
        } else {
            // At the very rim the back faces are another pixel's: no thickness.
            path.direction = along;
        }
#ifdef SEVERAL_BODIES
        if (i + 1 == bodyCount) break;
        BodyHit next = nextBody(path.origin, path.direction, visited, how);
        if (next.body < 0) break;
        body = next.body;
        entry = path.origin + next.t * path.direction;
        normal = next.normal;
        material = next.material;
        isUnrefracted = view_deferred_incidence == view_deferred_incidence_eye &&
                   dot(entry, normal) < 0.0;
        along = isUnrefracted ? normalize(entry) : path.direction;
        Interface first = interactAt(along, normal, 1.0, mediumIndex(material));
        path.interfaces += 1.0;
        path.origin = entry;
        if (first.reflectance >= 1.0) {
            path.direction = first.reflected;
            break;
        }
        path.direction = first.refracted;
        path.throughput *= 1.0 - first.reflectance;
#endif
    }
}
#else
// Only sheets are there.
void goThroughBodies(inout EyePath path, ivec2 pixel, vec3 viewing, float depth, vec4 surface) {}
#endif
#endif
