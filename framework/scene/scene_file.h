// SPDX-License-Identifier: MIT
// Scenes by name and from scene files (TOML). Units are SI and angles degrees; right-handed, +Y up;
// colours are linear. `rgb` below is three numbers or one for all; a key with a value is optional.
//
//   name = "pool"    description = ""    background_radiance = 0 (rgb)    ambient_irradiance = 0
//   (rgb) time = 0 [camera]    position, target = [0, 0, 0], up = [0, 1, 0], vertical_fov_degrees =
//   45, near = 0.01
//   [[light]]   name, type:
//     directional   direction, irradiance (of a surface that faces it; times color), color = 1
//     (rgb) point         position, intensity (W/sr) or power_watts (= 4π intensity), color, range
//     = 0 spot          as point, and direction, inner_cone_degrees = 0, outer_cone_degrees = 45
//                   (half-angles). power_watts is the flux of the cone, with `spotFalloff`.
//   [[material]]  name, type:
//     lambertian    albedo (rgb), texture = "" (an image beside the scene file; multiplies),
//                   pattern = none|checker|tiles, pattern_albedo = 0.25, uv_scale = 1 (one or two)
//     dielectric    ior, absorption_per_meter = 0 (rgb)
//     mirror        reflectance = 1 (rgb)
//   [[object]]  name, material, position = [0, 0, 0], rotation_degrees = [0, 0, 0] (about the fixed
//               axes x, then y, then z), scale = 1 (one or three, before the rotation), and either
//     mesh          a file, looked up beside the scene file, in meshes/ and in $KAUSTIK_MESHES.
//                   fit = {height = …} or {size = …}: scales the rotated mesh to that height or
//                   longest side. rest_on = y: stands it on that height. With either, position is
//                   where the middle of its bounds goes (with rest_on: of its base, y an offset).
//     shape         plane     size (x, z), cells = 1
//                   box       size, inward = false, open = [] (of "-x", "+x", "-y", …)
//                   sphere    radius, segments = 128
//                   cylinder  radius, height, open = false, inward = false, segments = 128
//                   ring      inner_radius, outer_radius, height, segments = 256
//                   torus     radius, tube_radius, segments = 128, tube_segments = 64
//                   lens      top_radius, bottom_radius (of curvature; > 0 convex, 0 flat),
//                   diameter,
//                             edge_thickness or center_thickness, segments = 128
//                   prism     apex_degrees, height, length
//                   paraboloid  focal_length, diameter, segments = 128
//                   water     size (x, z), cells = 128, and waves = [{…}] or [[object.wave]] of
//                             amplitude, wavelength, direction_degrees = 0, phase = 0 (radians),
//                             omega (rad/s; deep water where absent)
//   [medium]    scattering_per_meter = 0 (rgb), absorption_per_meter = 0 (rgb), anisotropy = 0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Reads and validates a scene file. Throws ConfigError "file:line: …" for whatever the file says
// that makes no sense, and IoError for a file that cannot be read, here or at a mesh or a texture.
[[nodiscard]] Scene loadSceneFile(const std::filesystem::path& path);

// A scene by its name in experiments/scenes, or from a .toml, .gltf or .glb file. Throws
// ConfigError for a name that does not exist, with the nearest one and all there are.
[[nodiscard]] Scene loadScene(const std::string& nameOrPath);

struct SceneListing {
    std::string name;  // what `loadScene` takes
    std::string description;
    std::filesystem::path file;
};

// The scenes of experiments/scenes by name. A file that is not valid TOML is listed all the same;
// its description then says what is wrong.
[[nodiscard]] std::vector<SceneListing> listScenes();

}  // namespace kaustik::scene
