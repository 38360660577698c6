// SPDX-License-Identifier: MIT
// The photon audit on frames of which the fates are known: still water under a sun straight above,
// tracers that err on purpose, views that cannot see everything.
#include "framework/audit/hit_audit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/numerics/frame.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using audit::HitAudit;

// A tracer that asks the line tracer and then moves or drops what it found.
struct SpoiledParams {
    glm::vec2 shiftPixels{0.0f};
    bool dropped = false;
    bool notANumber = false;
};
SpoiledParams spoiled;

Hits traceSpoiled(FrameBuilder& frame, const params::NoParams&, Photons photons,
                  Surfaces surfaces) {
    const auto& lines = *static_cast<const TraceStage::Build*>(
        frame.inputs().registry.findNode("trace", "lines").build.get());
    const Hits hits = lines(frame, photons, surfaces);
    return frame.pass<Hits>(
        "trace.spoiled", "a test",
        [&](graph::PassSetup& setup, Hits& data) {
            data = hits;
            data.position = setup.image("hitPosition", setup.write(hits.position));
            data.flux = setup.image("hitFlux", setup.write(hits.flux));
        },
        [](const Hits& data, gl::PassContext& context) {
            context.compute("tests/audit/shaders/spoil_hits.comp")
                .set("shiftPixels", spoiled.shiftPixels)
                .set("dropped", spoiled.dropped ? 1 : 0)
                .set("notANumber", spoiled.notANumber ? 1 : 0)
                .dispatchOver(data.incoming.width, 8, data.incoming.height, 8);
        });
}

class Audited {
  public:
    explicit Audited(const scene::Scene& scene, const Frame::Settings& settings = {})
        : registry_(registerAll()), embree_(scene) {
        registry_.node<TraceStage>("spoiled", {"Errs on purpose.", "a test", "For this test."},
                                   &traceSpoiled);
        RenderSettings render;
        render.technique = registry_.findTechnique("screen_space_photons");
        render.params = registry_.makeParams(render.technique);
        render.params.set("emit.photons", "64x64", "test");
        for (const auto& [name, value] : settings)
            render.params.set(name, value, "test");
        render.width = 200;
        render.height = 150;
        renderer_ = std::make_unique<Renderer>(context(), registry_, scene, std::move(render));
        renderer_->build(Purpose::audit);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer_->renderFrame(timer);
        hits = audit::auditHits(*renderer_, embree_);
        emittedWatts = renderer_->ledger().watts[transport::kAccountEmitted];
        ledger = audit::resolveLedger(*renderer_, hits, emittedWatts);
        const EnergyLedger& traced = hits.booked;
        for (const unsigned account : {transport::kAccountLeftScene, transport::kAccountOffScreen,
                                       transport::kAccountBehindEye, transport::kAccountUnresolved,
                                       transport::kAccountMissedByTracer}) {
            lostByTracersWatts += traced.watts[account];
        }
    }
    HitAudit hits;
    EnergyLedger ledger;
    double emittedWatts = 0.0;
    double lostByTracersWatts = 0.0;  // as the tracers themselves account for it

  private:
    Registry registry_;
    reference::EmbreeScene embree_;
    std::unique_ptr<Renderer> renderer_;
};

// A photon for a photon: fates add up, and so does their energy.
void expectAccounted(const Audited& audited) {
    const HitAudit& hits = audited.hits;
    std::uint64_t wrong = 0;
    for (const auto& [cause, count] : hits.missed)
        wrong += count;
    for (const auto& [cause, count] : hits.falseHits)
        wrong += count;
    EXPECT_EQ(hits.right + wrong, hits.photons);
    EXPECT_LE(hits.visible, hits.exactHits);
    EXPECT_LT(std::abs(audited.ledger.balance()), 1e-6);  // 32-bit flux, rounded to the quantum
    // What the audit tells apart is what the tracers lost, summed in 32-bit flux by fixed point
    // there and in double here.
    double told = 0.0;
    for (const double watts : hits.missedWatts)
        told += watts;
    EXPECT_NEAR(told, audited.lostByTracersWatts, 1e-6 * audited.emittedWatts);
}

// Memory for a few batches, of which each takes the textures of the one before.
TEST(HitAudit, JudgesThePhotonsOfAllBatches) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const Frame::Settings adaptive = {{"driver", "adaptive"},     {"emit", "deferred"},
                                      {"refine.finest", "256"},   {"refine.check", "64"},
                                      {"reconstruct", "sprites"}, {"specular", "split"}};
    const auto with = [&](const char* memory) {
        Frame::Settings settings = adaptive;
        settings.emplace_back("refine.memory", memory);
        return Audited(scene, settings);
    };
    const Audited few = with("1");
    const Audited whole = with("1024");
    expectAccounted(few);
    EXPECT_GT(few.hits.photons, 20000U);
    EXPECT_EQ(few.hits.photons, whole.hits.photons);
    EXPECT_EQ(few.hits.right, whole.hits.right);
    EXPECT_EQ(few.hits.reachable, whole.hits.reachable);
    EXPECT_EQ(few.hits.missed, whole.hits.missed);
    EXPECT_EQ(few.hits.falseHits, whole.hits.falseHits);
}

// Two blocks of one glass that overlap: a pixel shows both fronts before the first back, and what
// lies between the fronts is inside. Where the second one was taken for the only one, 422 of 4096
// photons came out in the middle of the first block.
TEST(HitAudit, PartsOfOneGlassMayOverlap) {
    const Audited audited(numerics::sceneFromText(R"(
name = "overlap"
ambient_irradiance = [1, 1, 1]
[camera]
position = [0, 1.2, 3]
target = [0, 0.5, 0]
vertical_fov_degrees = 40
[[light]]
name = "sun"
type = "directional"
direction = [-0.8, -1, 0.1]
irradiance = 100
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[material]]
name = "floor"
type = "lambertian"
albedo = [0.5, 0.5, 0.5]
[[object]]
name = "left"
shape = "box"
material = "glass"
size = [0.8, 0.5, 0.5]
position = [-0.2, 0.6, 0]
[[object]]
name = "right"
shape = "box"
material = "glass"
size = [0.5, 0.5, 0.8]
position = [0.2, 0.65, 0]
[[object]]
name = "floor"
shape = "plane"
material = "floor"
size = [5, 5]
)"));
    EXPECT_GT(audited.hits.photons, 3000u);
    EXPECT_LT(audited.hits.falseHits.at("too_near"), audited.hits.photons / 100);
}

TEST(HitAudit, FindsEveryPhotonOfStillWaterInItsPlace) {
    const Audited audited(scene::loadScene("flat-water"));
    expectAccounted(audited);
    EXPECT_GT(audited.hits.photons, 3000u);
    EXPECT_EQ(audited.hits.exactHits, audited.hits.photons);
    EXPECT_EQ(audited.hits.right, audited.hits.photons);
    // The tangent plane of a flat floor is the floor: 32-bit rounding at some metres' distance.
    EXPECT_LT(audited.hits.meters.value().maximum, 1e-4);
}

TEST(HitAudit, TellsByHowMuchATracerErrs) {
    // Hits are moved at right angles to the view by so many pixels of their own depth.
    const scene::Scene scene = scene::loadScene("flat-water");
    spoiled = {{3.0f, 0.0f}, false};
    const Audited far(scene, {{"trace", "spoiled"}});
    expectAccounted(far);
    EXPECT_EQ(far.hits.right, 0u);
    EXPECT_EQ(far.hits.falseHits.at("displaced"), far.hits.photons);
    EXPECT_NEAR(far.hits.pixels.value().median, 3.0, 1e-3);  // 32-bit positions at 150 px
    spoiled = {{0.9f, 0.0f}, false};
    const Audited near(scene, {{"trace", "spoiled"}});
    EXPECT_EQ(near.hits.right, near.hits.photons);
    EXPECT_NEAR(near.hits.pixels.value().median, 0.9, 1e-3);
}

TEST(HitAudit, GivesWhatTheTracerDropsToTheTracer) {
    spoiled = {{0.0f, 0.0f}, true};
    const Audited audited(scene::loadScene("flat-water"), {{"trace", "spoiled"}});
    EXPECT_EQ(audited.hits.missed.at("tracer"), audited.hits.photons);
    EXPECT_EQ(audited.hits.agreementVisible().value(), 0.0);
    EXPECT_GT(audited.hits.missedWatts[transport::kAccountMissedByTracer], 0.0);
}

TEST(HitAudit, CountsAHitThatIsNoNumberAsWrong) {
    const scene::Scene scene = scene::loadScene("flat-water");
    spoiled = {{0.0f, 0.0f}, false, true};
    const Audited audited(scene, {{"trace", "spoiled"}});
    EXPECT_EQ(audited.hits.photons, 4096u);
    EXPECT_EQ(audited.hits.falseHits.at("not_a_number"), audited.hits.photons);
    EXPECT_EQ(audited.hits.agreement().value(), 0.0);
    EXPECT_FALSE(audited.hits.meters);
}

TEST(HitAudit, TellsApartWhatTheScreenCannotShow) {
    scene::Scene scene = scene::loadScene("flat-water");
    // One layer: the water hides the floor from the tracer, wherever the eye sees water.
    const Audited oneLayer(scene, {{"layers.count", "1"}});
    expectAccounted(oneLayer);
    EXPECT_GT(oneLayer.hits.missed.at("beyond_layers"), oneLayer.hits.photons / 2);
    EXPECT_GT(oneLayer.ledger.watts[transport::kAccountBeyondLastLayer], 0.0);

    // An eye that looks past the pool.
    scene.camera.target.x += 3.0;
    const Audited aside(scene);
    expectAccounted(aside);
    EXPECT_GT(aside.hits.missed.at("off_screen"), 0u);
    EXPECT_LT(aside.hits.agreement().value(), aside.hits.agreementVisible().value());
    EXPECT_GT(aside.hits.agreementVisible().value(), 0.99);
    EXPECT_GT(aside.ledger.watts[transport::kAccountOffScreen], 0.0);
}

TEST(HitAudit, SeesFalseHitsOfAnEpsilonThatIsTooLarge) {
    const Audited audited(scene::loadScene("flat-water"),
                          {{"trace.test", "epsilon"}, {"trace.epsilon", "0.5"}});
    expectAccounted(audited);
    std::uint64_t falseHits = 0;
    for (const auto& [cause, count] : audited.hits.falseHits)
        falseHits += count;
    EXPECT_GT(falseHits, audited.hits.photons / 2);
}

TEST(HitAudit, JudgesATracerOfPlanesByFlatReceiversWhereverTheyAre) {
    scene::Scene scene = scene::loadScene("flat-water");
    scene.camera.target.x += 3.0;  // half of the pool is off the screen
    const Audited aside(scene, {{"trace", "plane"}});
    expectAccounted(aside);
    EXPECT_GT(aside.hits.photons, 3000u);
    EXPECT_LT(aside.hits.visible, aside.hits.photons);
    EXPECT_EQ(aside.hits.reachable, aside.hits.photons);
    EXPECT_EQ(aside.hits.rightReachable, aside.hits.reachable);
    EXPECT_LT(aside.hits.meters.value().maximum, 1e-4);

    // The bunny is not flat: who should hit it does not count as reachable, and goes on.
    const Audited pool(scene::loadScene("pool"), {{"trace", "plane"}});
    expectAccounted(pool);
    EXPECT_LT(pool.hits.reachable, pool.hits.exactHits);
    EXPECT_EQ(pool.hits.rightReachable, pool.hits.reachable);
    EXPECT_GT(pool.hits.falseHits.at("tracer"), 10u);
    for (const auto& [cause, count] : pool.hits.missed)
        EXPECT_EQ(count, 0u) << cause;

    // What has gone through glass comes to the floor.
    const Audited ball(scene::loadScene("glass-sphere"),
                       {{"trace", "plane"}, {"specular", "two_interfaces"}});
    expectAccounted(ball);
    EXPECT_GT(ball.hits.reachable, ball.hits.photons / 2);
    EXPECT_EQ(ball.hits.rightReachable, ball.hits.reachable);
    EXPECT_EQ(ball.ledger.watts[transport::kAccountMissedByTracer], 0.0);
    // Whether or not the eye sees it there.
    EXPECT_EQ(ball.hits.missedWatts[transport::kAccountOffScreen], 0.0);
}

// Light that a ring has reflected comes to it again; the light's view shows where.
TEST(HitAudit, CountsPhotonsThatGoStraightThroughFurtherSurfaces) {
    const scene::Scene scene = scene::loadScene("glass-bunny");
    const auto audited = [&](const char* blockers) {
        return Audited(scene, {{"emit.photons", "128x128"},
                               {"specular", "two_interfaces"},
                               {"trace", "background"},
                               {"trace.blockers", blockers}});
    };
    const Audited passed = audited("0");
    const Audited stopped = audited("512");
    EXPECT_GT(passed.hits.throughSpecular, passed.hits.photons / 50);
    // Some leave the bunny where another part of it is, and are inside of that from the start.
    EXPECT_LT(stopped.hits.throughSpecular, passed.hits.throughSpecular / 4);
    EXPECT_GT(stopped.hits.right, passed.hits.right);
    for (const Audited* one : {&passed, &stopped})
        EXPECT_LT(std::abs(one->ledger.balance()), 1e-6);
}

TEST(HitAudit, FollowsPhotonsThroughEveryInteraction) {
    // Glass has two interfaces: the same photons are traced twice and more.
    const Audited audited(scene::loadScene("glass-sphere"));
    expectAccounted(audited);
    EXPECT_GT(audited.hits.photons, 2000u);
    EXPECT_GT(audited.hits.agreementVisible().value(), 0.9);
}

}  // namespace
}  // namespace kaustik::test
