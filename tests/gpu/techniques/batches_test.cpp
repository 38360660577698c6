// SPDX-License-Identifier: MIT
// Photons may come all at once or in batches (emit.batch, the memory of a traversal): the light
// that is stored and the accounts are the same to the bit, at the borders of batches too.
#include <algorithm>
#include <string>
#include <vector>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

struct Mixture {
    const char* name;
    const char* scene;
    Frame::Settings settings;
};

class Batches : public testing::TestWithParam<Mixture> {};

TEST_P(Batches, OfAnySizeAreTheLightOfAllPhotonsAtOnce) {
    const scene::Scene scene = scene::loadScene(GetParam().scene);
    const auto render = [&](const char* batch) {
        Frame::Settings settings = {{"emit.photons", "53x48"}, {"emit.batch", batch}};
        settings.insert(settings.end(), GetParam().settings.begin(), GetParam().settings.end());
        return Frame(scene, 96, 72, settings);
    };
    const Frame whole = render("4194304");
    const Texels expected = whole.causticIrradiance();
    const EnergyLedger ledger = whole.renderer().ledger();
    EXPECT_GT(expected.sum(), 0.0);
    // Rows of one light; a third, and as few as may be.
    for (const char* batch : {"849", "1"}) {
        SCOPED_TRACE(batch);
        const Frame parts = render(batch);
        EXPECT_EQ(expected.values, parts.causticIrradiance().values);
        EXPECT_EQ(ledger.watts, parts.renderer().ledger().watts);
        EXPECT_EQ(ledger.events, parts.renderer().ledger().events);
    }
}

const Mixture kMixtures[] = {
    {"Triangles", "pool", {}},
    // From the second interaction on one branch is drawn.
    {"Draws", "glossy-table", {{"specular", "split"}}},
    {"Vertices", "pool", {{"reconstruct.triangles.shading", "vertices"}}},
    {"Merged", "flat-water", {{"reconstruct.triangles.merge", "16"}}},
    {"Discarded", "pool", {{"reconstruct.triangles.unjoined", "discard"}}},
    {"Deferred", "glass-sphere", {{"emit", "deferred"}, {"emit.deferred.size", "128"}}},
    {"OfAMesh", "pool", {{"emit", "vertices"}}},
    {"Hierarchical", "glass-sphere", {{"driver", "hierarchical"}}},
    {"InTheLight",
     "glass-sphere",
     {{"reconstruct.space", "light"}, {"reconstruct.map_size", "128"}, {"gather", "project"}}},
};

INSTANTIATE_TEST_SUITE_P(Every, Batches, testing::ValuesIn(kMixtures),
                         [](const testing::TestParamInfo<Mixture>& mixture) {
                             return std::string(mixture.param.name);
                         });

}  // namespace
}  // namespace kaustik::test
