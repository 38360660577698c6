// SPDX-License-Identifier: MIT
// A mesh of the user's own in a scene that is made for one: experiments/scenes/on. Wherever a scene
// is named, "dragon.glb?on=table&material=glass" names such a one, and "dragon.ply" alone one on a
// table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

struct OwnMesh {
    std::string file;           // a mesh, or a .gltf or .glb
    std::string on = "table";   // a name in experiments/scenes/on, or a .toml that is made for it
    std::string material = {};  // one of that scene's; "": the file's own, or that scene's choice
    std::string up = "y";       // the file's axis that points up: "y" or "z"
    friend bool operator==(const OwnMesh&, const OwnMesh&) = default;
};

// Whether a path ends as meshes do that can be read, without .gltf and .glb: .obj, .ply, .ply.gz,
// .stl and .3ds, in any case.
[[nodiscard]] bool isMeshFile(const std::string& path);

// What such a name says; nothing where it is no mesh file and says no "?on=". Throws ConfigError
// for an option that there is not.
[[nodiscard]] std::optional<OwnMesh> parseOwnMesh(const std::string& name);
// The name that says it.
[[nodiscard]] std::string nameOf(const OwnMesh& mesh);

// The scene, with the mesh scaled to the room that there is for it. A .gltf or .glb of something
// specular keeps its own materials unless one is asked for. Throws ConfigError for a scene that is
// not made for a mesh and for a material that it does not have, and what loading the parts throws.
[[nodiscard]] Scene loadOwnMesh(const OwnMesh& mesh);

// The names in experiments/scenes/on.
[[nodiscard]] std::vector<std::string> listStands();

}  // namespace kaustik::scene
