// SPDX-License-Identifier: MIT
// Light may be stored in another view than the eye's: a node that keeps flux by the texels of the
// sun's view, of another size than the screen, and one that gathers it by projection.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/numerics/frame.h"
#include "framework/scene/files/scene_file.h"
#include "techniques/register_all.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr int kSide = 64;  // texels of the map

struct SunMap {
    glm::mat4 eyeToMap{1.0f};
    float texelArea = 0.0f;  // m²
};

// What the first light's photon grid covers.
SunMap sunMap(const FrameBuilder& frame) {
    scene::Bounds target;
    for (const scene::Object& object : frame.scene().objects) {
        if (isReceiver(frame.scene().materials[object.material].kind)) continue;
        const scene::Bounds bounds = objectBounds(frame.scene(), object);
        target.include(bounds.minimum);
        target.include(bounds.maximum);
    }
    const render::LightView light =
        render::makeLightView(frame.scene().lights[0], target, sceneBounds(frame.scene()));
    const glm::vec2 texel = 2.0f * glm::vec2(light.halfExtent) / static_cast<float>(kSide);
    glm::mat4 toTexels = glm::scale(glm::mat4(1.0f), glm::vec3(1.0f / texel, 1.0f));
    toTexels = glm::translate(toTexels, glm::vec3(glm::vec2(light.halfExtent), 0.0f));
    return {toTexels * render::eyeToLight(light, frame.view()), texel.x * texel.y};
}

CausticMap storeInLight(FrameBuilder& frame, const params::NoParams&, Hits hits, Surfaces,
                        CausticMap before) {
    return frame.pass<CausticMap>(
        "reconstruct.light_points", "a test",
        [&](graph::PassSetup& setup, CausticMap& map) {
            hits.sample(setup);
            hits.incoming.sample(setup);
            map = CausticMap::deposit(setup, before, kSide, kSide, false, "caustic.light_flux");
            map.ledger = setup.storage("LedgerEntries", setup.write(hits.incoming.ledger));
        },
        [sun = sunMap(frame), photons = hits.incoming, isFirst = !before.flux.valid()](
            const CausticMap& map, gl::PassContext& context) {
            if (isFirst) context.texture(map.flux).clear({0, 0, 0, 0});
            dispatchOver(context.compute("tests/gpu/shaders/light_points.comp")
                             .set("eyeToMap", sun.eyeToMap),
                         photons);
        });
}

IrradianceMap gatherFromLight(FrameBuilder& frame, const params::NoParams&, CausticMap map,
                              Surfaces surfaces) {
    return frame.pass<IrradianceMap>(
        "gather.from_light", "a test",
        [&](graph::PassSetup& setup, IrradianceMap& data) {
            setup.sample("fluxSums", map.flux);
            setup.sample("receiver", surfaces.eye.receiver);
            setup.sample("receiverSurface", surfaces.eye.receiverSurface);
            data.irradiance =
                setup.create<IrradianceTexel>("caustic.irradiance", frame.width(), frame.height());
            data.ledger = map.ledger;
        },
        [sun = sunMap(frame)](const IrradianceMap& data, gl::PassContext& context) {
            context.fullscreen("tests/gpu/shaders/light_gather.frag")
                .set("eyeToMap", sun.eyeToMap)
                .set("texelArea", sun.texelArea)
                .target(data.irradiance)
                .draw();
        });
}

TEST(LightInAnotherView, IsStoredByTheSunsTexelsAndGatheredByProjection) {
    Registry registry = registerAll();
    registry.node<ReconstructStage>("light_points", {"One texel a photon.", "a test"},
                                    &storeInLight);
    registry.node<GatherStage>("from_light", {"By projection.", "a test"}, &gatherFromLight);
    registry.technique({"light_points",
                        "Flux by the texels of the sun's view.",
                        "a test",
                        {{"reconstruct", "light_points"}, {"gather", "from_light"}},
                        {}});
    const scene::Scene scene = scene::loadScene("flat-water");
    // Sixteen photons a texel of the map, straight down to the floor.
    const numerics::Frame frame(context(), registry, scene, registry.findTechnique("light_points"),
                                {200, 150, {{"emit.photons", "256x256"}}, {"eye.receiver"}});
    const double below = (1.333 - 1.0) / (1.333 + 1.0);
    const double expected = 1000.0 * (1.0 - below * below);
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    int floorPixels = 0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = static_cast<double>(receiver.at(x, y, 0));
            if (depth <= 0.0) continue;
            const glm::dvec3 world = frame.worldAt(x, y, depth);
            const bool isInside = std::abs(world.x) < 1.85 && std::abs(world.z) < 1.35;
            if (!isInside || std::abs(world.y + 1.2) > 1e-3) continue;
            ++floorPixels;
            EXPECT_NEAR(irradiance.rgb(x, y).g, expected, 1e-3 * expected) << x << ", " << y;
        }
    }
    EXPECT_GT(floorPixels, 5000);
    // What the map holds is what the ledger says, whatever the screen shows of it.
    const EnergyLedger ledger = frame.renderer().ledger();
    EXPECT_LT(std::abs(ledger.balance()), 1e-6);
    EXPECT_NEAR(ledger.watts[transport::kAccountDeposited],
                ledger.watts[transport::kAccountArrived],
                1e-6 * ledger.watts[transport::kAccountArrived]);
}

}  // namespace
}  // namespace kaustik::test
