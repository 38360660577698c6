// SPDX-License-Identifier: MIT
// Which filters and gathers read which maps of light: of all reconstructions, filters, gathers and
// spaces those that fit are built, and all others are refused before anything runs, in a sentence
// whose advice works.
#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>

#include "framework/core/error.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

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

// By reconstruction what reads it; of all others a map is one, which may be blurred.
const std::map<std::string, std::set<std::string>> kFilters{
    {"four_radii", {"blend"}}, {"levels", {"levels"}}, {"multi_level", {"level_sum"}}};
const std::set<std::string> kOfOne{"none", "blur"};
const std::map<std::string, std::string> kGathers{
    {"screen", "screen"}, {"light", "project"}, {"cube", "cube"}};

struct Mixture {
    std::string reconstruct;
    std::string filter;
    std::string gather;
    std::string space;
    [[nodiscard]] bool fits() const {
        const auto own = kFilters.find(reconstruct);
        const std::set<std::string>& filters = own == kFilters.end() ? kOfOne : own->second;
        return filters.count(filter) > 0 && kGathers.at(space) == gather;
    }
    [[nodiscard]] Settings settings() const {
        return {{"emit.photons", "32x32"},        {"reconstruct.map_size", "64"},
                {"around.cubes.size", "32"},      {"reconstruct", reconstruct},
                {"reconstruct.space", space},     {"filter", filter},
                {"filter.levels.from", "splats"}, {"gather", gather}};
    }
    [[nodiscard]] std::string text() const {
        return fmt::format("reconstruct={} filter={} gather={} space={}", reconstruct, filter,
                           gather, space);
    }
};

class Maps : public testing::TestWithParam<const char*> {
  protected:
    // "" where the graph is built.
    std::string refusalOf(const Settings& settings) {
        const Technique& technique = registry().findTechnique("screen_space_photons");
        RenderSettings wanted{technique, registry().makeParams(technique), {}, {}, 64, 48};
        for (const auto& [name, value] : settings)
            wanted.params.set(name, value, "the test");
        try {
            if (renderer_) {
                renderer_->update(wanted);
            } else {
                renderer_ = std::make_unique<Renderer>(context(), registry(), scene_, wanted);
            }
            static_cast<void>(renderer_->compile(Purpose::picture));
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "";
    }
    // With what a refusal says to take first, as it stands there.
    static Settings followed(Settings settings, const std::string& refusal) {
        static const std::regex advice("take ([a-z_.]+)=([a-z_]+)");
        std::smatch found;
        if (std::regex_search(refusal, found, advice)) settings.emplace_back(found[1], found[2]);
        return settings;
    }

    const scene::Scene scene_ = scene::loadScene(GetParam());
    std::unique_ptr<Renderer> renderer_;
};

TEST_P(Maps, AreReadByWhatFitsAndRefusedByAllElse) {
    int fitting = 0;
    for (const std::string& reconstruct : nodesOf(ReconstructStage::name)) {
        for (const std::string& filter : nodesOf(FilterStage::name)) {
            for (const std::string& gather : nodesOf(GatherStage::name)) {
                for (const char* space : {"screen", "light", "cube"}) {
                    const Mixture mixture{reconstruct, filter, gather, space};
                    SCOPED_TRACE(mixture.text());
                    const std::string refusal = refusalOf(mixture.settings());
                    EXPECT_EQ(refusal.empty(), mixture.fits()) << refusal;
                    fitting += mixture.fits() ? 1 : 0;
                    if (refusal.empty()) continue;
                    EXPECT_TRUE(refusal.starts_with("filter." + filter + " ") ||
                                refusal.starts_with("gather." + gather + " "))
                        << refusal;
                    // One sentence, of which the advice is right: twice where both are wrong.
                    EXPECT_TRUE(refusal.ends_with('.')) << refusal;
                    const Settings once = followed(mixture.settings(), refusal);
                    const std::string next = refusalOf(once);
                    EXPECT_EQ(next.empty() ? "" : refusalOf(followed(once, next)), "") << refusal;
                }
            }
        }
    }
    EXPECT_GT(fitting, 30);
}

INSTANTIATE_TEST_SUITE_P(Of, Maps, testing::Values("flat-water", "glossy-table"),
                         [](const auto& tested) {
                             return std::string(tested.param) == "flat-water" ? "MattReceivers"
                                                                              : "GlossyReceivers";
                         });

// The levels of a mip chain are taken from what reconstruct.levels has stored, and from no other.
TEST(LevelsFromAMipChain, KeepTheLedgerAndRefuseOtherMaps) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const auto settings = [](const char* reconstruct) {
        return Settings{{"emit.photons", "64x64"},
                        {"reconstruct.map_size", "128"},
                        {"reconstruct", reconstruct},
                        {"filter", "levels"},
                        {"filter.levels.from", "mip"}};
    };
    for (const char* other : {"multi_level", "fixed", "four_radii"}) {
        EXPECT_THROW(Frame(scene, 64, 48, settings(other), {}, false, "caustic_map"), ConfigError)
            << other;
    }
    const Frame frame(scene, 64, 48, settings("levels"), {}, true, "caustic_map");
    EXPECT_LT(std::abs(frame.renderer().ledger().balance()), 1e-6);
    EXPECT_EQ(frame.countNotFinite("caustic.irradiance"), 0u);
}

}  // namespace
}  // namespace kaustik::test
