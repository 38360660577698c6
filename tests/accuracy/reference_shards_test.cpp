// SPDX-License-Identifier: MIT
// References in shards: what a part file holds, what a killed shard leaves, what may be merged.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/reference/shards.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

class ReferenceShards : public testing::Test {
  protected:
    ReferenceShards() {
        request_.width = 24;
        request_.height = 18;
        request_.photonsPerBatch = 2000;
    }
    ShardResult compute(const Shard& shard, const std::string& name, RunOptions options = {}) {
        messages_.clear();
        return computeShard(embree_, request_, {shard, kPhotons, temporary_ / name}, options,
                            [this](const std::string& text) { messages_.push_back(text); });
    }
    [[nodiscard]] Reference merge(const std::vector<std::string>& names, bool incomplete = false) {
        messages_.clear();
        std::vector<fs::path> files;
        for (const std::string& name : names)
            files.push_back(temporary_ / name);
        return mergeParts(files, {incomplete, {}, [this](const std::string& text) {
                                      messages_.push_back(text);
                                  }});
    }
    [[nodiscard]] Reference undivided() {
        PixelSums sums = makeSums(embree_, request_);
        RunOptions options;
        options.stop.photons = kPhotons;
        addBatches(embree_, request_, options, sums);
        return makeReference(scene_, request_, sums, 0.0);
    }
    // As the program of another version would have written it.
    void changeVersion(const std::string& name) const {
        PartHead head = readPartHead(temporary_ / name);
        const PixelSums sums = readPartSums(temporary_ / name, head);
        head.version = "0.0.9";
        writePart(temporary_ / name, head, sums);
    }

    static constexpr std::uint64_t kPhotons = 15000;
    scene::Scene scene_ = scene::loadScene("glossy-table");
    EmbreeScene embree_{scene_};
    test::TemporaryFolder temporary_;
    ReferenceRequest request_;
    std::vector<std::string> messages_;
};

void expectSame(const Reference& one, const Reference& other) {
    EXPECT_EQ(one.key, other.key);
    EXPECT_EQ(one.photons, other.photons);
    EXPECT_EQ(one.batches, other.batches);
    for (const auto image :
         {&Reference::irradiance, &Reference::irradianceError, &Reference::causticRadiance,
          &Reference::causticRadianceError, &Reference::inScattered, &Reference::causticView}) {
        EXPECT_EQ((one.*image).values, (other.*image).values);
    }
    EXPECT_EQ(one.energy.watts, other.energy.watts);
    EXPECT_EQ(one.relativeError, other.relativeError);
}

TEST_F(ReferenceShards, MergeToTheBitForEveryEstimatorAndNumberOfShards) {
    for (const Estimator estimator : {Estimator::light, Estimator::sppm}) {
        request_.estimator = estimator;
        request_.causticView = estimator == Estimator::sppm;
        const Reference whole = undivided();
        EXPECT_FALSE(whole.causticRadiance.values.empty());
        // More shards than batches: some have none.
        for (const std::uint64_t count : {1u, 3u, 20u}) {
            std::vector<std::string> names;
            for (std::uint64_t number = count; number > 0; --number) {
                names.push_back(std::to_string(number) + ".shard");
                compute({number, count}, names.back());
            }
            expectSame(merge(names), whole);
            for (const std::string& name : names)
                fs::remove(temporary_ / name);
        }
    }
}

TEST_F(ReferenceShards, ThatIsStoppedGoesOnFromWhatItHas) {
    const Reference whole = undivided();
    RunOptions stopping;
    stopping.threads = 1;
    stopping.saveEverySeconds = 0.0;
    stopping.progress = [](const Progress& now) { return now.batches < 2; };
    EXPECT_FALSE(compute({1, 2}, "1.shard", stopping).head.isWhole());
    EXPECT_FALSE(fs::exists(temporary_ / "1.shard")) << "it is there only when it is whole";
    const fs::path unfinished = unfinishedPart(temporary_ / "1.shard");
    ASSERT_EQ(readPartHead(unfinished).batchCount(), 2u);

    // A part that is not whole is no more than what it holds.
    compute({2, 2}, "2.shard");
    const std::string left = unfinished.filename().string();
    EXPECT_THROW(static_cast<void>(merge({left, "2.shard"})), ConfigError);
    EXPECT_EQ(merge({left, "2.shard"}, true).batches, whole.batches - 2);

    RunOptions counting;
    std::vector<std::uint64_t> counts;
    counting.progress = [&](const Progress& now) {
        counts.push_back(now.batches);
        return true;
    };
    EXPECT_TRUE(compute({1, 2}, "1.shard", counting).head.isWhole());
    ASSERT_FALSE(counts.empty());
    EXPECT_EQ(counts.front(), 3u) << "it began again";
    EXPECT_FALSE(fs::exists(unfinished));
    expectSame(merge({"2.shard", "1.shard"}), whole);
}

TEST_F(ReferenceShards, ThatRanTwiceOrOverlappedChangeNothing) {
    const Reference whole = undivided();
    RunOptions stopping;
    stopping.progress = [](const Progress&) { return false; };
    compute({1, 2}, "1.shard", stopping);
    fs::copy_file(unfinishedPart(temporary_ / "1.shard"), temporary_ / "killed.shard");
    compute({1, 2}, "1.shard");
    compute({1, 2}, "again.shard");
    compute({2, 2}, "2.shard");
    EXPECT_TRUE(compute({2, 2}, "2.shard").wasComplete);
    std::vector<std::string> names = {"1.shard", "2.shard", "again.shard", "killed.shard"};
    do {
        expectSame(merge(names), whole);
        EXPECT_TRUE(messages_.empty());
    } while (std::next_permutation(names.begin(), names.end()));
}

TEST_F(ReferenceShards, OfMachinesThatRoundDifferentlyAreToldAndGiveTheSameInAnyOrder) {
    compute({1, 2}, "1.shard");
    compute({2, 2}, "2.shard");
    // The same batches with another value in one of them.
    PartHead head = readPartHead(temporary_ / "1.shard");
    PixelSums sums = makeSums(embree_, request_);
    for (std::uint64_t batch = head.own().first; batch < head.own().end; ++batch) {
        BatchResult result;
        result.values.assign(
            static_cast<std::size_t>(sums.width() * sums.height() * sums.layers() * 3), 1.0);
        sums.add(batch, result);
    }
    writePart(temporary_ / "other.shard", head, sums);
    const Reference one = merge({"1.shard", "2.shard", "other.shard"});
    ASSERT_EQ(messages_.size(), 1u);
    EXPECT_NE(messages_[0].find("other.shard"), std::string::npos);
    expectSame(merge({"other.shard", "1.shard", "2.shard"}), one);
}

TEST_F(ReferenceShards, OfDifferentThingsAreRefusedByWhatTheyDifferIn) {
    compute({1, 2}, "1.shard");
    const auto refusal = [&](const std::string& with) {
        return test::messageOf<ConfigError>([&] {
            static_cast<void>(merge({"1.shard", with}, true));
        });
    };
    const auto expectRefusal = [&](const char* name, const std::string& reason) {
        const std::string message = refusal(name);
        EXPECT_NE(message.find(name), std::string::npos) << message;
        EXPECT_NE(message.find(reason), std::string::npos) << message;
    };
    compute({2, 3}, "thirds.shard");
    expectRefusal("thirds.shard", "number of shards 3 instead of 2");
    compute({2, 2}, "version.shard");
    changeVersion("version.shard");
    expectRefusal("version.shard", "version 0.0.9 instead of " + versionString());
    const ReferenceRequest request = request_;
    request_.width = 32;
    compute({2, 2}, "size.shard");
    expectRefusal("size.shard", "size 32x18 instead of 24x18");
    request_ = request;
    request_.seed = 7;
    compute({2, 2}, "seed.shard");
    expectRefusal("seed.shard", "seed 7 instead of 1");
    request_ = request;
    request_.estimator = Estimator::sppm;
    compute({2, 2}, "sppm.shard");
    expectRefusal("sppm.shard", "another estimator");
    request_ = request;
    request_.filter.transmissionOnly = true;
    compute({2, 2}, "paths.shard");
    expectRefusal("paths.shard", "other settings");
}

TEST_F(ReferenceShards, OfAnotherVersionInItsPlaceIsNotReplaced) {
    compute({1, 2}, "1.shard");
    changeVersion("1.shard");
    const std::string message = test::messageOf<ConfigError>([&] { compute({1, 2}, "1.shard"); });
    EXPECT_NE(message.find("version 0.0.9"), std::string::npos) << message;
    EXPECT_EQ(readPartHead(temporary_ / "1.shard").version, "0.0.9");
}

TEST_F(ReferenceShards, WithDamageAnywhereAreRefusedByNameAndComputedAgain) {
    compute({1, 2}, "1.shard");
    const fs::path file = temporary_ / "1.shard";
    const std::string bytes = readFile(file);
    const Reference whole = undivided();
    compute({2, 2}, "2.shard");
    const std::size_t headEnd = bytes.find('\n', bytes.find('\n') + 1);
    std::vector<std::string> damaged = {"", bytes.substr(0, 10), bytes.substr(0, headEnd + 3),
                                        bytes.substr(0, bytes.size() - 1), bytes + "x"};
    // Not in the last byte before the checksum's four, where zlib may have bits that it does not
    // use.
    for (const std::size_t place :
         {std::size_t{3}, std::size_t{40}, headEnd + 4, headEnd + 60, bytes.size() - 6}) {
        damaged.push_back(bytes);
        damaged.back()[place] = static_cast<char>(damaged.back()[place] ^ 4);
    }
    for (const std::string& wrong : damaged) {
        std::ofstream(file, std::ios::binary) << wrong;
        const std::string message = test::messageOf<IoError>([&] {
            static_cast<void>(merge({"2.shard", "1.shard"}));
        });
        EXPECT_NE(message.find("1.shard"), std::string::npos) << message;
    }
    compute({1, 2}, "1.shard");
    ASSERT_EQ(messages_.size(), 1u);
    EXPECT_NE(messages_[0].find("1.shard"), std::string::npos);
    expectSame(merge({"2.shard", "1.shard"}), whole);
}

}  // namespace
}  // namespace kaustik::reference
