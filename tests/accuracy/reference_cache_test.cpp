// SPDX-License-Identifier: MIT
// References in files and in the cache: whole, of the right scene, or made again.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/reference/reference.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

class ReferenceCache : public testing::Test {
  protected:
    ReferenceCache() {
        request_.width = 24;
        request_.height = 18;
        request_.photonsPerBatch = 2000;
        options_.stop.batches = 4;
    }
    Reference load() {
        messages_.clear();
        return loadOrCompute(embree_, request_, folder_, options_,
                             [this](const std::string& message) { messages_.push_back(message); });
    }
    [[nodiscard]] fs::path entry(const std::string& ending) const {
        return folder_ / (referenceKey(scene_, request_) + ending);
    }

    scene::Scene scene_ = scene::loadScene("ring");
    EmbreeScene embree_{scene_};
    test::TemporaryFolder temporary_;
    fs::path folder_ = temporary_ / "cache";
    ReferenceRequest request_;
    RunOptions options_;
    std::vector<std::string> messages_;
};

TEST_F(ReferenceCache, SecondLoadComputesNothingAndGivesTheSame) {
    const Reference made = load();
    options_.progress = [](const Progress&) -> bool {
        ADD_FAILURE() << "computed again";
        return false;
    };
    const Reference cached = load();
    EXPECT_EQ(cached.irradiance.values, made.irradiance.values);
    EXPECT_EQ(cached.irradianceError.values, made.irradianceError.values);
    EXPECT_EQ(cached.batches, 4u);
    EXPECT_EQ(cached.energy.watts[0], made.energy.watts[0]);
    EXPECT_TRUE(messages_.empty());
}

TEST_F(ReferenceCache, CausticRadianceIsKeptWhereAReceiverIsGlossy) {
    EXPECT_TRUE(load().causticRadiance.values.empty());
    const scene::Scene scene = scene::loadScene("glossy-table");
    const EmbreeScene embree(scene);
    for (const Estimator estimator : {Estimator::light, Estimator::sppm}) {
        request_.estimator = estimator;
        request_.causticView = estimator == Estimator::sppm;
        const auto get = [&] {
            return loadOrCompute(embree, request_, folder_, options_, [](const std::string&) {});
        };
        const Reference made = get();
        const Reference cached = get();
        EXPECT_EQ(made.causticRadiance.values.size(), made.irradiance.values.size());
        EXPECT_EQ(cached.causticRadiance.values, made.causticRadiance.values);
        EXPECT_EQ(cached.causticRadianceError.values, made.causticRadianceError.values);
        EXPECT_TRUE(cached.inScattered.values.empty());
        EXPECT_EQ(cached.causticView.values.empty(), estimator == Estimator::light);
        EXPECT_EQ(cached.causticView.values, made.causticView.values);
        EXPECT_EQ(cached.request.causticView, request_.causticView);
        const fs::path file = folder_ / (made.key + ".caustic_radiance" + floatImageExtension());
        writeImage(file, made.irradiance);
        EXPECT_THROW((void)readReference(folder_ / (made.key + floatImageExtension())), IoError);
    }
}

TEST_F(ReferenceCache, MoreBatchesGoOnFromTheOnesThatAreThere) {
    options_.stop.batches = 9;
    request_.seed = 5;
    const Reference whole = load();
    fs::remove_all(folder_);
    options_.stop.batches = 4;
    (void)load();
    options_.stop.batches = 9;
    std::uint64_t computed = 0;
    options_.progress = [&](const Progress&) {
        ++computed;
        return true;
    };
    EXPECT_EQ(load().irradiance.values, whole.irradiance.values);
    EXPECT_EQ(computed, 5u);
}

TEST_F(ReferenceCache, AnEndInTheMiddleOfABatchKeepsTheWholeOnes) {
    request_.photonsPerBatch = 8 * kPhotonsPerPulse;
    options_.stop.batches = 3;
    options_.threads = 1;
    const Reference three = load();
    options_.stop.batches = 1000;
    std::atomic<std::uint64_t> maximum = 0;
    std::atomic<int> calls = 0;
    // A batch of a thousand is ended after a quarter of it.
    options_.pulse = [&](std::uint64_t photons) {
        maximum = std::max(maximum.load(), photons);
        ++calls;
        return photons < 2 * kPhotonsPerPulse;
    };
    const Reference ended = load();
    EXPECT_EQ(ended.irradiance.values, three.irradiance.values);
    EXPECT_EQ(ended.batches, 3u);
    EXPECT_EQ(maximum, 2 * kPhotonsPerPulse);
    EXPECT_LT(calls, 10);
}

TEST_F(ReferenceCache, DamagedEntriesAreReportedAndMadeAgain) {
    const Reference made = load();
    const std::string image = floatImageExtension();
    for (const std::string& ending : {image, ".stderr" + image, std::string(".json")}) {
        const fs::path file = entry(ending);
        const std::string bytes = readFile(file);
        writeFileWhole(file, std::string_view(bytes).substr(0, bytes.size() / 2));
        const Reference again = load();
        EXPECT_EQ(again.irradiance.values, made.irradiance.values) << ending;
        ASSERT_EQ(messages_.size(), 1u) << ending;
        EXPECT_NE(messages_[0].find("damaged"), std::string::npos) << messages_[0];
        EXPECT_NO_THROW((void)readReference(entry(image))) << ending;
    }
    fs::remove(entry(image));
    EXPECT_EQ(load().irradiance.values, made.irradiance.values);
    EXPECT_EQ(messages_.size(), 1u);
}

TEST_F(ReferenceCache, DamagedSumsAreReportedAndBegunAgain) {
    const Reference made = load();
    std::string sums = readFile(entry(".sums"));
    sums[sums.size() / 2] = static_cast<char>(sums[sums.size() / 2] ^ 1);
    writeFileWhole(entry(".sums"), sums);
    fs::remove(entry(".json"));
    EXPECT_EQ(load().irradiance.values, made.irradiance.values);
    ASSERT_EQ(messages_.size(), 1u);
    EXPECT_NE(messages_[0].find("checksum"), std::string::npos) << messages_[0];
    // Cut off at any place.
    for (std::size_t size = 0; size < sums.size(); size += 1 + sums.size() / 97) {
        EXPECT_THROW((void)PixelSums::fromBytes(std::string_view(sums).substr(0, size),
                                                referenceKey(scene_, request_), "cut"),
                     IoError);
    }
}

// A right checksum says that bytes are as they were written, not who wrote them.
// Each of what they must have in common alone.
TEST(SumsOfShards, AreMergedOnlyWhereTheyAreOfOneReference) {
    const PixelSums sums(2, 3, 1, 1.0, 1.0);
    PixelSums alike(2, 3, 1, 1.0, 1.0);
    EXPECT_NO_THROW(alike.merge(sums));
    for (const PixelSums& other :
         {PixelSums(3, 3, 1, 1.0, 1.0), PixelSums(2, 4, 1, 1.0, 1.0), PixelSums(2, 3, 2, 1.0, 1.0),
          PixelSums(2, 3, 1, 1e6, 1.0), PixelSums(2, 3, 1, 1.0, 1e6)}) {
        PixelSums into = sums;
        EXPECT_THROW(into.merge(other), ConfigError);
    }
}

TEST(SumsInAFile, ThatNoRunMakesAreRefused) {
    PixelSums sums(2, 1, 1, 1.0, 1.0);
    BatchResult batch;
    batch.values.assign(6, 1.0);
    sums.add(3, batch);
    const std::string whole = sums.toBytes("key");
    const std::string content = whole.substr(0, whole.size() - 32);
    const auto problemWith = [&](std::size_t place, auto value) {
        std::string changed = content;
        std::memcpy(changed.data() + place, &value, sizeof(value));
        const std::string bytes = changed + ContentHash().addBytes(changed).hex();
        return test::messageOf<IoError>(
            [&] { static_cast<void>(PixelSums::fromBytes(bytes, "key", "a.sums")); });
    };
    // After 15 bytes of "kaustik.sums/3", 8 of a size and the 3 of the key.
    const std::size_t width = 26, layers = 34, unit = 38, ranges = 78, first = 86, end = 94;
    const std::size_t sum = content.size() - 2 * 6 * sizeof(Int128);
    EXPECT_EQ(problemWith(width, 2), "") << "as it was";
    EXPECT_NE(problemWith(width, std::int64_t{0x0000'ffff'7fff'ffff}), "") << "height 65535";
    EXPECT_NE(problemWith(layers, 1 << 30), "");
    EXPECT_NE(problemWith(unit, 0.0), "");
    EXPECT_NE(problemWith(unit, std::numeric_limits<double>::quiet_NaN()), "");
    EXPECT_NE(problemWith(ranges, std::uint64_t{1} << 20), "") << "more than the file has";
    EXPECT_NE(problemWith(first, std::uint64_t{4}), "") << "from 4 to 4";
    EXPECT_NE(problemWith(end, std::uint64_t{1} << 60), "") << "2^60 batches";
    EXPECT_NE(problemWith(sum, Int128{1} << 126 | 1), "") << "two of them would overflow";
    EXPECT_NE(problemWith(sum + 6 * sizeof(Int128), Int128{-1}), "") << "a square below 0";
}

TEST_F(ReferenceCache, ASidecarThatIsNestedTooDeepIsAnError) {
    const Reference made = load();
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    writeFileWhole(entry(".json"), "{\"images\": " + deep + "}");
    EXPECT_EQ(load().irradiance.values, made.irradiance.values);
    ASSERT_EQ(messages_.size(), 1u);
    EXPECT_NE(messages_[0].find("nested more than 64 deep"), std::string::npos) << messages_[0];
}

TEST_F(ReferenceCache, ValuesThatAreNoNumbersAreNeverWrittenNorBelieved) {
    Reference bad = load();
    bad.irradiance.values[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(writeReference(folder_ / ("bad" + floatImageExtension()), bad), IoError);
    EXPECT_FALSE(fs::exists(folder_ / "bad.json"));
    writeImage(entry(floatImageExtension()), bad.irradiance);
    (void)load();
    EXPECT_EQ(messages_.size(), 1u);
}

TEST_F(ReferenceCache, KeyDependsOnEverythingThatMatters) {
    const std::string key = referenceKey(scene_, request_);
    const auto differs = [&](auto change) {
        scene::Scene scene = scene_;
        ReferenceRequest request = request_;
        change(scene, request);
        return referenceKey(scene, request) != key;
    };
    using S = scene::Scene;
    using R = ReferenceRequest;
    EXPECT_TRUE(differs([](S& s, R&) { s.camera.position.x += 1e-9; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.lights[0].power.g += 1e-3f; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.materials[1].albedo.r = 0.94f; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.materials[0].kind = scene::MaterialKind::glossy; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.materials[0].specular.b = 0.1f; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.materials[0].exponent = 51.0f; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.lights[0].image = 0; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.lights[0].up.x = 0.1; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.meshes[1].positions[5].y += 1e-6f; }));
    EXPECT_TRUE(differs(
        [](S& s, R&) { std::swap(s.meshes[1].triangles[0].x, s.meshes[1].triangles[0].y); }));
    EXPECT_TRUE(differs([](S& s, R&) { s.objects[1].toWorld[3].x += 1e-9; }));
    EXPECT_TRUE(differs([](S& s, R&) { s.medium = scene::Medium{}; }));
    EXPECT_TRUE(differs([](S&, R& r) { r.width = 25; }));
    EXPECT_TRUE(differs([](S&, R& r) { r.seed = 2; }));
    EXPECT_TRUE(differs([](S&, R& r) { r.estimator = Estimator::sppm; }));
    EXPECT_FALSE(differs([](S&, R& r) { r.causticView = true; }));  // light tracing has none
    EXPECT_TRUE(differs([](S&, R& r) { r.filter.transmissionOnly = true; }));
    EXPECT_TRUE(differs([](S&, R& r) { r.filter.reflectionOnly = true; }));
    EXPECT_TRUE(differs([](S&, R& r) { r.filter.maximumInteractions = 2; }));
    EXPECT_FALSE(differs([](S& s, R&) { s.description = "another"; }));
}

TEST_F(ReferenceCache, ReferenceOfAnotherSettingIsRefused) {
    const Reference made = load();
    const fs::path path = temporary_ / ("mine" + floatImageExtension());
    writeReference(path, made);
    EXPECT_EQ(readReference(path).irradiance.values, made.irradiance.values);
    EXPECT_EQ(readReference(path, made.key).key, made.key);
    EXPECT_THROW((void)readReference(path, "another"), ConfigError);
    EXPECT_THROW((void)readReference(temporary_ / "none.exr"), IoError);
}

}  // namespace
}  // namespace kaustik::reference
