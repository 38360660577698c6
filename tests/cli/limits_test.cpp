// SPDX-License-Identifier: MIT
// `limits` in report.json: every cap that was reached, and what was lost to it.
#include <cmath>
#include <map>

#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Limits : public CommandLine {
  protected:
    // The entries of `limits` of a small run of the scene, by their names.
    std::map<std::string, json> limitsOf(const std::string& scene,
                                         const std::vector<std::string>& settings,
                                         const std::vector<std::string>& disabled = {}) {
        static_cast<void>(folder.file("wavy.toml", kWavyWater));
        std::vector<std::string> arguments =
            smallRun(scene, {"--technique", "screen_space_photons", "--out", "out"});
        for (const std::string& setting : settings)
            arguments.insert(arguments.end(), {"--set", setting});
        for (const std::string& pass : disabled)
            arguments.insert(arguments.end(), {"--disable", pass});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        std::map<std::string, json> limits;
        const json entries = report().at("limits");
        for (const json& limit : entries)
            EXPECT_TRUE(limits.emplace(limit.at("limit"), limit).second) << "twice: " << limit;
        return limits;
    }
    // The one of that name; that there is none fails the test.
    json limitOf(const std::string& name, const std::string& scene,
                 const std::vector<std::string>& settings) {
        const std::map<std::string, json> limits = limitsOf(scene, settings);
        const auto found = limits.find(name);
        if (found != limits.end()) return found->second;
        ADD_FAILURE() << name << " is not in " << report().at("limits");
        return {};
    }
    bool isReached(const std::string& name, const std::string& scene,
                   const std::vector<std::string>& settings) {
        return limitsOf(scene, settings).contains(name);
    }
};

TEST_F(Limits, SayWhatLayersWereSkipped) {
    const auto limits = limitsOf("wavy.toml", {"layers.count=1"});
    ASSERT_EQ(limits.size(), 1u) << report().at("limits");
    const json& limit = limits.at("layers.count");
    const json layers = report().at("layers");
    EXPECT_EQ(limit.at("unit"), "layers");
    EXPECT_EQ(limit.at("value"), 1);
    EXPECT_EQ(limit.at("needed"), layers.at("complexity"));
    EXPECT_NE(
        limit.at("lost").get<std::string>().find(layers.at("fragments_left_out").dump() + " of "),
        std::string::npos)
        << limit;
    EXPECT_EQ(layers.at("allowed"), 1);
    EXPECT_GT(layers.at("fragments_left_out"), 0);
}

TEST_F(Limits, CountTheBatchesOfALimitedMemory) {
    const auto limits = limitsOf("wavy.toml", {"trace=lines", "lines.rows=64"});
    ASSERT_EQ(limits.size(), 1u) << report().at("limits");
    const json& limit = limits.at("trace.lines.rows");
    EXPECT_EQ(limit.at("unit"), "rows");
    EXPECT_EQ(limit.at("value"), 64);
    EXPECT_EQ(limit.at("needed"), 32 * 32);
    EXPECT_TRUE(limit.at("lost").get<std::string>().starts_with("16 passes")) << limit;
    EXPECT_EQ(limit.at("lost_w"), 0.0);

    // A row of 16,384 texels and its halves take 448 KiB: two are what a mebibyte holds.
    const json memory = limitOf("trace.lines.memory", "wavy.toml",
                                {"trace=lines", "trace.lines.width=16384", "trace.lines.memory=1"});
    EXPECT_EQ(memory.at("unit"), "MiB");
    EXPECT_EQ(memory.at("value"), 1);
    EXPECT_GT(memory.at("needed"), 1);
}

TEST_F(Limits, NameTheStepsOfEveryTracer) {
    const std::vector<std::pair<std::string, std::string>> caps = {
        {"march", "steps"},        {"march_compute", "steps"},
        {"hierarchical", "steps"}, {"hierarchical_compute", "steps"},
        {"all_hits", "steps"},     {"lines", "width"}};
    for (const auto& [tracer, cap] : caps) {
        const std::string name = "trace." + tracer + "." + cap;
        const json limit = limitOf(name, "glass-sphere", {"trace=" + tracer, name + "=16"});
        EXPECT_EQ(limit.at("unit"), "steps") << name;
        EXPECT_EQ(limit.at("value"), 16) << name;
        EXPECT_EQ(limit.at("needed"), 64) << name;  // the picture's longer side
        EXPECT_FALSE(isReached(name, "glass-sphere", {"trace=" + tracer, name + "=64"}));
    }
    EXPECT_TRUE(report().at("warnings").empty()) << report().at("warnings");
}

TEST_F(Limits, CountSplatsThatAreCutOff) {
    EXPECT_FALSE(isReached("reconstruct.sprites.reach", "wavy.toml",
                           {"reconstruct=sprites", "sprites.maximum=8"}));
    const json limit = limitOf(
        "reconstruct.sprites.reach", "wavy.toml",
        {"reconstruct=sprites", "sprites.maximum=100", "sprites.radius=1", "sprites.reach=20"});
    EXPECT_EQ(limit.at("unit"), "px");
    EXPECT_EQ(limit.at("value"), 20);
    EXPECT_GT(limit.at("needed"), 20.0);
    EXPECT_EQ(limit.at("lost_w"), 0.0);
}

TEST_F(Limits, TakeOneTracingABounceForNoBatches) {
    const auto limits = limitsOf("glass-sphere", {"trace=lines"});
    EXPECT_GT(passNamed(report(), "trace.lines").at("repeats"), 1);
    EXPECT_FALSE(limits.contains("trace.lines.rows")) << report().at("limits");
    EXPECT_FALSE(limits.contains("trace.lines.memory")) << report().at("limits");
    // What goes to and fro in the sphere is cut off.
    ASSERT_TRUE(limits.contains("specular.bounces")) << report().at("limits");
    EXPECT_EQ(limits.at("specular.bounces").at("unit"), "bounces");

    const json limit =
        limitOf("trace.lines.rows", "glass-sphere", {"trace=lines", "lines.rows=64"});
    // A row a photon, of all that those that are emitted may become.
    EXPECT_EQ(limit.at("needed"), 32 * 32 * 8);
    EXPECT_TRUE(limit.at("lost").get<std::string>().starts_with("128 passes over the photons of a"))
        << limit;
}

TEST_F(Limits, SayWhereTheEyesRaysWereCutOff) {
    // Through a ball the eye's ray is refracted twice, and its two layers are looked for in as
    // many.
    for (const auto& [name, limit] : limitsOf("glass-sphere", {"refraction.interfaces=2"}))
        EXPECT_FALSE(name.starts_with("view.")) << limit;

    auto limits = limitsOf("glass-sphere", {"refraction.interfaces=1"});
    ASSERT_TRUE(limits.contains("view.refraction.interfaces")) << report().at("limits");
    EXPECT_EQ(limits["view.refraction.interfaces"].at("unit"), "refractions");
    EXPECT_EQ(limits["view.refraction.interfaces"].at("value"), 1);
    EXPECT_EQ(limits["view.refraction.interfaces"].at("lost_w"), 0.0);
    EXPECT_FALSE(limits.contains("view.refraction.layers"));

    const json limit = limitOf("view.refraction.layers", "glass-sphere", {"refraction.layers=1"});
    EXPECT_EQ(limit.at("unit"), "layers");
    EXPECT_EQ(limit.at("value"), 1);
    EXPECT_EQ(limit.at("needed"), 2);
    EXPECT_TRUE(isReached("view.refraction.layers", "glass-sphere",
                          {"refraction.layers=1", "refraction.search=all"}));
    // A pass that is skipped reaches nothing.
    limits = limitsOf("glass-sphere", {"refraction.layers=1"}, {"view.refraction"});
    EXPECT_FALSE(limits.contains("view.refraction.layers"));
}

// An eye in front of a cube of glass: through its side it sees others only by total reflection.
TEST_F(Limits, CountRaysThatAreReflectedTooOften) {
    static_cast<void>(folder.file("cube.toml", R"(
name = "cube"
[camera]
position = [1.5, 1.2, 2.5]
target = [0, 0.5, 0]
[[light]]
name = "sun"
type = "directional"
direction = [0.1, -1, 0]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [4, 4]
[[object]]
name = "cube"
shape = "box"
material = "glass"
size = [1, 1, 1]
position = [0, 0.6, 0]
)"));
    const auto reachedWith = [&](const std::string& reflections) {
        return isReached("view.refraction.reflections", "cube.toml",
                         {"refraction.reflections=" + reflections, "refraction.search=all"});
    };
    EXPECT_TRUE(reachedWith("0")) << report().at("limits");
    EXPECT_FALSE(reachedWith("64")) << report().at("limits");
}

TEST_F(Limits, CountSplatsThatAreSmallerThanTheyWereToBe) {
    EXPECT_FALSE(isReached("reconstruct.sprites.maximum", "wavy.toml",
                           {"reconstruct=sprites", "sprites.maximum=100"}));
    const json limit = limitOf("reconstruct.sprites.maximum", "wavy.toml",
                               {"reconstruct=sprites", "sprites.maximum=1", "sprites.radius=0.2"});
    EXPECT_EQ(limit.at("unit"), "px");
    EXPECT_EQ(limit.at("value"), 1);
    EXPECT_GT(limit.at("needed"), 2.0);
    EXPECT_EQ(limit.at("lost_w"), 0.0);
}

TEST_F(Limits, CountBeamsThatAreNarrowerThanTheyWereToBe) {
    EXPECT_FALSE(isReached("reconstruct.triangles.maximum", "wavy.toml", {}));
    const json limit =
        limitOf("reconstruct.triangles.maximum", "wavy.toml", {"triangles.maximum=1"});
    EXPECT_EQ(limit.at("unit"), "px");
    EXPECT_EQ(limit.at("value"), 1);
    EXPECT_GT(limit.at("needed"), 1.0);
    EXPECT_EQ(limit.at("lost_w"), 0.0);
}

// The cells of so few photons are some pixels wide.
TEST_F(Limits, LeaveCellsApartThatAreWiderThanATriangleMayBe) {
    const auto trianglesUpTo = [&](const std::string& maximum) {
        static_cast<void>(
            limitsOf("wavy.toml", {"emit.photons=8x8", "triangles.maximum=" + maximum}));
        return report().at("energy").at("primitives").at("triangles").get<double>();
    };
    EXPECT_GT(trianglesUpTo("100"), 0.5);
    EXPECT_EQ(trianglesUpTo("1"), 0.0);
}

TEST_F(Limits, CountLinesInTheMediumThatAreNarrowerThanTheyWereToBe) {
    EXPECT_FALSE(isReached("media.lines.maximum", "god-rays", {"media.lines.maximum=256"}));
    const json limit = limitOf("media.lines.maximum", "god-rays", {"media.lines.maximum=2"});
    EXPECT_EQ(limit.at("unit"), "px");
    EXPECT_EQ(limit.at("value"), 2);
    EXPECT_GT(limit.at("needed"), 2.0);
    EXPECT_EQ(limit.at("lost_w"), 0.0);
    // A pass that is skipped reaches nothing.
    EXPECT_FALSE(limitsOf("god-rays", {"media.lines.maximum=2"}, {"media.lines"})
                     .contains("media.lines.maximum"));
    // As wide as the widest was to be: none is narrower any more.
    const double enough = std::ceil(limit.at("needed").get<double>());
    EXPECT_FALSE(isReached("media.lines.maximum", "god-rays",
                           {"media.lines.maximum=" + std::to_string(static_cast<int>(enough))}));
}

TEST_F(Limits, CountBranchesForWhichTheMapCouldNotGrow) {
    // Into the ball, out of it, and what is reflected in it again and again.
    const json limit =
        limitOf("specular.split.levels", "glass-sphere", {"specular=split", "split.levels=1"});
    EXPECT_EQ(limit.at("unit"), "levels");
    EXPECT_EQ(limit.at("value"), 1);
    EXPECT_GT(limit.at("lost_w"), 0.0);
    // Batches count as what is emitted at once does.
    const json batches = limitOf("specular.split.levels", "glass-sphere",
                                 {"specular=split", "split.levels=1", "emit.batch=1024"});
    EXPECT_EQ(batches.at("lost"), limit.at("lost"));
    // The light hits the water once.
    EXPECT_FALSE(
        isReached("specular.split.levels", "wavy.toml", {"specular=split", "split.levels=1"}));
    EXPECT_TRUE(
        isReached("specular.split.levels", "wavy.toml", {"specular=split", "split.levels=0"}));
}

TEST_F(Limits, CountThePhotonsOfAllBatches) {
    const std::vector<std::string> drawn = {"specular=split", "split.levels=1"};
    const json whole = limitOf("specular.split.levels", "glass-sphere", drawn);
    std::vector<std::string> inBatches = drawn;
    inBatches.emplace_back("emit.batch=100");
    EXPECT_EQ(limitOf("specular.split.levels", "glass-sphere", inBatches), whole);
}

// Below a ball light converges, and its splats are no smaller than they may be.
TEST_F(Limits, CountSplatsThatAreLargerThanTheyWereToBe) {
    const std::vector<std::string> lens = {"emit=grid", "reconstruct=lens", "lens.widths=0.1"};
    const json limit = limitOf("reconstruct.lens.min_diameter", "glass-sphere", lens);
    EXPECT_EQ(limit.at("unit"), "texels");
    EXPECT_EQ(limit.at("value"), 2);
    EXPECT_LT(limit.at("needed"), 2.0);
    EXPECT_EQ(limit.at("lost_w"), 0.0);
    // A photon is one splat, and nearly all of those that arrive are as wide as that.
    const json photons = report().at("photons");
    EXPECT_LE(limit.at("count"), photons.at("hit"));
    EXPECT_GT(limit.at("count").get<double>(), 0.8 * photons.at("hit").get<double>());
    EXPECT_NE(limit.at("lost").get<std::string>().find("% of the flux"), std::string::npos);
    const json energy = report().at("energy");
    EXPECT_GT(limit.at("count_w").get<double>(), 0.0);
    EXPECT_LE(limit.at("count_w").get<double>(), energy.at("deposited_w").get<double>() * 1.001);
}

TEST_F(Limits, CountRaysThatHitMoreThanTheyCanKeep) {
    // Under the water there is the floor alone.
    const json limit =
        limitOf("trace.all_hits.slots", "wavy.toml", {"trace=all_hits", "all_hits.slots=1"});
    EXPECT_EQ(limit.at("unit"), "hits");
    EXPECT_EQ(limit.at("value"), 1);
    EXPECT_FALSE(
        isReached("trace.all_hits.slots", "wavy.toml", {"trace=all_hits", "all_hits.slots=2"}));
}

}  // namespace
}  // namespace kaustik::test
