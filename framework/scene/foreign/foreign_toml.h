// SPDX-License-Identifier: MIT
// The tables of a scene file (scene_keys.h), out of what a foreign scene has.
#pragma once

#include <string>

#include "framework/scene/foreign/foreign_placement.h"
#include "framework/scene/foreign/foreign_scene.h"
#include "framework/scene/foreign/foreign_text.h"

namespace kaustik::scene {

// Whether two numbers are the same but for their rounding.
[[nodiscard]] bool isEven(double a, double b);

void writeCamera(TomlLines& lines, const Camera& camera);
void writeMedium(TomlLines& lines, const Medium& medium);
void writeLight(TomlLines& lines, const Light& light, const std::string& name);
// As the scene file names them; "" for none.
struct MaterialPictures {
    std::string texture;
    std::string normalMap;
};
void writeMaterial(TomlLines& lines, const Material& material, const std::string& name,
                   const MaterialPictures& pictures);
// The keys of a shape that is no mesh, with its placement.
void writeShape(TomlLines& lines, const ForeignShape& shape, const Placement& placement);
void writeMesh(TomlLines& lines, const std::string& file, const Placement& placement);

}  // namespace kaustik::scene
