// SPDX-License-Identifier: MIT
// Techniques' second rows: what their papers have to the letter.
#include <string>

#include "framework/core/error.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/techniques/caustic_map_frame.h"

namespace kaustik::test {
namespace {

using namespace transport;

TEST(AsPublished, IsARowOfItsOwnForEveryTechniqueOfAPaper) {
    const Registry registry = registerAll();
    for (const Technique& technique : registry.techniques()) {
        SCOPED_TRACE(technique.name);
        if (technique.asPublished.empty()) {
            EXPECT_TRUE(technique.name == "raytraced" || technique.name == "exact_rays");
            EXPECT_THROW(static_cast<void>(registry.findTechnique(technique.name, true)),
                         ConfigError);
            continue;
        }
        const Technique published = registry.findTechnique(technique.name, true);
        EXPECT_TRUE(published.isAsPublished);
        // Throws for a name or a value that does not exist.
        const params::ParamSet params = registry.makeParams(published);
        const params::ParamSet defaults = registry.makeParams(technique);
        for (const auto& [name, value] : technique.asPublished) {
            EXPECT_NE(params.find(name).text(), defaults.find(name).text()) << name;
            EXPECT_FALSE(params.isSetByUser(name)) << name;
        }
    }
}

// Light that has entered a ball leaves it where it first comes to its surface again: at the same
// angle inside, so that it cannot be reflected totally.
TEST(AsPublished, LosesABallsLightToItsEstimatesAndSaysSo) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const auto lost = [&](const char* technique, const char* distance, std::uint32_t account) {
        const std::string node =
            technique == std::string("caustic_map") ? "two_interfaces" : "deferred";
        const MapFrame frame(scene, technique,
                             {{"specular." + node + ".distance", distance},
                              {"emit.photons", "128x128"},
                              {"specular." + node + ".size", "256"}});
        return frame.watts(account) / frame.watts(kAccountEmitted);
    };
    for (const char* technique : {"caustic_map", "hierarchical_caustic_map"}) {
        SCOPED_TRACE(technique);
        // 15.6 % at 512² photons. Next to the rim, where all but all is reflected, a few cells are
        // totally reflected by the search too.
        EXPECT_NEAR(lost(technique, "estimates", kAccountAsPublished), 0.156, 0.02);
        EXPECT_EQ(lost(technique, "estimates", kAccountInternalReflectionLimit), 0.0);
        EXPECT_EQ(lost(technique, "search", kAccountAsPublished), 0.0);
        EXPECT_LT(lost(technique, "search", kAccountInternalReflectionLimit), 1e-3);
    }
}

TEST(AsPublished, IsNotTheDefault) {
    const Registry registry = registerAll();
    for (const Technique& technique : registry.techniques()) {
        const params::ParamSet params = registry.makeParams(technique);
        for (const char* node : {"specular.two_interfaces", "specular.deferred", "view.image_space",
                                 "view.deferred"}) {
            EXPECT_EQ(params.find(std::string(node) + ".distance").text(), "search")
                << technique.name << " " << node;
        }
    }
}

}  // namespace
}  // namespace kaustik::test
