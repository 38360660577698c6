// SPDX-License-Identifier: MIT
// What the directions of a scene's light say about its paths over specular surfaces, before any
// photon is traced: whether one can hit them again, and whether reflected light is seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/scene/surface_rays.h"

namespace kaustik::scene {

// Whether surfaces of a material bound no volume: one object that does not is enough. A dielectric
// with open seams has an inside all the same.
[[nodiscard]] bool isOpen(const Scene& scene, std::size_t material);
// The same of all materials.
[[nodiscard]] std::vector<bool> openMaterials(const Scene& scene);

// What is asked of a scene's shapes again whenever its lights, waves or time have changed: found
// when it is first asked for, and kept. The scene must outlive it, and its objects, materials and
// meshes, waves aside, must stay as they are.
class SceneShapes {
  public:
    explicit SceneShapes(const Scene& scene) : scene_(scene) {}
    [[nodiscard]] const Scene& scene() const { return scene_; }

    [[nodiscard]] const SurfaceRays& receivers();
    // By samples: a corner that lies before a triangle by more than a mesh's noise says that it is
    // not.
    [[nodiscard]] bool isConvex(std::uint32_t mesh);
    // Whether a sheet does, as a wave that breaks (meshes/winding_number.h).
    [[nodiscard]] bool turnsBack(std::uint32_t mesh);
    // connectedBodies().
    [[nodiscard]] const std::vector<std::vector<std::size_t>>& bodies();
    // Whether a body's box overlaps that of a dielectric with an inside.
    [[nodiscard]] bool hasNestedBodies();

  private:
    const Scene& scene_;
    std::optional<SurfaceRays> receivers_;
    std::map<std::uint32_t, bool> convex_;
    std::map<std::uint32_t, bool> turnsBack_;
    std::optional<std::vector<std::vector<std::size_t>>> bodies_;
    std::optional<bool> hasNestedBodies_;
};

// Whether light that has hit a specular surface can hit one again.
struct RepeatedHits {
    bool transmitted =
        false;               // where no branch is followed but the refracted one (or the only one)
    bool reflected = false;  // where the reflected one is, too
    // False: not where the light is outside of all bodies.
    bool outside = true;
};
// Not from outside, where the scene's only specular surface bounds a convex body. Neither, where
// its only one is a plane, or water on which light comes from above and which is too flat to come
// into its path: a ray that leaves a surface more steeply than the surface is anywhere does not
// come back to it. Both, where nothing forbids it. Waves count with the sum of their slopes, so
// that this holds at every time.
[[nodiscard]] RepeatedHits repeatedHits(SceneShapes& shapes);
[[nodiscard]] RepeatedHits repeatedHits(const Scene& scene);

// Light that a dielectric sheet, water say, sends back to a receiver.
struct ReflectedLight {
    std::string sheet;  // names of objects
    std::string receiver;
    double share = 0.0;  // of the light, by Fresnel's equations where the sheet is level
};
// The largest share above 1 % (water reflects 2 % of what comes straight down) for which a receiver
// lies in the path of the beam that the sheet, taken for level, reflects: by the boxes of both, or,
// of a receiver around the sheet, by rays from nine points of it. Waves may decide otherwise.
// Closed dielectrics send light everywhere and are not asked.
[[nodiscard]] std::optional<ReflectedLight> reflectedLight(SceneShapes& shapes);
[[nodiscard]] std::optional<ReflectedLight> reflectedLight(const Scene& scene);

// The name of a dielectric with an inside that is not convex; nothing where all are. From a convex
// body light goes out where it first hits it from within, and loses to reflection twice; in any
// other, as in a teapot, it comes to many interfaces, each of which parts off its share.
[[nodiscard]] std::optional<std::string> concaveBody(SceneShapes& shapes);
[[nodiscard]] std::optional<std::string> concaveBody(const Scene& scene);

// Whether the scene's dielectrics with an inside, one at least, are balls that do not touch each
// other's boxes. Light that has entered a ball comes to its surface at the angle that it entered
// by, and so is never reflected totally there.
[[nodiscard]] bool hasBallsAlone(const Scene& scene);

}  // namespace kaustik::scene
