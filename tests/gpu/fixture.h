// SPDX-License-Identifier: MIT
// What the GPU tests share: one headless context and frames of the project's own techniques.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/gl/context.h"
#include "framework/numerics/frame.h"
#include "framework/pipeline/renderer.h"
#include "framework/scene/scene.h"
#include "techniques/register_all.h"

namespace kaustik::test {

// The context of this process, current on its only thread.
[[nodiscard]] gl::Context& context();

// Whether trace.raytraced is missing, for want of Embree.
[[nodiscard]] bool lacksExactTracer();

using numerics::sceneFromText;
using numerics::Settings;
using numerics::Texels;

// One rendered measurement frame of a scene with the project's own techniques.
class Frame : public numerics::Frame {
  public:
    using Settings = numerics::Settings;
    Frame(const scene::Scene& scene, int width, int height, const Settings& settings = {},
          const std::vector<std::string>& saved = {}, bool poison = false,
          const std::string& technique = "screen_space_photons");
    Frame(const scene::Scene& scene, const numerics::FrameRequest& request,
          const std::string& technique);
};

}  // namespace kaustik::test
