// SPDX-License-Identifier: MIT
// kaustik census, what run and explain say by it, and the classes of kaustik reference.
#include <signal.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include "framework/core/files.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Census : public CommandLine {
  protected:
    Census() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }
    [[nodiscard]] Outcome runCached(const std::vector<std::string>& arguments) const {
        Conditions conditions;
        conditions.folder = folder / ".";
        conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
        return run(arguments, conditions);
    }
    [[nodiscard]] Outcome census(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {
            "census", "wavy.toml",           "--photons", "100000",      "--size",
            "64x48",  "--technique-photons", "64x64",     "--technique", "exact_rays"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runCached(arguments);
    }
    [[nodiscard]] json found(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = census(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return json::parse(outcome.out);
    }
};

TEST_F(Census, IsOfAllTheLightByClassAndByObject) {
    const json report = found();
    const double all = report.at("arriving").at("watts");
    // Light comes from above, and of what the water lets through the floor catches nearly all.
    EXPECT_NEAR(all, report.at("energy").at("deposited_w"), 1e-9 * all);
    EXPECT_GT(all, 0.9 * report.at("energy").at("emitted_w").get<double>());
    for (const char* list : {"classes", "objects"}) {
        double sum = 0.0;
        for (const json& one : report.at(list))
            sum += one.at("watts").get<double>();
        EXPECT_NEAR(sum, all, 1e-9 * all) << list;
    }
    EXPECT_EQ(report.at("classes")[0].at("class"), "T");
    EXPECT_EQ(report.at("objects")[0].at("first_object"), "water");
}

// A technique that refracts alone, on a ball: in a ball no light is totally reflected, so that it
// forms TT and nothing else.
TEST_F(Census, SaysWhatATechniqueFormsAndWhatItCannotForm) {
    const Outcome outcome = runCached({"census", "glass-sphere", "--json", "--photons", "200000",
                                       "--size", "64x48", "--technique-photons", "64x64",
                                       "--technique", "exact_rays", "--set", "specular=interface"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    const json& row = report.at("techniques")[0];
    ASSERT_FALSE(row.contains("problem")) << row;
    EXPECT_EQ(row.at("models").at("transmission_only"), true);
    const double all = report.at("arriving").at("watts");
    const json& brightest = report.at("classes")[0];
    ASSERT_EQ(brightest.at("class"), "TT");
    const double straight = brightest.at("watts");
    const double cannot = row.at("cannot_form").at("watts");
    // The ball is a mesh, in which a ray in a thousand is.
    EXPECT_NEAR(cannot, all - straight, 1e-3 * all);
    EXPECT_GT(cannot, 0.05 * all);
    EXPECT_FALSE(row.at("cannot_form").at("classes").contains("TT"));
    EXPECT_TRUE(row.at("cannot_form").at("classes").contains("R"));
    // By its ledger, of other photons: what it brings to receivers, and what it has lost on the
    // way, is what it can form. 64 by 64 photons find the ball's outline to some percent.
    double formed = row.at("forms_w");
    for (const auto& [cause, watts] : row.at("loses_w").items())
        formed += watts.get<double>();
    EXPECT_NEAR(formed, straight, 0.02 * straight);
    EXPECT_GT(row.at("loses_w").at("off_screen").get<double>(), 0.0);
}

TEST_F(Census, IsATableAndFilesToo) {
    const Outcome outcome = census({"--out", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const char* word : {"by the first specular object", "cannot form", "exact_rays", "water"})
        EXPECT_NE(outcome.out.find(word), std::string::npos) << outcome.out;
    const std::string classes = readFile(folder / "out/classes.csv");
    EXPECT_TRUE(classes.starts_with("scene,kind,name,watts")) << classes;
    EXPECT_NE(classes.find("\nwavy,class,T,"), std::string::npos) << classes;
    EXPECT_NE(readFile(folder / "out/techniques.csv").find("wavy,exact_rays,false,done"),
              std::string::npos);
    EXPECT_EQ(json::parse(readFile(folder / "out/census.json")).at("schema"), "kaustik.census/1");
}

// To the letter: with the rows of two techniques that have four, dealt out to three.
TEST_F(Census, OfShardsIsThatOfOneProcess) {
    const std::vector<std::string> both = {"--technique", "caustic_map"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), both.begin(), both.end());
        return census(more);
    };
    const Outcome whole = with({"--out", "whole"});
    ASSERT_EQ(whole.exitCode, 0) << whole.err;
    for (const char* shard : {"3/3", "1/3", "2/3"})
        ASSERT_EQ(with({"--shard", shard, "--out", "parts"}).exitCode, 0) << shard;
    expectFailure(with({"--merge", "parts/census-1-of-3.json", "parts/census-3-of-3.json"}), 2,
                  {"of 3 shards 2 is missing"});
    const Outcome merged = with({"--merge", "parts/census-1-of-3.json", "parts/census-2-of-3.json",
                                 "parts/census-3-of-3.json", "--out", "merged"});
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    for (const std::string name : {"classes.csv", "techniques.csv", "census.json"})
        EXPECT_EQ(readFile(folder / ("merged/" + name)), readFile(folder / ("whole/" + name)));
}

TEST_F(Census, RefusesPartsOfSomethingElse) {
    const auto merge = [&](const std::string& scene, std::vector<std::string> files) {
        files.insert(files.begin(), {"census", scene, "--merge"});
        return runCached(files);
    };
    const std::string part = "parts/census-1-of-2.json";
    const std::string other = "others/census-2-of-2.json";
    const auto makeOther = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"--shard", "2/2", "--out", "others"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(census(arguments).exitCode, 0);
    };
    ASSERT_EQ(census({"--shard", "1/2", "--out", "parts"}).exitCode, 0);
    makeOther({"--set", "trace=bvh"});
    expectFailure(merge("wavy.toml", {part, other}), 2, {other, "by their settings"});
    ASSERT_EQ(runCached({"census", "wavy.toml", "--photons", "100000", "--size", "32x24",
                         "--technique-photons", "64x64", "--technique", "exact_rays", "--shard",
                         "2/2", "--out", "others"})
                  .exitCode,
              0);
    expectFailure(merge("wavy.toml", {part, other}), 2, {other, "by their size"});
    makeOther({"--technique", "planar"});
    expectFailure(merge("wavy.toml", {part, other}), 2, {other, "by their rows"});
    makeOther({});
    EXPECT_EQ(merge("wavy.toml", {other, part}).exitCode, 0);
    expectFailure(merge("ring", {part, other}), 2, {part, "is of another scene than ring"});
    expectFailure(merge("wavy.toml", {part, part, other}), 2, {"shard 1 is there twice"});
    expectFailure(merge("wavy.toml", {part}), 2, {"of 2 shards 2 is missing"});
    expectFailure(merge("wavy.toml", {"wavy.toml"}), 1, {"wavy.toml"});
    ASSERT_EQ(census({"--out", "whole"}).exitCode, 0);
    expectFailure(merge("wavy.toml", {"whole/census.json"}), 2, {"is no shard of a census"});
    expectFailure(census({"--shard", "1/2"}), 2, {"--out"});
    expectFailure(census({"--shard", "3/2", "--out", "parts"}), 2, {"--shard"});
}

TEST_F(Census, IsWhatRunAndExplainSayByLater) {
    const std::vector<std::string> few = {"--set", "specular=interface", "--size", "64x48"};
    const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), few.begin(), few.end());
        return runCached(arguments);
    };
    const Outcome before = with({"explain", "wavy.toml"});
    EXPECT_NE(before.out.find("kaustik census"), std::string::npos) << before.out;
    ASSERT_EQ(census().exitCode, 0);
    const Outcome after = with({"explain", "wavy.toml"});
    EXPECT_EQ(after.out.find("kaustik census"), std::string::npos) << after.out;
    EXPECT_NE(after.out.find("cannot form"), std::string::npos) << after.out;
    const Outcome ran = with({"run", "wavy.toml", "--frames", "1", "--warmup", "0", "--set",
                              "emit.photons=32x32", "--out", "out"});
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const json report = json::parse(readFile(folder / "out/report.json"));
    ASSERT_TRUE(report.contains("cannot_form"));
    const json& part = report.at("cannot_form");
    double sum = 0.0;
    for (const auto& [name, one] : part.at("classes").items())
        sum += one.at("watts").get<double>();
    EXPECT_NEAR(sum, part.at("watts"), 1e-9 + 1e-6 * part.at("watts").get<double>());
}

// The paths of a census are traced in seconds, so that many photons are asked for.
TEST_F(Census, EndsAtASignalAndWritesNothing) {
    Conditions conditions;
    conditions.folder = folder / ".";
    conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
    Program program({"census", "wavy.toml", "--photons", "100000000000", "--out", "out"},
                    conditions);
    program.waitUntilItHandles(SIGINT);
    program.send(SIGINT);
    expectFailure(program.wait(), 1, {"Interrupted"});
    EXPECT_FALSE(std::filesystem::exists(folder / "out/census.json"));
}

TEST_F(Census, KeepsTheRowsThatAreDoneWhereItIsInterrupted) {
    Conditions conditions;
    conditions.folder = folder / ".";
    conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
    // All techniques, of which the first is soon done.
    Program program({"census", "wavy.toml", "--photons", "100000", "--size", "64x48",
                     "--technique-photons", "32x32", "--out", "out"},
                    conditions);
    const auto hasKept = [&] {
        std::error_code ignored;
        for (const auto& entry :
             std::filesystem::directory_iterator(folder / "out/census.unfinished", ignored)) {
            if (entry.path().filename().string().starts_with("census-1-of-")) return true;
        }
        return false;
    };
    while (program.isRunning() && !hasKept())
        std::this_thread::yield();
    program.send(SIGINT);
    expectFailure(program.wait(), 1, {"Interrupted after ", "rows of techniques", "goes on"});
    EXPECT_TRUE(hasKept());
    EXPECT_FALSE(std::filesystem::exists(folder / "out/census.json"));
}

// A row that is there is taken as it is, if it is of the same census, and else made again.
TEST_F(Census, GoesOnFromTheRowsThatAreThere) {
    const std::vector<std::string> both = {"--technique", "caustic_map", "--out"};
    const auto into = [&](const char* out) {
        std::vector<std::string> arguments = both;
        arguments.emplace_back(out);
        return census(arguments);
    };
    ASSERT_EQ(into("whole").exitCode, 0);
    const json whole = json::parse(readFile(folder / "whole/census.json"));
    const std::size_t rows = whole.at("techniques").size();
    ASSERT_GE(rows, 2u);
    std::vector<std::string> shard = both;
    shard.insert(shard.end(), {"parts", "--shard", "1/" + std::to_string(rows)});
    ASSERT_EQ(census(shard).exitCode, 0);
    const std::string name = "census-1-of-" + std::to_string(rows) + ".json";
    const auto goOnFrom = [&](const std::string& settings) {
        json part = json::parse(readFile(folder / "parts" / name));
        part.at("techniques")[0].at("forms_w") = 1.25;
        part.at("settings") = settings;
        writeFileWhole(folder / "out/census.unfinished" / name, part.dump());
        EXPECT_EQ(into("out").exitCode, 0);
        EXPECT_FALSE(std::filesystem::exists(folder / "out/census.unfinished"));
        return json::parse(readFile(folder / "out/census.json"));
    };
    json expected = whole;
    expected.at("techniques")[0].at("forms_w") = 1.25;
    EXPECT_EQ(goOnFrom(whole.at("settings")), expected);
    EXPECT_EQ(goOnFrom("emit.photons=32x32"), whole);
}

TEST_F(Census, RefusesWhatMakesNoSenseInASentence) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"census", "wavy.toml", "--photons", "3"}, "--photons"},
        {{"census", "wavy.toml", "--technique", "exact_ray"}, "exact_rays"},
        {{"census", "wavy.toml", "--set", "nonsense=1"}, "nonsense"},
        {{"census", "wavy.toml", "--technique-photons", "no"}, "emit.photons"},
        {{"census", "wavy.toml", "--size", "0x3"}, "--size"},
        {{"census", "nowhere.toml"}, "nowhere.toml"},
        {{"reference", "wavy.toml", "--class", "L X D"}, "'X' is no interaction"},
        {{"reference", "wavy.toml", "--class", "T@watre"}, "did you mean 'water'"},
        {{"reference", "wavy.toml", "--classes", "65"}, "0 to 64"},
        {{"reference", "wavy.toml", "--classes", "2", "--estimator", "sppm"}, "estimator light"},
        {{"reference", "wavy.toml", "--by-object"}, "--by-object"}};
    for (const auto& [arguments, word] : cases) {
        const Outcome outcome = runCached(arguments);
        EXPECT_EQ(outcome.exitCode, word == "nowhere.toml" ? outcome.exitCode : 2) << word;
        EXPECT_NE(outcome.exitCode, 0) << word;
        EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    }
}

TEST_F(Census, ClassesOfAReferenceSayTheirMemoryBeforeAndTheirSharesAfter) {
    const Outcome outcome =
        runCached({"reference", "wavy.toml", "--size", "64x48", "--photons", "600000", "--classes",
                   "2", "--class", "up=R", "--out", "wavy.exr"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("MiB of memory"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("share of the picture's irradiance by class"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "wavy.classes.exr"));
    const json sidecar = json::parse(readFile(folder / "wavy.json"));
    EXPECT_EQ(sidecar.at("request").at("classes")[0].at("name"), "up");
}

}  // namespace
}  // namespace kaustik::test
