// SPDX-License-Identifier: MIT
// What a scene makes a technique model, so that nothing else is built (framework/README.md,
// "Only what a scene needs").
#pragma once

#include <cstddef>
#include <vector>

#include "framework/scene/light_paths.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

struct SceneNeeds {
    // How many specular interfaces one path can hit when it crosses every dielectric once: one
    // with an inside counts 2 (in and out), a sheet such as a water surface 1, a wave that breaks
    // 3, and all mirrors together 1. Repeated reflections, between mirrors or inside a dielectric,
    // are not counted; a technique's own bounce limit says how many it follows.
    int specularInterfaces = 0;
    RepeatedHits repeatedHits;  // whether there are such repeated ones at all
    // The path that shows that the reflected branch at dielectrics is seen. There is none where the
    // refracted branch is enough.
    std::optional<ReflectedLight> reflectedLight;
    std::optional<std::string> concaveBody;  // which says that much is reflected within, too
    int reflectors = 0;                      // objects that are mirrors
    int refractors = 0;                      // objects that are dielectrics
    bool closedDielectrics = false;  // one of these has an inside: glass, not a water surface
    // Dielectrics with an inside, by their places in the scene's objects; those that meet or lie in
    // one another are one (connected_bodies.h).
    std::vector<std::vector<std::size_t>> bodies;
    // A body's box overlaps that of a dielectric with an inside: it may lie in it.
    bool nestedBodies = false;
    bool medium = false;               // one that scatters or absorbs
    bool scatteringMedium = false;     // one that scatters: there is light on the way to be seen
    bool glossyReceivers = false;      // a receiver is not Lambertian alone
    bool emission = false;             // some object shines
    bool animated = false;             // a height field has a wave that moves
    int lights = 0;                    // points of those that have a size included
    int photonLights = 0;              // the same, once for each of the scene's bands
    bool disperses = false;            // a dielectric's index changes with the wavelength
    int bands = 1;                     // parts of the spectrum that are followed apart
    int emitters = 0;                  // lights that have a size
    bool receivers = false;            // a diffuse or glossy surface that light ends on
    int measuredDepthComplexity = -1;  // most layers behind one pixel; -1 until a renderer counts
};

[[nodiscard]] SceneNeeds sceneNeeds(const Scene& scene);
// Of the same scene again and again, as its lights, waves and time change.
[[nodiscard]] SceneNeeds sceneNeeds(SceneShapes& shapes);

}  // namespace kaustik::scene
