// SPDX-License-Identifier: MIT
// The technique as a whole: what must not change its result, what it may take, and that nothing in
// it is not a number.
#include <fmt/format.h>
#include <cmath>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// A basin with waves, a ball on its floor and a glass ball above: two interfaces, hidden receivers,
// no mesh file.
scene::Scene wavyBasin() {
    return sceneFromText(R"(
name = "basin"
[camera]
position = [0.4, 2.6, 2.4]
target = [0, -0.4, 0]
vertical_fov_degrees = 45
[[light]]
name = "sun"
type = "directional"
direction = [0.2, -1, -0.1]
irradiance = 1000
[[material]]
name = "tiles"
type = "lambertian"
albedo = 0.7
pattern = "tiles"
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
absorption_per_meter = [0.3, 0.1, 0.05]
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "basin"
shape = "box"
material = "tiles"
size = [2, 1.2, 2]
position = [0, -0.5, 0]
inward = true
open = ["+y"]
[[object]]
name = "stone"
shape = "sphere"
material = "tiles"
radius = 0.25
segments = 48
position = [0.3, -0.85, 0.1]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.2
segments = 48
position = [-0.5, 0.5, 0]
[[object]]
name = "water"
shape = "water"
material = "water"
size = [2, 2]
cells = [48, 48]
waves = [{amplitude = 0.015, wavelength = 0.7, direction_degrees = 20},
         {amplitude = 0.01, wavelength = 0.45, direction_degrees = 100, phase = 1}]
)");
}

const Frame::Settings kSmall = {{"emit.photons", "64x64"}};

void expectBitEqual(const Texels& a, const Texels& b) {
    ASSERT_EQ(a.values.size(), b.values.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        different += a.values[i] != b.values[i];
    EXPECT_EQ(different, 0u);
}

bool isLit(const Texels& texels) {
    return std::any_of(texels.values.begin(), texels.values.end(),
                       [](float value) { return value > 0.0f; });
}

TEST(ScreenSpacePhotons, TheResultDoesNotDependOnTheRowsOfABatch) {
    const scene::Scene scene = wavyBasin();
    Frame::Settings lines = kSmall;
    lines.emplace_back("trace", "lines");
    const Frame whole(scene, 160, 120, lines, {"hits.position_1", "hits.flux_1"});
    ASSERT_TRUE(isLit(whole.causticIrradiance()));
    for (const char* rows : {"1000", "257", "64"}) {
        Frame::Settings settings = lines;
        settings.emplace_back("trace.lines.rows", rows);
        const Frame batched(scene, 160, 120, settings, {"hits.position_1", "hits.flux_1"});
        expectBitEqual(whole.read("hits.position_1"), batched.read("hits.position_1"));
        expectBitEqual(whole.read("hits.flux_1"), batched.read("hits.flux_1"));
        expectBitEqual(whole.causticIrradiance(), batched.causticIrradiance());
        EXPECT_EQ(whole.renderer().ledger().watts, batched.renderer().ledger().watts);
    }
}

TEST(ScreenSpacePhotons, TheLightDoesNotDependOnTheBatchesOfEmission) {
    const scene::Scene scene = wavyBasin();
    const Frame whole(scene, 160, 120, kSmall);
    ASSERT_TRUE(isLit(whole.causticIrradiance()));
    for (const char* batch : {"1000", "64"}) {
        SCOPED_TRACE(batch);
        Frame::Settings settings = kSmall;
        settings.emplace_back("emit.batch", batch);
        const Frame batched(scene, 160, 120, settings);
        expectBitEqual(whole.causticIrradiance(), batched.causticIrradiance());
        EXPECT_EQ(whole.renderer().ledger().watts, batched.renderer().ledger().watts);
        EXPECT_EQ(whole.renderer().ledger().events, batched.renderer().ledger().events);
    }
}

TEST(ScreenSpacePhotons, TwoRunsAreBitEqual) {
    const scene::Scene scene = wavyBasin();
    const Frame first(scene, 160, 120, kSmall, {"display", "view.radiance"});
    const Frame second(scene, 160, 120, kSmall, {"display", "view.radiance"});
    expectBitEqual(first.causticIrradiance(), second.causticIrradiance());
    expectBitEqual(first.read("view.radiance"), second.read("view.radiance"));
    expectBitEqual(first.read("display"), second.read("display"));
    EXPECT_EQ(first.renderer().ledger().watts, second.renderer().ledger().watts);
    EXPECT_EQ(first.renderer().ledger().events, second.renderer().ledger().events);
}

TEST(ScreenSpacePhotons, EveryWattIsAccountedFor) {
    for (const char* name : {"flat-water", "glass-sphere", "ring"}) {
        const scene::Scene scene = scene::loadScene(name);
        Frame frame(scene, 200, 150, kSmall);
        const EnergyLedger ledger = frame.renderer().ledger();
        EXPECT_GT(ledger.watts[transport::kAccountEmitted], 0.0) << name;
        EXPECT_GT(ledger.watts[transport::kAccountDeposited], 0.0) << name;
        EXPECT_LT(std::abs(ledger.balance()), 1e-4) << name;
        EXPECT_EQ(ledger.events[transport::kAccountNotANumber], 0u) << name;
    }
    Frame frame(wavyBasin(), 160, 120, kSmall);
    EXPECT_LT(std::abs(frame.renderer().ledger().balance()), 1e-4);
    EXPECT_GT(frame.renderer().ledger().watts[transport::kAccountAbsorbed], 0.0);
}

TEST(ScreenSpacePhotons, NoTextureHoldsWhatIsNotANumberAndNoneIsReadBeforeItIsWritten) {
    // Memory starts as NaN, so that whoever reads what nobody wrote shows.
    const scene::Scene scene = wavyBasin();
    std::vector<std::string> all;
    std::vector<std::string> lists;
    {
        const Frame frame(scene, 96, 72, kSmall);
        for (const std::string& name : frame.renderer().graph().resourceNames()) {
            const graph::ResourceDesc desc =
                frame.renderer().graph().descOf(frame.renderer().graph().find(name));
            if (std::holds_alternative<graph::TextureDesc>(desc)) all.push_back(name);
            if (name.rfind("photons.list", 0) == 0) lists.push_back(name);
        }
    }
    std::vector<std::string> saved = all;
    saved.insert(saved.end(), lists.begin(), lists.end());
    const Frame clean(scene, 96, 72, kSmall, saved);
    const Frame poisoned(scene, 96, 72, kSmall, saved, true);
    for (const std::string& name : all) {
        // What the reduce leaves right of the longest line is memory that nothing reads.
        if (name.rfind("trace.rows_", 0) == 0) continue;
        EXPECT_EQ(poisoned.countNotFinite(name), 0u) << name;
    }
    expectBitEqual(clean.causticIrradiance(), poisoned.causticIrradiance());
    expectBitEqual(clean.read("display"), poisoned.read("display"));
}

TEST(ScreenSpacePhotons, RowMemoryStaysWithinItsParameterFrom64To2048PhotonsASide) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Registry registry = registerAll();
    for (const int side : {64, 256, 1024, 2048}) {
        for (const int mebibytes : {8, 64}) {
            RenderSettings settings;
            settings.technique = registry.findTechnique("screen_space_photons");
            settings.params = registry.makeParams(settings.technique);
            settings.params.set("emit.photons", fmt::format("{0}x{0}", side), "test");
            settings.params.set("trace", "lines", "test");
            settings.params.set("trace.lines.memory", std::to_string(mebibytes), "test");
            Renderer renderer(context(), registry, scene, settings);
            // Only compiled: what memory it would take is known before any is taken.
            const graph::Compiled compiled = renderer.compile(Purpose::picture);
            std::size_t bytes = 0;
            for (const graph::Slot& slot : compiled.slots) {
                if (slot.firstName.rfind("trace.rows", 0) == 0) bytes += graph::bytesOf(slot.desc);
            }
            EXPECT_GT(bytes, 0u);
            EXPECT_LE(bytes, static_cast<std::size_t>(mebibytes) << 20) << side;
        }
    }
}

TEST(ScreenSpacePhotons, AHitOfThePaperEpsilonLiesWithinEpsilonOfTheSurface) {
    const scene::Scene scene = scene::loadScene("flat-water");
    // At this size a pixel's step changes the depth of these steep rays by several centimetres: the
    // paper's 0.01 m would let nearly all of them step through the floor.
    const Frame frame(
        scene, 200, 150,
        {{"emit.photons", "64x64"}, {"trace.test", "epsilon"}, {"trace.epsilon", "0.05"}},
        {"hits.position_1", "hits.flux_1"});
    const Texels positions = frame.read("hits.position_1");
    const Texels fluxes = frame.read("hits.flux_1");
    int hits = 0;
    for (int y = 0; y < positions.height; ++y) {
        for (int x = 0; x < positions.width; ++x) {
            if (fluxes.at(x, y, 3) != static_cast<float>(transport::kFateReceiver)) continue;
            ++hits;
            const double height = frame.toWorld(positions.rgb(x, y)).y;
            // Along the view axis, which hits the floor at more than 45 degrees here.
            const bool isNearFloor = std::abs(height + 1.2) < 0.05 * 1.42;
            const glm::dvec3 world = frame.toWorld(positions.rgb(x, y));
            const bool isNearWall = std::abs(world.x) > 1.95 || std::abs(world.z) > 1.45;
            EXPECT_TRUE(isNearFloor || isNearWall) << height;
        }
    }
    EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace kaustik::test
