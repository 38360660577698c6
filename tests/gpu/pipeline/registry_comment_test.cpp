// SPDX-License-Identifier: MIT
// The example in the comment at the head of framework/pipeline/registry.h, compiled as it stands
// there.
#include <gtest/gtest.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/register_all.h"

namespace kaustik::test {
namespace {

#include "example/registry_comment.h"

Hits traceMine(FrameBuilder& /*frame*/, const MineParams& /*params*/, Photons /*photons*/,
               Surfaces /*surfaces*/) {
    return {};
}

TEST(RegistryComment, AddsANodeWithItsParameterAndATechniqueThatTakesIt) {
    Registry registry = registerAll();
    registerMine(registry);
    EXPECT_EQ(registry.findNode("trace", "mine").description.sentence, "What it does.");
    params::ParamSet params = registry.makeParams(registry.findTechnique("mine"));
    EXPECT_EQ(params.choice("trace"), "mine");
    params.set("mine.gain", "2", "a test");
    EXPECT_EQ(params.get<MineParams>("trace.mine").gain, 2.0f);
}

}  // namespace
}  // namespace kaustik::test
