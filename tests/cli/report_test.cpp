// SPDX-License-Identifier: MIT
// report.json, schema kaustik.report/1 (framework/README.md, "The report"), and how --set and
// --disable show in it.
#include <algorithm>
#include <cmath>

#include "framework/image/image.h"
#include "framework/pipeline/default_technique.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;
using Report = CommandLine;
using Set = CommandLine;
using Disable = CommandLine;

std::set<std::string> keysOf(const json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items())
        keys.insert(key);
    return keys;
}

using Keys = std::set<std::string>;
const Keys kStatistics = {"median", "mean", "min", "max", "p95", "stdev"};

// A number that is not finite is written as null.
void expectNoNull(const json& value, const std::string& path) {
    EXPECT_FALSE(value.is_null()) << path;
    if (!value.is_structured()) return;
    for (const auto& [key, child] : value.items())
        expectNoNull(child, path + "/" + key);
}

bool isBlack(const Image& image) {
    return std::all_of(image.values.begin(), image.values.end(),
                       [](float value) { return value == 0.0f; });
}

TEST_F(Report, HasTheKeysOfTheSchema) {
    static_cast<void>(renderWater());
    const json report = this->report();
    EXPECT_EQ(report.at("schema"), "kaustik.report/1");
    EXPECT_EQ(
        keysOf(report),
        (Keys{"schema", "version", "device", "scene", "technique", "parameters", "seed", "size",
              "frames", "warmup", "timer", "frame_ms", "startup_ms", "passes", "photons", "energy",
              "memory", "warnings",
              // Ours, besides.
              "disabled", "time_s", "time_step_s", "bookkeeping_ms", "graph_build_ms", "eye_rays",
              "layers", "limits", "as_published", "violations", "timing", "programs"}));
    Keys timing = keysOf(report.at("timing"));
    timing.erase("other_processors");  // of moments it is not known
    EXPECT_EQ(timing, (Keys{"cut_short_frames", "date", "dropped_frames", "ledger", "measuring_ms",
                            "of_measured_frame"}));
    EXPECT_EQ(report.at("timing").at("dropped_frames"), 0);
    EXPECT_GT(report.at("timing").at("measuring_ms").get<double>(), 0.0);
    EXPECT_LT(report.at("timing").at("measuring_ms"), report.at("frame_ms").at("median"));
    EXPECT_EQ(keysOf(report.at("device")),
              (Keys{"renderer", "vendor", "gl", "platform", "uuid", "gl_debug", "cpu", "threads"}));
    EXPECT_EQ(keysOf(report.at("scene")), (Keys{"name", "triangles", "needs"}));
    EXPECT_EQ(keysOf(report.at("photons")),
              (Keys{"emitted", "traced", "specular", "hit", "missed", "nan"}));
    EXPECT_EQ(keysOf(report.at("energy")),
              (Keys{"emitted_w", "deposited_w", "absorbed_w", "left_scene_w", "lost_w",
                    "primitives", "balance"}));
    EXPECT_EQ(keysOf(report.at("memory")),
              (Keys{"texture_bytes", "buffer_bytes", "scene_bytes", "peak_bytes"}));
    for (const char* times : {"frame_ms", "bookkeeping_ms"}) {
        EXPECT_EQ(keysOf(report.at(times)), kStatistics) << times;
    }
    for (const json& pass : report.at("passes")) {
        Keys expected = {"name", "stage", "ran", "why"};
        if (pass.at("ran").get<bool>()) expected.merge(Keys{"gpu_ms", "cpu_ms", "repeats"});
        EXPECT_EQ(keysOf(pass), expected) << pass;
        if (!pass.at("ran").get<bool>()) continue;
        EXPECT_EQ(keysOf(pass.at("gpu_ms")), kStatistics) << pass;
        EXPECT_EQ(keysOf(pass.at("cpu_ms")), kStatistics) << pass;
    }
}

TEST_F(Report, SaysWhatWasAskedFor) {
    static_cast<void>(renderWater({"--seed", "42", "--time", "0.5"}));
    const json report = this->report();
    EXPECT_EQ(report.at("scene").at("name"), "wavy");
    EXPECT_EQ(report.at("scene").at("triangles"), 2 + 2 * 16 * 16);
    EXPECT_EQ(report.at("technique"), kDefaultTechnique);
    EXPECT_EQ(report.at("size"), json({64, 48}));
    EXPECT_EQ(report.at("frames"), 1);
    EXPECT_EQ(report.at("warmup"), 0);
    EXPECT_EQ(report.at("seed"), 42);
    EXPECT_EQ(report.at("time_s"), 0.5);
    EXPECT_EQ(report.at("timer"), "gpu");
    ASSERT_EQ(report.at("warnings").size(), 1u);  // nothing is random here
    EXPECT_NE(report.at("warnings")[0].get<std::string>().find("--seed 42"), std::string::npos);
    EXPECT_EQ(report.at("disabled"), json::array());
}

TEST_F(Report, HoldsFiniteNumbersOnly) {
    static_cast<void>(renderWater());
    expectNoNull(report(), "");
}

TEST_F(Report, CountsPhotonsAndEnergyThatAddUp) {
    static_cast<void>(renderWater());
    const json photons = report().at("photons");
    EXPECT_GT(photons.at("emitted"), 100);
    EXPECT_LE(photons.at("emitted"), 32 * 32);
    EXPECT_EQ(photons.at("nan"), 0);
    EXPECT_EQ(photons.at("emitted").get<int>(),
              photons.at("hit").get<int>() + photons.at("missed").get<int>());
    const json energy = report().at("energy");
    // What falls on the square metre of water; the grid's texels cover it to within one row and
    // column at either side.
    const double expected = 1000.0;
    EXPECT_NEAR(energy.at("emitted_w").get<double>(), expected, expected * 4.0 / 32.0);
    // Each account is rounded to the ledger's quantum, a part in a million or less of the whole.
    EXPECT_LT(std::abs(energy.at("balance").get<double>()), 1e-5);
}

// Of a ring vertices see much less than the light does, and no reference is needed to know it.
TEST_F(Report, SaysWithoutAReferenceWhatTheEmitterMisses) {
    const auto judge = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--out", "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run(smallRun("ring", arguments)).exitCode, 0);
        const json energy = report().at("energy");
        EXPECT_LT(std::abs(energy.at("balance").get<double>()), 1e-5);
        const std::string warnings = report().at("warnings").dump();
        const bool isSaid = warnings.find("emission_sampling") != std::string::npos;
        const double missed = energy.at("lost_w").at("emission_sampling").get<double>() /
                              energy.at("emitted_w").get<double>();
        EXPECT_EQ(isSaid, std::abs(missed) > 0.01) << warnings << missed;
        return missed;
    };
    EXPECT_GT(judge({"--technique", "vertex_caustics"}), 0.2);
    EXPECT_NE(report().at("warnings").dump().find("emit=vertices emits"), std::string::npos);
    const double wanted = report().at("energy").at("emitted_w");
    EXPECT_LT(std::abs(judge({"--set", "emit.photons=128x128"})), 0.01);
    // However it is emitted.
    EXPECT_EQ(report().at("energy").at("emitted_w"), wanted);
}

TEST_F(Report, SaysBySharesOfWhichPrimitivesLightWasSpread) {
    const auto shares = [&](const std::vector<std::string>& settings) {
        EXPECT_EQ(renderWater(settings).exitCode, 0);
        const json primitives = report().at("energy").at("primitives");
        EXPECT_EQ(keysOf(primitives), (Keys{"triangles", "beams", "splats"}));
        return primitives;
    };
    const json joined = shares({"--set", "reconstruct=triangles"});
    EXPECT_GT(joined.at("triangles").get<double>(), 0.8);
    EXPECT_GT(joined.at("beams").get<double>(), 0.0);  // the border has no neighbours
    // 64-bit sums of parts that are rounded to a unit of the ledger each.
    EXPECT_NEAR(joined.at("triangles").get<double>() + joined.at("beams").get<double>(), 1.0, 1e-4);
    EXPECT_EQ(joined.at("splats"), 0.0);
    EXPECT_EQ(shares({"--set", "reconstruct=sprites"}).at("splats"), 1.0);
}

TEST_F(Report, PassesAndBookkeepingAddUpToTheFrameWhereTheDeviceIsFinishedAroundEach) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    ASSERT_EQ(run({"run", "wavy.toml", "--precise", "--size", "64x48", "--frames", "5", "--set",
                   "photons=32x32", "--out", "out"})
                  .exitCode,
              0);
    const json report = this->report();
    EXPECT_EQ(report.at("timer"), "finish");
    // Means, since unlike medians those of the parts add up to that of the whole.
    double parts = report.at("bookkeeping_ms").at("mean").get<double>();
    for (const json& pass : report.at("passes")) {
        if (pass.at("ran").get<bool>()) parts += pass.at("gpu_ms").at("mean").get<double>();
    }
    const double frame = report.at("frame_ms").at("mean");
    EXPECT_GT(frame, 0.0);
    // Sums of some dozens of doubles.
    EXPECT_NEAR(parts, frame, 1e-12 * frame);
}

TEST_F(Report, SaysWhetherOpenGlDebuggedTheTimedFrames) {
    Conditions conditions;
    conditions.folder = folder / ".";
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    const auto debugs = [&](const char* inEnvironment, const std::vector<std::string>& more) {
        conditions.environment["KAUSTIK_GL_DEBUG"] = inEnvironment;
        std::vector<std::string> arguments = smallRun("wavy.toml", {"--out", "out"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runKaustik(arguments, conditions);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        const bool isPrinted = outcome.out.find(", debugged\n") != std::string::npos;
        const bool isReported = report().at("device").at("gl_debug").get<bool>();
        EXPECT_EQ(isPrinted, isReported);
        return isReported;
    };
    EXPECT_FALSE(debugs("0", {}));
    EXPECT_TRUE(debugs("0", {"--gl-debug"}));
    EXPECT_TRUE(debugs("1", {}));
}

TEST_F(Report, KeepsTimedFramesOnlyAndWarmsUpBefore) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    ASSERT_EQ(run({"run", "wavy.toml", "--size", "32x24", "--set", "photons=8x8", "--frames", "3",
                   "--warmup", "2", "--out", "out"})
                  .exitCode,
              0);
    EXPECT_EQ(report().at("frames"), 3);
    EXPECT_EQ(report().at("warmup"), 2);
    std::set<std::string> frames;
    const json trace = json::parse(contents("out/trace.json"));
    for (const json& event : trace.at("traceEvents")) {
        const std::string name = event.at("name");
        if (name.starts_with("frame ")) frames.insert(name);
    }
    EXPECT_EQ(frames, (Keys{"frame 2", "frame 3", "frame 4"}));
}

// Irradiance at the last of frames 0.25 s apart is that of one frame then.
TEST_F(Report, TimeStepMovesTheAnimationFromFrameToFrame) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    const auto runAt = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"run",   "wavy.toml",   "--size", "32x24",
                                           "--set", "photons=8x8", "--out",  out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return contents(out + "/caustic.exr");
    };
    const std::string stepped =
        runAt("out", {"--frames", "3", "--warmup", "2", "--time", "1", "--time-step", "0.25"});
    EXPECT_EQ(report().at("time_s"), 1.5);
    EXPECT_EQ(report().at("time_step_s"), 0.25);
    EXPECT_EQ(keysOf(report().at("between_frames_ms")), kStatistics);
    EXPECT_GT(report().at("between_frames_ms").at("min").get<double>(), 0.0);
    EXPECT_TRUE(stepped == runAt("then", {"--frames", "1", "--time", "1.5"}));
    EXPECT_FALSE(stepped == runAt("before", {"--frames", "1", "--time", "1"}));
    const Outcome still = run({"run", "ring", "--size", "32x24", "--set", "photons=8x8", "--frames",
                               "2", "--time-step", "0.25", "--out", "still"});
    EXPECT_NE(still.out.find("--time-step 0.25 has no effect: nothing moves in this scene."),
              std::string::npos)
        << still.out;
    EXPECT_EQ(run({"run", "ring", "--time-step", "nan", "--out", "no"}).exitCode, 2);
}

TEST_F(Set, TakesAnyUniqueShortFormAndReportsTheFullName) {
    static_cast<void>(renderWater({"--set", "trace=lines", "--set", "lines.rows=32"}));
    const json report = this->report();
    const json& parameters = report.at("parameters");
    EXPECT_EQ(parameters.at("trace"), "lines");
    EXPECT_EQ(parameters.at("trace.lines.rows"), 32);
    EXPECT_EQ(parameters.at("emit.photons"), "32x32");  // smallRun says photons=32x32
    EXPECT_FALSE(parameters.contains("lines.rows"));
    EXPECT_FALSE(parameters.contains("photons"));
}

TEST_F(Set, ReportsEveryParameterThatIsListed) {
    static_cast<void>(renderWater());
    const json listed = json::parse(run({"list", "params", "--json"}).out);
    const json parameters = report().at("parameters");
    EXPECT_EQ(parameters.size(), listed.size());
    for (const json& entry : listed) {
        EXPECT_TRUE(parameters.contains(entry.at("name").get<std::string>())) << entry;
    }
}

TEST_F(Set, TheLastOfTwoValuesCounts) {
    static_cast<void>(renderWater({"--set", "layers.count=2", "--set", "layers.count=5"}));
    EXPECT_EQ(report().at("parameters").at("layers.count"), 5);
}

TEST_F(Disable, OfTheReconstructionLeavesNoCaustic) {
    static_cast<void>(renderWater({"--disable", "reconstruct.triangles"}));
    const json report = this->report();
    EXPECT_EQ(report.at("disabled"), json({"reconstruct.triangles"}));
    const json& pass = passNamed(report, "reconstruct.triangles");
    EXPECT_EQ(pass.at("ran"), false);
    EXPECT_NE(pass.at("why").get<std::string>().find("disabled"), std::string::npos) << pass;
    EXPECT_TRUE(isBlack(readImage(folder / "out/caustic.exr")));
}

TEST_F(Disable, OfTheShadowsLightsWhatTheyDarkened) {
    static_cast<void>(renderWater({}, "shadows"));
    static_cast<void>(renderWater({"--disable", "shadow.bvh"}));
    const json withShadows = report("shadows");
    const json withoutShadows = report();
    EXPECT_EQ(passNamed(withShadows, "shadow.bvh").at("ran"), true);
    EXPECT_EQ(passNamed(withoutShadows, "shadow.bvh").at("ran"), false);
    // Water blocks direct light, so without shadows the floor below it is brighter.
    double brighter = 0.0;
    const Image with = readImage(folder / "shadows/beauty.exr");
    const Image without = readImage(folder / "out/beauty.exr");
    ASSERT_EQ(with.values.size(), without.values.size());
    for (std::size_t i = 0; i < with.values.size(); ++i)
        brighter += static_cast<double>(without.values[i]) - static_cast<double>(with.values[i]);
    EXPECT_GT(brighter, 0.0);
}

TEST_F(Disable, TakesAUniqueShortFormAndReportsTheFullName) {
    static_cast<void>(renderWater({"--disable", "triangles", "--disable", "view.bvh"}));
    EXPECT_EQ(report().at("disabled"), json({"reconstruct.triangles", "view.bvh"}));
    EXPECT_TRUE(isBlack(readImage(folder / "out/caustic.exr")));
}

}  // namespace
}  // namespace kaustik::test
