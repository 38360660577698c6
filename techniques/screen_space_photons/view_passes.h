// SPDX-License-Identifier: MIT
// What the nodes that look through specular surfaces share.
#pragma once

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {

// The box around all dielectrics, along the world's axes, with a margin of two pixels.
struct DielectricsBox {
    glm::vec3 centerVs{0.0f};  // m
    glm::vec3 halfExtentMeters{0.0f};
    // A receiver's box overlaps that of a closed dielectric: it may lie within.
    bool holdsReceivers = false;
};
[[nodiscard]] DielectricsBox boxOfDielectrics(const FrameBuilder& frame);

// Declares what such a pass reads of the eye and the outputs of a View. A pass that is disabled
// shows the receivers and no exits.
[[nodiscard]] View createView(const FrameBuilder& frame, graph::PassSetup& setup,
                              const EyeBuffer& eye, const Radiance& receivers);

// How many pixels' ways have ended so (transport::kWay…). Waits for the device.
[[nodiscard]] std::size_t countExits(const gl::Texture& exitDirection, float ending);

// Binds what createView has declared, the images, and its outputs as targets: what
// screen_space_photons/refracted_scene.glsl needs besides the view and the materials.
void bindLook(const FrameInputs& inputs, gl::Command& command, const EyeBuffer& eye,
              const Radiance& receivers, const SceneLookParams& look, const View& seen);

}  // namespace kaustik
