// SPDX-License-Identifier: MIT
// The faces of flat meshes, found from their triangles, wherever these come from: a plane, the
// sides of a box or of a room, an imported wall. Whoever hits rays with them needs no triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// corner + u edgeU + v edgeV with u and v from 0 to 1, m.
struct Parallelogram {
    glm::dvec3 corner{0.0};
    glm::dvec3 edgeU{0.0};
    glm::dvec3 edgeV{0.0};
    glm::dvec3 normal{0.0};  // unit, towards the side that the winding calls the outside
};

// The faces of a mesh of which every triangle that has an area is part of one: coplanar triangles
// that are joined by edges and together fill a parallelogram once, to 1e-6 of the mesh's size. None
// of any other mesh, though it may have two triangles in a plane by chance. Waves are not flat at
// any time; still water is.
[[nodiscard]] std::vector<Parallelogram> flatFaces(const Mesh& mesh);

// What of a scene's receivers is flat.
struct FlatReceivers {
    struct Face {
        Parallelogram shape;  // in the world
        std::uint32_t material = 0;
    };
    std::vector<Face> faces;
    std::vector<bool> isFlat;         // by object
    std::vector<std::string> others;  // names of the receivers that are not
};
[[nodiscard]] FlatReceivers flatReceivers(const Scene& scene);

}  // namespace kaustik::scene
