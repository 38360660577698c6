// SPDX-License-Identifier: MIT
// The cases that belong to no technique: about shaders that all share, and about whatever nodes
// the registry has for a stage.
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik::numerics {

void addRaySegmentCases(Suite& suite);      // A1 to A5, A7: include/views/ray_segment.glsl
void addTracingCases(Suite& suite);         // A1 to A3, A6 to A11, B17: every tracer
void addLayerCases(Suite& suite);           // B12 to B16: every node of layers
void addInterfaceCases(Suite& suite);       // C19 to C25: include/surfaces/fresnel.glsl
void addSurfaceSideCases(Suite& suite);     // C26, A9: emission, interaction, tracers
void addOpticsCases(Suite& suite);          // C27 to C28a: interaction, tracers, view
void addReconstructionCases(Suite& suite);  // D31, D32, D34, D34a: reconstruction, emission
void addMediaCases(Suite& suite);           // D34, D36: nodes of media
void addMirrorCases(Suite& suite);          // D37: every node of view
void addBallCases(Suite& suite);            // D39, D41: every tracer and interaction
void addDispersionCases(Suite& suite);      // D42 to D44: interaction, tracing, reconstruction
void addForeignSceneCases(Suite& suite);    // D45 to D47: tracing, emission
void addWholeFrameCases(Suite& suite);      // A10, B18 and E: every technique

}  // namespace kaustik::numerics
