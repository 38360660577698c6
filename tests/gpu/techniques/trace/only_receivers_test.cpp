// SPDX-License-Identifier: MIT
// Tracers that find receivers alone: photons that would be inside of a body are refused before
// anything is rendered, and light that comes to another specular surface on its way is stopped
// there, where its light sees that.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/pipeline/ledger.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 50.0, 0.01};
const std::string kSun = sun({0.0, -1.0, 0.0});
const std::string kFloor = floorPlane("floor", "grey", 8, {0, 0, 0});

std::string ball(const std::string& name, const std::string& material, const glm::dvec3& position,
                 double radius) {
    return object(name, "sphere", material, position,
                  fmt::format("radius = {}\nsegments = 64", number(radius)));
}

// Light that leaves the upper ball near its rim goes far to the other side; the lower one, next to
// it as the sun sees them, has some of it in its way.
const std::string kTwoBalls =
    ball("upper", "glass", {0, 1.4, 0}, 0.4) + ball("lower", "glass", {0.75, 0.35, 0}, 0.3);

std::vector<std::string> tracersOfReceivers() {
    std::vector<std::string> names;
    for (const Registry::Node& node : registry().nodes()) {
        if (node.stage == TraceStage::name &&
            registry().traits<TraceStage>(node.name).onlyReceivers)
            names.push_back(node.name);
    }
    return names;
}

numerics::Frame render(const std::string& parts, const Settings& settings) {
    Settings all = {{"emit.photons", "128x128"}, {"reconstruct.map_size", "256"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return {context(), registry(), makeScene(kAbove, kSun + kFloor + parts),
            registry().findTechnique("caustic_map"), FrameRequest{64, 48, all}};
}

double stoppedShare(const numerics::Frame& frame) {
    const EnergyLedger ledger = frame.renderer().ledger();
    EXPECT_LT(std::abs(ledger.balance()), 1e-6);
    return ledger.watts[kAccountBounceLimit] / ledger.watts[kAccountEmitted];
}

class OnlyReceivers : public testing::TestWithParam<std::string> {};

TEST_P(OnlyReceivers, AreRefusedWherePhotonsMayBeInsideOfBodies) {
    for (const char* specular : {"auto", "interface", "split"}) {
        SCOPED_TRACE(specular);
        try {
            render(ball("marble", "glass", {0, 1, 0}, 0.4),
                   {{"trace", GetParam()}, {"specular", specular}});
            FAIL() << "renders";
        } catch (const ConfigError& error) {
            const std::string said = error.what();
            for (const std::string& part :
                 {"trace." + GetParam(), std::string("specular.") + specular,
                  std::string("'marble'"), std::string("take specular=two_interfaces or"),
                  std::string("trace=lines")})
                EXPECT_NE(said.find(part), std::string::npos) << said;
        }
    }
}

TEST_P(OnlyReceivers, ServeSheetsAndMirrorsAndWhatGoesThroughBodies) {
    const std::string water = floorPlane("water", "water", 2, {0, 0.5, 0});
    for (const char* specular : {"auto", "interface", "split", "two_interfaces", "deferred"}) {
        for (const std::string& parts : {water, ball("mirror", "mirror", {0, 1, 0}, 0.4)}) {
            const numerics::Frame frame =
                render(parts, {{"trace", GetParam()}, {"specular", specular}});
            EXPECT_GT(frame.renderer().ledger().watts[kAccountDeposited], 0.0) << specular;
            EXPECT_EQ(stoppedShare(frame), 0.0) << specular;
        }
    }
    for (const char* specular : {"two_interfaces", "deferred"}) {
        const numerics::Frame frame = render(ball("marble", "glass", {0, 1, 0}, 0.4),
                                             {{"trace", GetParam()}, {"specular", specular}});
        EXPECT_GT(frame.renderer().ledger().watts[kAccountDeposited], 0.0) << specular;
        // A convex body alone stops nothing of what has left it, and nobody looks.
        EXPECT_EQ(stoppedShare(frame), 0.0) << specular;
    }
}

TEST_P(OnlyReceivers, StopLightAtFurtherBodiesAsExactRaysDo) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    const Settings beyond = {{"specular.two_interfaces.distance", "search"}};
    const auto sharedBy = [&](const std::string& tracer, const char* blockers) {
        Settings settings = beyond;
        settings.insert(settings.end(), {{"trace", tracer}, {"trace.blockers", blockers}});
        return stoppedShare(render(kTwoBalls, settings));
    };
    const double exact = sharedBy("raytraced", "512");
    EXPECT_GT(exact, 0.005);
    // Most of them meet the lower ball near its outline, which texels of 3 mm of the light's view
    // resolve by so much, and of 0.7 mm by so much.
    EXPECT_NEAR(sharedBy(GetParam(), "512"), exact, 0.06 * exact);
    EXPECT_NEAR(sharedBy(GetParam(), "2048"), exact, 0.02 * exact);
    EXPECT_EQ(sharedBy(GetParam(), "0"), 0.0);
}

// What a mirror sends to another one is followed there, if the specular node goes on.
TEST_P(OnlyReceivers, HandLightThatComesToAnotherMirrorOn) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    const auto mirror = [](const char* name, const glm::dvec3& at, double degrees) {
        return object(name, "plane", "mirror", at,
                      fmt::format("size = [1, 1]\nrotation_degrees = [0, 0, {}]", number(degrees)));
    };
    // Down, to the right, and down again.
    const std::string parts =
        mirror("first", {-1, 1.5, 0}, -45) + mirror("second", {1, 1.5, 0}, 135);
    const auto stored = [&](const std::string& tracer) {
        return render(parts, {{"trace", tracer}, {"specular", "interface"}})
            .renderer()
            .ledger()
            .watts[kAccountArrived];
    };
    const double exact = stored("raytraced");
    EXPECT_GT(exact, 100.0);
    EXPECT_NEAR(stored(GetParam()), exact, 0.02 * exact);
}

INSTANTIATE_TEST_SUITE_P(Each, OnlyReceivers, testing::ValuesIn(tracersOfReceivers()),
                         [](const testing::TestParamInfo<std::string>& tracer) {
                             return tracer.param;
                         });

}  // namespace
}  // namespace kaustik::test
