// SPDX-License-Identifier: MIT
// A small scene that many tests share.
#pragma once

namespace kaustik::test {

// A square metre of wavy water above a floor. With its few waves and cells it renders in no time,
// and it needs no mesh.
inline constexpr const char* kWavyWater = R"(
name = "wavy"
[camera]
position = [0, 2, 1]
[[light]]
name = "sun"
type = "directional"
direction = [0.1, -1, 0]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [2, 2]
position = [0, -0.5, 0]
[[object]]
name = "water"
shape = "water"
material = "water"
size = [1, 1]
cells = [16, 16]
waves = [{amplitude = 0.02, wavelength = 0.5}]
)";

}  // namespace kaustik::test
