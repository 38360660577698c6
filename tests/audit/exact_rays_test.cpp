// SPDX-License-Identifier: MIT
// Rays through the hierarchy on the device (trace.bvh, view.bvh, shadow.bvh), and what the
// processor traces where it is the device, next to the reference's, in every scene that the project
// ships: they differ by ties and roundings alone.
#include <gtest/gtest.h>

#include <tuple>

#include "framework/audit/hit_audit.h"
#include "framework/audit/shadow_audit.h"
#include "framework/audit/view_audit.h"
#include "framework/scene/files/scene_file.h"
#include "tests/audit/shipped_scenes.h"

namespace kaustik::test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
const numerics::Settings kExact = {
    {"emit.photons", "128x128"}, {"trace", "bvh"}, {"view", "bvh"}, {"shadow", "bvh"}};

// A scene, and whether the device is taken for a GPU.
using SceneAndDevice = std::tuple<std::string, bool>;

class ExactRays : public testing::TestWithParam<SceneAndDevice> {
  protected:
    std::unique_ptr<Renderer> render(Purpose purpose) {
        return rendered(registry_, scene_, kWidth, kHeight, purpose, kExact,
                        std::get<1>(GetParam()));
    }
    Registry registry_ = registerAll();
    scene::Scene scene_ = scene::loadScene(std::get<0>(GetParam()));
    reference::EmbreeScene embree_{scene_};
};

TEST_P(ExactRays, FindThePhotonsFirstHits) {
    const auto renderer = render(Purpose::audit);
    const audit::HitAudit hits = audit::auditHits(*renderer, embree_);
    ASSERT_GT(hits.photons, 1000u);
    EXPECT_EQ(hits.notANumber, 0u);
    // Where a photon starts on an edge either triangle may be hit.
    EXPECT_LE(static_cast<double>(hits.photons - hits.right),
              1.0 + 1e-4 * static_cast<double>(hits.photons));
}

TEST_P(ExactRays, FindTheWayToTheLights) {
    const auto renderer = render(Purpose::audit);
    const gl::Texture& visibility = renderer->texture(renderer->outputs().shadows.visibility);
    audit::ShadowAudit shadows;
    const std::vector<float> texels = visibility.read();
    const std::size_t layer = static_cast<std::size_t>(kWidth) * kHeight;
    const std::size_t channels = texels.size() / layer / scene_.lights.size();
    for (std::size_t light = 0; light < scene_.lights.size(); ++light) {
        Image image(kWidth, kHeight, 1);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const auto texel = static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x);
                image.at(x, y, 0) = texels[(light * layer + texel) * channels];
            }
        }
        shadows.add(audit::auditShadow(image, light, embree_));
    }
    ASSERT_GT(shadows.tested, 1000u);
    EXPECT_LE(static_cast<double>(shadows.falseShadow + shadows.falseLit),
              1.0 + 1e-3 * static_cast<double>(shadows.tested));
}

class ExactEyeRays : public ExactRays {};

TEST_P(ExactEyeRays, FindWhatTheEyeSees) {
    const auto renderer = render(Purpose::view);
    reference::ViewReferenceRequest request;
    request.width = kWidth;
    request.height = kHeight;
    request.samplesPerSide = 2;
    const reference::ViewReference reference = reference::traceView(embree_, request);
    const View& seen = renderer->outputs().picture.view;
    const audit::ViewAudit audit =
        audit::auditView(imageOf(renderer->texture(seen.exitPosition), 0, 4),
                         imageOf(renderer->texture(seen.exitDirection), 0, 4), reference,
                         render::makeEyeView(scene_.camera, kWidth, kHeight));
    ASSERT_GT(audit.pixels, 300u);
    EXPECT_EQ(audit.notANumber, 0u);
    const double pixels = static_cast<double>(audit.pixels);
    // Light that goes about within the bunny doubles its roundings at each of many interfaces.
    const bool isChaotic = std::get<0>(GetParam()) == "glass-bunny";
    EXPECT_GT(static_cast<double>(audit.interfacesRight) / pixels, isChaotic ? 0.96 : 0.995);
    EXPECT_LT(static_cast<double>(audit.lost) / pixels, 0.002);
    ASSERT_FALSE(audit.sameInterfaces.directionDegrees.empty());
    const std::vector<double>& degrees = audit.sameInterfaces.directionDegrees;
    EXPECT_LT(degrees[degrees.size() / 2], 1e-3);
}

std::string nameOf(const testing::TestParamInfo<SceneAndDevice>& info) {
    const auto& [scene, asOnGpu] = info.param;
    return nameOfScene({scene, info.index}) + (asOnGpu ? "_on_a_gpu" : "");
}
INSTANTIATE_TEST_SUITE_P(Every, ExactRays,
                         testing::Combine(testing::ValuesIn(shippedScenes()), testing::Bool()),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Every, ExactEyeRays,
                         testing::Combine(testing::ValuesIn(scenesWithViews()), testing::Bool()),
                         nameOf);

}  // namespace
}  // namespace kaustik::test
