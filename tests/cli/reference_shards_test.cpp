// SPDX-License-Identifier: MIT
// kaustik reference --shard and --merge: what several machines do.
#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ReferenceShards : public CommandLine {
  protected:
    ReferenceShards() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }

    // With no cache: a shard needs none.
    [[nodiscard]] Conditions conditions() const {
        Conditions conditions;
        conditions.folder = folder / ".";
        conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
        return conditions;
    }
    [[nodiscard]] Outcome reference(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"reference", "wavy.toml", "--size",
                                              "32x24",     "--photons", "1000000"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments, conditions());
    }
    void compute(const std::string& shard, const std::string& file,
                 const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"--shard", shard, "--out", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = reference(arguments);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("wrote " + file), std::string::npos) << outcome.out;
    }
    [[nodiscard]] Outcome merge(const std::vector<std::string>& files,
                                const std::vector<std::string>& more = {"--out",
                                                                        "merged.exr"}) const {
        std::vector<std::string> arguments = {"reference", "--merge"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments, conditions());
    }
    // What a reference says of itself, but for its file's name and how long it took.
    [[nodiscard]] json facts(const std::string& file) const {
        json sidecar = json::parse(contents(file));
        sidecar.erase("compute_s");
        for (auto& [name, image] : sidecar.at("images").items())
            image.erase("file");
        return sidecar;
    }
    void expectSameReference(const std::string& one, const std::string& other) const {
        EXPECT_EQ(facts(one + ".json"), facts(other + ".json"));
        for (const char* suffix : {".exr", ".stderr.exr"})
            EXPECT_EQ(readImage(folder / (one + suffix)).values,
                      readImage(folder / (other + suffix)).values);
    }
};

TEST_F(ReferenceShards, MergeIntoTheUndividedReferenceInAnyOrderAndHoweverOften) {
    ASSERT_EQ(reference({"--out", "whole.exr"}).exitCode, 0);
    fs::remove_all(folder / "cache");
    compute("1/3", "a.shard", {"--threads", "1"});
    compute("2/3", "b.shard");
    compute("3/3", "c.shard");
    compute("2/3", "again.shard");
    EXPECT_FALSE(fs::exists(folder / "cache"));
    for (const auto& files : {std::vector<std::string>{"a.shard", "b.shard", "c.shard"},
                              {"c.shard", "again.shard", "a.shard", "b.shard", "b.shard"}}) {
        const Outcome merged = merge(files);
        ASSERT_EQ(merged.exitCode, 0) << merged.err;
        EXPECT_NE(merged.out.find("wrote merged.exr"), std::string::npos);
        expectSameReference("whole", "merged");
    }
    // It is a reference as any other.
    const Outcome judged = run({"run", "wavy.toml", "--size", "32x24", "--frames", "1", "--set",
                                "photons=32x32", "--out", "out", "--reference", "merged.exr"},
                               conditions());
    EXPECT_EQ(judged.exitCode, 0) << judged.err;
}

TEST_F(ReferenceShards, KeepTheirClasses) {
    const std::vector<std::string> classes = {"--classes", "1", "--class", "up=R"};
    const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), classes.begin(), classes.end());
        return arguments;
    };
    ASSERT_EQ(reference(with({"--out", "whole.exr"})).exitCode, 0);
    compute("1/2", "a.shard", classes);
    compute("2/2", "b.shard", classes);
    ASSERT_EQ(merge({"b.shard", "a.shard"}).exitCode, 0);
    expectSameReference("whole", "merged");
    EXPECT_EQ(contents("merged.classes.exr"), contents("whole.classes.exr"));
    // A shard without them is of another reference.
    compute("2/2", "plain.shard");
    EXPECT_NE(merge({"a.shard", "plain.shard"}).exitCode, 0);
}

TEST_F(ReferenceShards, HaveNamesOfTheirOwnByDefault) {
    const Outcome outcome = reference({"--shard", "2/4"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(files().contains("results/references/wavy-light-32x24-2-of-4.shard"));
    const Outcome again = reference({"--shard", "2/4"});
    ASSERT_EQ(again.exitCode, 0) << again.err;
    EXPECT_NE(again.out.find("it was there already"), std::string::npos) << again.out;
}

TEST_F(ReferenceShards, ThatAreInterruptedGoOn) {
    ASSERT_EQ(reference({"--out", "whole.exr"}).exitCode, 0);
    const std::vector<std::string> half = {"reference", "wavy.toml", "--size",    "32x24",
                                           "--photons", "1000000",   "--shard",   "1/2",
                                           "--out",     "a.shard",   "--threads", "1"};
    Program program(half, conditions());
    program.waitUntilItHandles(SIGTERM);
    program.send(SIGTERM);
    const Outcome stopped = program.wait();
    expectFailure(stopped, 1, {"Interrupted after ", "goes on"});
    EXPECT_FALSE(files().contains("a.shard"));
    EXPECT_TRUE(files().contains("a.shard.unfinished"));
    compute("1/2", "a.shard");
    EXPECT_FALSE(files().contains("a.shard.unfinished"));
    compute("2/2", "b.shard");
    ASSERT_EQ(merge({"a.shard", "b.shard"}).exitCode, 0);
    expectSameReference("whole", "merged");
}

TEST_F(ReferenceShards, ThatAreMissingAreNamed) {
    for (const char* shard : {"1/6", "3/6"})
        compute(shard, fmt::format("{}.shard", shard[0]));
    expectFailure(merge({"1.shard", "3.shard"}), 2,
                  {"Of 6 shards", "shards 2 and 4 to 6 are missing", "--incomplete"});
    EXPECT_FALSE(files().contains("merged.exr"));
    const Outcome some = merge({"1.shard", "3.shard"}, {"--incomplete", "--out", "merged.exr"});
    ASSERT_EQ(some.exitCode, 0) << some.err;
    EXPECT_EQ(facts("merged.json").at("batches"), 2);
    // One batch has no error to give.
    expectFailure(merge({"1.shard"}, {"--incomplete", "--out", "one.exr"}), 2, {"two batches"});
}

TEST_F(ReferenceShards, OfOtherThingsAreRefusedAndNothingIsWritten) {
    compute("1/2", "a.shard");
    compute("2/2", "seed.shard", {"--seed", "2"});
    expectFailure(merge({"a.shard", "seed.shard"}), 2, {"seed.shard", "seed 2 instead of 1"});
    ASSERT_EQ(run({"reference", "wavy.toml", "--size", "32x24", "--photons", "600000", "--shard",
                   "2/2", "--out", "photons.shard"})
                  .exitCode,
              0);
    expectFailure(merge({"a.shard", "photons.shard"}), 2, {"photons.shard", "batches in all"});
    std::string other = kWavyWater;
    other.replace(other.find("1.333"), 5, "1.332");
    static_cast<void>(folder.file("wavy.toml", other));
    compute("2/2", "scene.shard");
    expectFailure(merge({"a.shard", "scene.shard"}), 2, {"scene.shard", "contents of the scene"});
    // Nor is a part overwritten by that of another scene.
    const std::string before = contents("a.shard");
    expectFailure(reference({"--shard", "1/2", "--out", "a.shard"}), 2, {"--out", "a.shard"});
    EXPECT_EQ(contents("a.shard"), before);
    EXPECT_FALSE(files().contains("merged.exr"));
}

TEST_F(ReferenceShards, ThatMakeNoSenseAreRefused) {
    for (const char* shard : {"5/4", "0/4", "x/y", "3", "1/0", "-1/2"})
        expectFailure(reference({"--shard", shard}), 2, {"--shard"});
    expectFailure(run({"reference", "wavy.toml", "--shard", "1/2"}), 2, {"--shard", "--photons"});
    expectFailure(reference({"--shard", "1/2", "--error", "0.1"}), 2, {"--shard", "--error"});
    expectFailure(reference({"--shard", "1/2", "--out", "a.exr"}), 2, {"a.exr", ".shard"});
    expectFailure(merge({"nowhere.shard"}), 1, {"nowhere.shard", "No such file"});
    expectFailure(merge({"wavy.toml"}), 1, {"wavy.toml", "no usable part"});
    expectFailure(merge({"."}), 1, {"directory"});
    expectFailure(run({"reference", "--merge"}), 2, {"--merge"});
    expectFailure(merge({"wavy.toml"}, {"--seed", "1"}), 2, {"--merge", "--seed"});
    expectFailure(run({"reference", "wavy.toml", "--incomplete"}), 2, {"--merge"});
    compute("1/1", "a.shard");
    expectFailure(merge({"a.shard"}, {"--out", "a.shard"}), 2, {"a.shard", ".exr"});
    fs::resize_file(folder / "a.shard", fs::file_size(folder / "a.shard") / 2);
    expectFailure(merge({"a.shard"}), 1, {"a.shard", "compute its shard again"});
    EXPECT_FALSE(files().contains("merged.exr"));
}

TEST_F(ReferenceShards, OnAFullDiskAreAMessageAndNoHalfFile) {
    Conditions limited = conditions();
    limited.largestFileBytes = 1024;
    expectFailure(run({"reference", "wavy.toml", "--size", "32x24", "--photons", "600000",
                       "--shard", "1/2", "--out", "a.shard"},
                      limited),
                  1, {"cannot be written"});
    EXPECT_EQ(files(), std::set<std::string>{"wavy.toml"});
}

}  // namespace
}  // namespace kaustik::test
