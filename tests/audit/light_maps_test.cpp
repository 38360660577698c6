// SPDX-License-Identifier: MIT
// trace.background against the reference: of what a photon's light sees it finds nearly all, and
// what it cannot find is told apart by cause, in watts.
#include <cmath>

#include "framework/audit/hit_audit.h"
#include "framework/reference/reference.h"
#include "framework/scene/files/scene_file.h"
#include "tests/audit/shipped_scenes.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace transport;

struct Audited {
    audit::HitAudit hits;
    EnergyLedger ledger;
};

Audited audited(const std::string& name) {
    const scene::Scene scene = scene::loadScene(name);
    const Registry registry = registerAll();
    RenderSettings settings;
    settings.technique = registry.findTechnique("caustic_map");
    settings.params = registry.makeParams(settings.technique);
    settings.params.set("emit.photons", "64x64", "test");
    settings.width = 160;
    settings.height = 120;
    Renderer renderer(context(), registry, scene, std::move(settings));
    renderer.build(Purpose::audit);
    gl::PassTimer timer(gl::TimerMode::finish);
    renderer.renderFrame(timer);
    const reference::EmbreeScene embree(scene);
    Audited result{audit::auditHits(renderer, embree), {}};
    // With what the photons themselves emit: the grid's own error is another test's.
    result.ledger =
        audit::resolveLedger(renderer, result.hits, renderer.ledger().watts[kAccountEmitted]);
    return result;
}

class LightsMap : public testing::TestWithParam<std::string> {};

TEST_P(LightsMap, IsSearchedForAllThatItsLightSees) {
    const Audited result = audited(GetParam());
    ASSERT_GT(result.hits.reachable, 300u);
    RecordProperty("agreement_reachable_permille",
                   static_cast<int>(1000.0 * static_cast<double>(result.hits.rightReachable) /
                                    static_cast<double>(result.hits.reachable)));
    EXPECT_GE(static_cast<double>(result.hits.rightReachable),
              0.99 * static_cast<double>(result.hits.reachable));
    EXPECT_LT(std::abs(result.ledger.balance()), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Every, LightsMap,
                         testing::Values("blocker", "pool", "glass-sphere", "ring"), nameOfScene);

TEST(WhatALightDoesNotSee, IsToldApartInWatts) {
    // The focus lies on the back of the rod, which the lamp does not see.
    const Audited blocker = audited("blocker");
    EXPECT_GT(blocker.ledger.watts[kAccountHiddenInMap],
              0.01 * blocker.ledger.watts[kAccountEmitted]);
    const Audited pool = audited("pool-reflections");
    RecordProperty("pool_hidden_mw",
                   static_cast<int>(1000.0 * pool.ledger.watts[kAccountHiddenInMap]));
    RecordProperty("pool_outside_mw",
                   static_cast<int>(1000.0 * pool.ledger.watts[kAccountOutsideMap]));
    EXPECT_GT(pool.ledger.watts[kAccountHiddenInMap] + pool.ledger.watts[kAccountOutsideMap], 0.0);
    for (const Audited* one : {&blocker, &pool}) {
        EXPECT_EQ(one->ledger.watts[kAccountUnresolved], 0.0);
        EXPECT_LT(std::abs(one->ledger.balance()), 1e-6);
    }
}

}  // namespace
}  // namespace kaustik::test
