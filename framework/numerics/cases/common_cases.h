// SPDX-License-Identifier: MIT
// The cases that belong to no technique: about shaders that all share, and about whatever nodes
// the registry has for a stage.
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik::numerics {

void addRaySegmentCases(Suite& suite);  // A1 to A5: common/ray_segment.glsl
void addTracingCases(Suite& suite);     // A1 to A11, B17: every tracer
void addInterfaceCases(Suite& suite);   // C19 to C27: common/fresnel.glsl, surface_data.glsl

}  // namespace kaustik::numerics
