// SPDX-License-Identifier: MIT
#pragma once

namespace kaustik::test {

// The part of a scene file that makes a floor of chalk, and glass for what stands over it.
inline constexpr const char* kFloorAndGlass = R"(
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [6, 6]
)";

}  // namespace kaustik::test
