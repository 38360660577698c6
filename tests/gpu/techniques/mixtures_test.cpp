// SPDX-License-Identifier: MIT
// Any mixture of nodes renders, with finite pixels and a ledger that balances, or says in one
// sentence which node cannot and what to take instead. The scene has a ball of glass, water, two
// lights of different kinds and a glossy receiver.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "framework/core/error.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

const scene::Scene& mixedScene() {
    static const scene::Scene scene = sceneFromText(R"(
name = "mixed"
[camera]
position = [1.8, 2.2, 3.2]
target = [0, 0.2, 0]
[[light]]
name = "sun"
type = "directional"
direction = [0.3, -1, -0.2]
irradiance = 800
[[light]]
name = "spot"
type = "spot"
position = [-1.5, 4.5, 1]
direction = [1.3, -4.3, -1]
inner_cone_degrees = 22
outer_cone_degrees = 30
intensity = 1200
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "polished"
type = "glossy"
albedo = 0.4
specular = 0.3
exponent = 40
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [5, 5]
[[object]]
name = "plate"
shape = "plane"
material = "polished"
size = [1.4, 1.4]
position = [0.5, 0.02, 0.3]
[[object]]
name = "pond"
shape = "plane"
material = "water"
size = [0.9, 0.9]
cells = [8, 8]
position = [-0.8, 0.3, 0.2]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.4
segments = 24
position = [0.5, 0.8, 0.1]
)");
    return scene;
}

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

std::vector<std::string> nodesOf(const std::string& stage) {
    std::vector<std::string> names;
    for (const Registry::Node& node : registry().nodes()) {
        if (node.stage == stage) names.push_back(node.name);
    }
    return names;
}

std::string textOf(const Settings& settings) {
    std::string text;
    for (const auto& [name, value] : settings)
        text += (text.empty() ? "" : ", ") + name + "=" + value;
    return text;
}

// One sentence that says what to take instead.
void expectHelpful(const std::string& message) {
    EXPECT_TRUE(message.ends_with('.')) << message;
    EXPECT_TRUE(message.find("take ") != std::string::npos) << message;
    EXPECT_TRUE(std::any_of(registry().nodes().begin(), registry().nodes().end(),
                            [&](const Registry::Node& node) {
                                return message.find(node.stage + "." + node.name) !=
                                       std::string::npos;
                            }))
        << message;
}

// Whether it renders; anything thrown but a ConfigError fails the test.
bool rendersOrExplains(const Settings& mixture) {
    SCOPED_TRACE(textOf(mixture));
    Settings settings = {{"emit.photons", "32x32"},      {"refine.finest", "64"},
                         {"refine.start", "16"},         {"refine.check", "32"},
                         {"emit.deferred.size", "64"},   {"specular.deferred.size", "64"},
                         {"reconstruct.map_size", "64"}, {"around.cubes.size", "32"}};
    settings.insert(settings.end(), mixture.begin(), mixture.end());
    try {
        const numerics::Frame frame(
            context(), registry(), mixedScene(), registry().findTechnique("screen_space_photons"),
            {.width = 64, .height = 48, .settings = settings, .keepsAll = true, .poison = true});
        for (const std::string& name : frame.textureNames()) {
            // Longest rows of rays hold what nothing reads.
            if (name.starts_with("trace.rows_")) continue;
            EXPECT_EQ(frame.countNotFinite(name), 0u) << name;
        }
        const std::vector<float> display =
            frame.renderer().texture(frame.renderer().outputs().picture.display).read();
        EXPECT_TRUE(std::all_of(display.begin(), display.end(),
                                [](float value) { return std::isfinite(value); }));
        // trace.all_hits lights more than there is.
        const bool isRight = std::none_of(mixture.begin(), mixture.end(), [](const auto& setting) {
            return setting.second == "all_hits";
        });
        if (isRight) {
            EXPECT_LT(std::abs(frame.renderer().ledger().balance()), 1e-6);
        }
        return true;
    } catch (const ConfigError& error) {
        expectHelpful(error.what());
        std::cout << "  " << textOf(mixture) << ": " << error.what() << '\n';
    } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
    }
    return false;
}

Settings storedIn(const std::string& space, const std::string& reconstruct) {
    Settings settings = {{"reconstruct", reconstruct},
                         {"reconstruct.space", space},
                         {"gather", space == "light"  ? "project"
                                    : space == "cube" ? "cube"
                                                      : "screen"}};
    const std::string filter = registry().traits<ReconstructStage>(reconstruct).filter;
    if (!filter.empty()) settings.emplace_back("filter", filter);
    return settings;
}

class EveryTracer : public testing::TestWithParam<std::string> {};

TEST_P(EveryTracer, FeedsEveryReconstructionInEverySpace) {
    int rendered = 0;
    int pairs = 0;
    for (const char* space : {"screen", "light", "cube"}) {
        for (const std::string& reconstruct : nodesOf(ReconstructStage::name)) {
            Settings settings = storedIn(space, reconstruct);
            settings.emplace_back("trace", GetParam());
            // Of what would be inside of the ball these find nothing.
            if (registry().traits<TraceStage>(GetParam()).onlyReceivers)
                settings.emplace_back("specular", "two_interfaces");
            ++pairs;
            rendered += rendersOrExplains(settings) ? 1 : 0;
        }
    }
    EXPECT_EQ(rendered, pairs);
}

INSTANTIATE_TEST_SUITE_P(Mixtures, EveryTracer, testing::ValuesIn(nodesOf(TraceStage::name)),
                         [](const testing::TestParamInfo<std::string>& tracer) {
                             return tracer.param;
                         });

class EveryNode : public testing::TestWithParam<std::string> {};

TEST_P(EveryNode, OfTheStageFitsIntoEverySpace) {
    int rendered = 0;
    for (const std::string& node : nodesOf(GetParam())) {
        for (const auto& [space, reconstruct, tracer] :
             {std::tuple("screen", "sprites", "hierarchical"),
              std::tuple("screen", "lens", "background"),
              std::tuple("light", "fixed", "hierarchical"),
              std::tuple("light", "four_radii", "background"),
              std::tuple("light", "levels", "background"),
              std::tuple("light", "triangles", "background"),
              std::tuple("cube", "triangles", "secant"), std::tuple("cube", "fixed", "secant")}) {
            Settings settings = storedIn(space, reconstruct);
            settings.emplace_back("trace", tracer);
            if (registry().traits<TraceStage>(tracer).onlyReceivers)
                settings.emplace_back("specular", "two_interfaces");
            settings.emplace_back(GetParam(), node);  // the last one counts
            if (node == "adaptive" || GetParam() == std::string("refine")) {
                settings.emplace_back("driver", "adaptive");
                settings.emplace_back("emit", "deferred");
            }
            rendered += rendersOrExplains(settings) ? 1 : 0;
        }
    }
    EXPECT_GT(rendered, 2);
}

INSTANTIATE_TEST_SUITE_P(Mixtures, EveryNode,
                         testing::Values("driver", "refine", "specular", "emit", "filter", "gather",
                                         "temporal", "shadow", "media"),
                         [](const testing::TestParamInfo<std::string>& stage) {
                             return stage.param;
                         });

}  // namespace
}  // namespace kaustik::test
