// SPDX-License-Identifier: MIT
// Classes of paths: their watts against closed forms by Fresnel, and that they are all of the light
// to the last bit, however it is computed.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/layered_image.h"
#include "framework/reference/class_file.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/path_census.h"
#include "framework/reference/shards.h"
#include "framework/scene/files/scene_file.h"
#include "tests/accuracy/path_fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

// Of unpolarised light on glass from outside; `cosine` of the angle of incidence.
double fresnel(double cosine, double index) {
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (index * cosine - inside) / (index * cosine + inside);
    return 0.5 * (s * s + p * p);
}

scene::Mesh slab() {
    scene::BoxShape shape;
    shape.size = glm::dvec3(1.0, 0.002, 1.0);
    return makeBox(shape);
}

scene::Light pointLight(const glm::dvec3& position) {
    scene::Light light;
    light.kind = scene::LightKind::point;
    light.position = position;
    return light;
}

ReferenceRequest smallRequest() {
    ReferenceRequest request;
    request.width = 64;
    request.height = 48;
    return request;
}

// A diffuse room that all light ends in.
void addRoom(scene::Scene& scene) {
    scene::BoxShape shape;
    shape.size = glm::dvec3(40.0);
    shape.inward = true;
    addObject(scene, makeBox(shape), scene::Material{});
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        scene.objects[i].name = "object" + std::to_string(i);
}

class Counted {
  public:
    explicit Counted(const scene::Scene& scene) : embree_(scene) {
        census_ = takeCensus(embree_, request_, {1u << 21, 0, {}});
    }
    [[nodiscard]] PathFlux of(const std::string& pattern) const {
        const PathPattern wanted(pattern, "test");
        return census_.fluxOf([&](const ArrivedPath& path) { return wanted.matches(path.word); });
    }
    // The share of all the light that hits a specular surface.
    void expectShare(const std::string& pattern, double share, double meshError = 0.0) const {
        const double emitted = census_.energy.watts[transport::kAccountEmitted];
        const PathFlux flux = of(pattern);
        // Of some 20 shares that are looked at here one is off by more in 10^4 runs.
        EXPECT_NEAR(flux.watts / emitted, share,
                    4.5 * flux.wattsError / emitted + meshError * share)
            << pattern;
        EXPECT_LT(flux.wattsError / emitted, 0.02 * share + 1e-5) << pattern;
    }
    [[nodiscard]] const PathCensus& census() const { return census_; }

  private:
    ReferenceRequest request_ = smallRequest();
    EmbreeScene embree_;
    PathCensus census_;
};

TEST(PathClasses, OfASlabHaveTheSharesThatFresnelGives) {
    // Far above the middle, so that all light meets it at nearly a right angle, and only its top.
    scene::Scene scene = sceneOf(slab(), glass(1.5));
    scene.lights.push_back(pointLight({0.0, 15.0, 0.0}));
    addRoom(scene);
    const Counted counted(scene);
    const double f = std::pow(0.5 / 2.5, 2.0);
    // At the slab's corners the angle is 2.7 degrees, where Fresnel's share is the same to 1e-5.
    // Next to the rim, over some 0.002 tan 1.3 degrees of each side, light meets a side from
    // within, is totally reflected and counts as another word: 2e-4 of it.
    const double rim = 4e-4;
    counted.expectShare("R", f, rim);
    counted.expectShare("TT", (1.0 - f) * (1.0 - f), rim);
    counted.expectShare("TRT", (1.0 - f) * f * (1.0 - f), rim / f);
    counted.expectShare("TRRT", (1.0 - f) * f * f * (1.0 - f), rim / f);
    counted.expectShare("S+", 1.0);
}

TEST(PathClasses, OfABallHaveTheSharesThatFresnelGives) {
    constexpr double kDistance = 10.0;
    constexpr double kBallRadius = 0.5;
    constexpr double kIndex = 1.5;
    scene::SphereShape shape;
    shape.radius = kBallRadius;
    shape.segments = 256;
    scene::Scene scene = sceneOf(makeSphere(shape), glass(kIndex));
    scene.lights.push_back(pointLight({kDistance, 0.0, 0.0}));
    addRoom(scene);
    const Counted counted(scene);
    // A ray at the angle a from the axis comes in at sin i = d sin a / r, and at each surface that
    // it meets inside the same share is reflected. Evenly in the solid angle, by the midpoint rule.
    const auto shareOf = [&](auto&& term) {
        const double edge = std::sqrt(1.0 - std::pow(kBallRadius / kDistance, 2.0));
        constexpr int kSteps = 200000;
        double sum = 0.0;
        for (int step = 0; step < kSteps; ++step) {
            const double cosine = 1.0 - (1.0 - edge) * (step + 0.5) / kSteps;
            const double sine2 = (1.0 - cosine * cosine) * std::pow(kDistance / kBallRadius, 2.0);
            sum += term(fresnel(std::sqrt(std::max(0.0, 1.0 - sine2)), kIndex)) / kSteps;
        }
        return sum;
    };
    // Facets of 1.4 degrees with interpolated normals.
    const double facets = 0.003;
    counted.expectShare("R", shareOf([](double f) { return f; }), facets);
    counted.expectShare("TT", shareOf([](double f) { return (1 - f) * (1 - f); }), facets);
    counted.expectShare("TRT", shareOf([](double f) { return (1 - f) * f * (1 - f); }), facets);
    counted.expectShare("TRRT", shareOf([](double f) { return (1 - f) * f * f * (1 - f); }), 0.02);
    counted.expectShare("S+", 1.0);
}

TEST(PathClasses, OfAMirrorAreItsReflectanceAndNothingElse) {
    scene::Material half = mirror();
    half.albedo = glm::vec3(0.5f);
    scene::Scene scene = sceneOf(makePlane(scene::PlaneShape{}), half);
    scene.lights.push_back(pointLight({0.2, 3.0, 0.1}));
    addRoom(scene);
    const Counted counted(scene);
    counted.expectShare("R", 0.5, 1e-6);
    ASSERT_EQ(counted.census().paths.size(), 1u);
    EXPECT_EQ(counted.census().paths[0].path.firstObject, 0u);
}

// What a census says of the paths that a filter follows is what tracing with that filter finds.
TEST(PathClasses, ThatAFilterFollowsHaveTheLightThatItFinds) {
    const scene::Scene scene = scene::loadScene("concave-glass");
    const EmbreeScene embree(scene);
    ReferenceRequest request = smallRequest();
    const PathCensus census = takeCensus(embree, request, {1u << 19, 0, {}});
    double least = census.all.watts;
    for (const auto& [transmission, reflection, interactions] : {std::tuple(true, false, 64),
                                                                 {true, false, 2},
                                                                 {false, true, 64},
                                                                 {false, false, 2},
                                                                 {false, false, 4}}) {
        request.filter.transmissionOnly = transmission;
        request.filter.reflectionOnly = reflection;
        request.filter.maximumInteractions = interactions;
        const PathFlux told = census.fluxOf(
            [&](const ArrivedPath& path) { return isFollowed(path, request.filter); });
        ++request.seed;  // so that the noise of both is independent
        const PathCensus found = takeCensus(embree, request, {1u << 19, 0, {}});
        const double error = std::hypot(told.wattsError, found.all.wattsError);
        EXPECT_NEAR(told.watts, found.all.watts, 4.5 * error) << interactions;
        EXPECT_LT(error, 0.01 * told.watts);
        least = std::min(least, told.watts);
    }
    EXPECT_LT(least, 0.5 * census.all.watts) << "the filters leave little out";
}

TEST(PathClasses, AreCountedTheSameByAnyNumberOfThreads) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const EmbreeScene embree(scene);
    const ReferenceRequest request = smallRequest();
    const PathCensus one = takeCensus(embree, request, {1u << 16, 1, {}});
    const PathCensus four = takeCensus(embree, request, {1u << 16, 4, {}});
    ASSERT_EQ(one.paths.size(), four.paths.size());
    for (std::size_t i = 0; i < one.paths.size(); ++i) {
        EXPECT_EQ(one.paths[i].path, four.paths[i].path);
        EXPECT_EQ(one.paths[i].flux.watts, four.paths[i].flux.watts);
    }
    double sum = 0.0;
    for (const CountedPath& counted : one.paths)
        sum += counted.flux.watts;
    EXPECT_NEAR(sum, one.energy.watts[transport::kAccountDeposited], 1e-12 * sum);
    EXPECT_TRUE(takeCensus(embree, request, {1u << 16, 1, [](std::uint64_t) { return false; }})
                    .byBatch.empty());
}

class ClassReference : public testing::Test {
  protected:
    ClassReference() {
        request_.width = 32;
        request_.height = 24;
        request_.photonsPerBatch = 3000;
    }
    void keep(const ClassOrder& order) {
        request_.classes = chooseClasses(embree_, request_, order, "--class", "--classes");
    }
    [[nodiscard]] PixelSums sums(int threads = 0) const {
        PixelSums sums = makeSums(embree_, request_);
        RunOptions options;
        options.stop.photons = kPhotons;
        options.threads = threads;
        addBatches(embree_, request_, options, sums);
        return sums;
    }
    [[nodiscard]] Reference undivided() const {
        return makeReference(scene_, request_, sums(), 0.0);
    }
    [[nodiscard]] Reference inShards(std::uint64_t count) const {
        std::vector<fs::path> files;
        for (std::uint64_t number = 1; number <= count; ++number) {
            files.push_back(temporary_ / (std::to_string(number) + ".shard"));
            static_cast<void>(computeShard(embree_, request_,
                                           {{number, count}, kPhotons, files.back()}, {},
                                           [](const std::string&) {}));
        }
        return mergeParts(files, {});
    }
    static void expectSame(const Reference& one, const Reference& other) {
        EXPECT_EQ(one.key, other.key);
        EXPECT_EQ(one.irradiance.values, other.irradiance.values);
        ASSERT_EQ(one.classes.size(), other.classes.size());
        for (std::size_t k = 0; k < one.classes.size(); ++k) {
            EXPECT_EQ(one.classes[k].name, other.classes[k].name);
            EXPECT_EQ(one.classes[k].pattern, other.classes[k].pattern);
            EXPECT_EQ(one.classes[k].irradiance.values, other.classes[k].irradiance.values);
            EXPECT_EQ(one.classes[k].irradianceError.values,
                      other.classes[k].irradianceError.values);
        }
    }

    static constexpr std::uint64_t kPhotons = 30000;
    scene::Scene scene_ = scene::loadScene("glass-sphere");
    EmbreeScene embree_{scene_};
    test::TemporaryFolder temporary_;
    ReferenceRequest request_;
};

TEST_F(ClassReference, AddsUpToTheWholeExactly) {
    keep({{"inside=TRRT"}, 3, false});
    ASSERT_EQ(request_.classes.size(), 4u);
    const PixelSums found = sums();
    const int first = firstClassLayer(scene_);
    ASSERT_EQ(found.layers(), first + 5);
    const std::size_t values = static_cast<std::size_t>(request_.width * request_.height) * 3;
    int mixed = 0;
    for (std::size_t i = 0; i < values; ++i) {
        // The means have a common factor, a power of two and the number of batches; times that they
        // are whole numbers, and their sums in double are exact.
        const double units = static_cast<double>(found.batchCount()) / found.quantum();
        const auto unitsOf = [&](int layer) {
            return std::nearbyint(found.mean(static_cast<std::size_t>(layer) * values + i) * units);
        };
        double sum = 0.0;
        int lit = 0;
        for (int layer = first; layer < found.layers(); ++layer) {
            const double of = unitsOf(layer);
            EXPECT_GE(of, 0.0);
            sum += of;
            lit += of > 0.0 ? 1 : 0;
        }
        EXPECT_EQ(sum, unitsOf(kIrradianceLayer)) << "value " << i;
        mixed += lit > 1 ? 1 : 0;
    }
    EXPECT_GT(mixed, 50) << "few pixels have light of several classes";
}

TEST_F(ClassReference, LeavesTheWholeAsItIsWithoutClasses) {
    const Reference plain = undivided();
    keep({{}, 2, false});
    const Reference kept = undivided();
    EXPECT_EQ(plain.irradiance.values, kept.irradiance.values);
    EXPECT_EQ(plain.irradianceError.values, kept.irradianceError.values);
    EXPECT_EQ(plain.energy.watts, kept.energy.watts);
    EXPECT_NE(plain.key, kept.key);
}

TEST_F(ClassReference, IsTheSameInShardsByThreadsAndAfterAStop) {
    keep({{}, 3, true});
    const Reference whole = undivided();
    expectSame(inShards(3), whole);
    expectSame(makeReference(scene_, request_, sums(1), 0.0), whole);

    // Ended in the middle, written and read, it goes on.
    PixelSums part = makeSums(embree_, request_);
    RunOptions stopping;
    stopping.stop.photons = kPhotons;
    stopping.progress = [](const Progress& now) { return now.batches < 3; };
    addBatches(embree_, request_, stopping, part);
    ASSERT_LT(part.batchCount(), whole.batches);
    const std::string key = referenceKey(scene_, request_);
    PixelSums again = PixelSums::fromBytes(part.toBytes(key), key, "sums");
    RunOptions options;
    options.stop.photons = kPhotons;
    addBatches(embree_, request_, options, again);
    expectSame(makeReference(scene_, request_, again, 0.0), whole);
}

TEST_F(ClassReference, OfBrightestPathsAreThoseOfTheClosedForm) {
    keep({{}, 2, false});
    // Nine tenths pass straight through the ball, and what is left is mostly reflected outside.
    EXPECT_EQ(request_.classes, (std::vector<PathClass>{{"TT", "TT"}, {"R", "R"}}));
    keep({{"R"}, 2, true});
    ASSERT_EQ(request_.classes.size(), 3u);
    EXPECT_EQ(request_.classes[0].name, "R");
    EXPECT_TRUE(request_.classes[1].pattern.starts_with("TT@")) << request_.classes[1].pattern;
}

TEST_F(ClassReference, IsAFileOfNamedLayersThatAddUpWithinTheLastBit) {
    if (!hasImageModule()) GTEST_SKIP() << "no module writes .exr here";
    keep({{"inside=TR+T"}, 2, false});
    const Reference reference = undivided();
    const fs::path file = temporary_ / "ball.exr";
    writeReference(file, reference);
    expectSame(readReference(file), reference);

    const LayeredImage image = readLayers(temporary_ / "ball.classes.exr");
    for (const char* layer : {"", "error", "inside", "inside.error", "TT", "R.error", "other"})
        EXPECT_TRUE(image.hasLayer(layer)) << layer;
    EXPECT_EQ(image.attribute("kaustik.key"), reference.key);
    EXPECT_EQ(image.attribute("kaustik.class.inside"), "TR+T");
    const Image whole = image.layer("", "file");
    EXPECT_EQ(whole.values, reference.irradiance.values);
    for (std::size_t i = 0; i < whole.values.size(); ++i) {
        double sum = 0.0;
        for (const char* name : {"inside", "TT", "R", "other"})
            sum += static_cast<double>(image.layer(name, "file").values[i]);
        const float value = whole.values[i];
        const double ulp = static_cast<double>(std::nextafter(value, HUGE_VALF) - value);
        ASSERT_LE(std::abs(sum - static_cast<double>(value)), ulp) << "value " << i;
    }
    const ClassLayers read = readClasses(temporary_ / "ball.classes.exr");
    EXPECT_EQ(read.key, reference.key);
    EXPECT_EQ(read.photons, reference.photons);
    EXPECT_EQ(read.classes.size(), 4u);
}

TEST_F(ClassReference, FileOfSomethingElseIsRefused) {
    if (!hasImageModule()) GTEST_SKIP() << "no module writes .exr here";
    keep({{}, 1, false});
    Reference reference = undivided();
    const fs::path file = temporary_ / "ball.exr";
    writeReference(file, reference);
    const auto refusal = [](auto&& read) { return test::messageOf<IoError>(read); };
    EXPECT_NE(refusal([&] { static_cast<void>(readClasses(file)); }).find("is no file of classes"),
              std::string::npos);
    // Classes of another reference under the name.
    reference.classes[0].irradiance.values[0] += 1.0f;
    writeClasses(classFile(file), reference);
    EXPECT_NE(refusal([&] { static_cast<void>(readReference(file)); }).find("does not belong"),
              std::string::npos);
    const std::string bytes = readFile(classFile(file));
    writeFileWhole(classFile(file), bytes.substr(0, bytes.size() / 2));
    EXPECT_NE(refusal([&] { static_cast<void>(readClasses(classFile(file))); }).find("cut off"),
              std::string::npos);
    reference.classes[0].irradiance.values[0] = NAN;
    EXPECT_NE(refusal([&] { writeClasses(classFile(file), reference); }).find("no numbers"),
              std::string::npos);
}

}  // namespace
}  // namespace kaustik::reference
