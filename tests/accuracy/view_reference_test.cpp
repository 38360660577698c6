// SPDX-License-Identifier: MIT
// The reference of what the eye sees through specular surfaces, against closed forms: exits of a
// slab and of a ball, Snell's window, a furnace, direct light with its shadows, mirrors.
#include "framework/reference/view_reference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "framework/core/files.h"
#include "framework/reference/eye.h"
#include "framework/reference/optics.h"
#include "tests/accuracy/path_fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 30;

class ViewReferenceOf : public testing::Test {
  protected:
    ViewReferenceOf() {
        scene_.camera.position = {0.0, 0.0, 4.0};
        scene_.camera.target = {0.0, 0.0, 0.0};
        scene_.camera.verticalFovDegrees = 30.0;
        scene_.backgroundRadiance = glm::vec3(3.0f);
        request_.width = kWidth;
        request_.height = kHeight;
    }
    static scene::Material matt(float albedo) {
        scene::Material material;
        material.albedo = glm::vec3(albedo);
        return material;
    }
    [[nodiscard]] ViewReference trace() const { return traceView(EmbreeScene(scene_), request_); }

    // Calls with the world's ray through the middle of each pixel; the eye looks down -Z.
    void forEachRay(const std::function<void(int, int, const glm::dvec3&)>& call) const {
        const EmbreeScene embree(scene_);
        const Eye eye(embree, kWidth, kHeight);
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column)
                call(column, row, glm::normalize(eye.ray(column + 0.5, row + 0.5)));
        }
    }
    static glm::dvec3 vectorAt(const Image& image, int column, int row) {
        return {image.at(column, row, 0), image.at(column, row, 1), image.at(column, row, 2)};
    }

    scene::Scene scene_;
    ViewReferenceRequest request_;
};

// 32-bit outputs at 5 m.
constexpr double kRounding = 1e-6;

TEST_F(ViewReferenceOf, ASlabHasExitsParallelToTheEntryAndShiftedByTheClosedForm) {
    scene::BoxShape box;
    box.size = {6.0, 6.0, 1.0};
    addObject(scene_, scene::makeBox(box), glass(1.5));
    const ViewReference reference = trace();
    EXPECT_EQ(reference.pixels, std::size_t{kWidth} * kHeight);
    forEachRay([&](int column, int row, const glm::dvec3& ray) {
        EXPECT_EQ(reference.exitPosition.at(column, row, 3), 2.0f);
        EXPECT_EQ(reference.exitDirection.at(column, row, 3), 1.0f);
        EXPECT_LT(glm::distance(vectorAt(reference.exitDirection, column, row), ray), kRounding);
        // Sideways from the straight line by t sin(a - b)/cos b.
        const double a = std::acos(-ray.z);
        const double b = std::asin(std::sin(a) / 1.5);
        const glm::dvec3 exit = vectorAt(reference.exitPosition, column, row);
        EXPECT_NEAR(exit.z, -4.5, kRounding);
        EXPECT_NEAR(glm::length(exit - glm::dot(exit, ray) * ray), std::sin(a - b) / std::cos(b),
                    4.0 * kRounding);
    });
}

TEST_F(ViewReferenceOf, ABallHasItsExitsWhereTheClosedFormSays) {
    addObject(scene_, scene::makeSphere({1.0, 1024}), glass(1.5));
    const ViewReference reference = trace();
    int requested = 0;
    forEachRay([&](int column, int row, const glm::dvec3& ray) {
        const glm::dvec3 center(0.0, 0.0, -4.0);
        const double along = glm::dot(center, ray);
        const double square = glm::dot(center, center) - along * along;
        if (square > 0.81) return;
        ++requested;
        const glm::dvec3 entry = (along - std::sqrt(1.0 - square)) * ray;
        const Interface in = interactAt(ray, entry - center, 1.0, 1.5);
        const glm::dvec3 exit = entry - 2.0 * glm::dot(in.refracted, entry - center) * in.refracted;
        const Interface out = interactAt(in.refracted, center - exit, 1.5, 1.0);
        // Facets of 1/1024 of the circumference: 5e-6 of the radius deep.
        EXPECT_LT(glm::distance(vectorAt(reference.exitPosition, column, row), exit), 1e-4);
        EXPECT_LT(glm::distance(vectorAt(reference.exitDirection, column, row), out.refracted),
                  2e-4);
        EXPECT_EQ(reference.exitPosition.at(column, row, 3), 2.0f);
    });
    EXPECT_GT(requested, 100);
}

TEST_F(ViewReferenceOf, AFurnaceShowsNoGlassAtAll) {
    // Balls: light that has come in also gets out, which is not so in every shape.
    addObject(scene_, scene::makeSphere({0.7, 96}), glass(1.5), {-0.3, 0.0, 0.0});
    addObject(scene_, scene::makeSphere({0.4, 64}), glass(1.3), {0.5, 0.2, 1.0});
    const ViewReference reference = trace();
    ASSERT_GT(reference.pixels, 100u);
    std::size_t edges = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            if (reference.mask.at(column, row, 0) == 0.0f) continue;
            // Every branch ends at 3, and their shares add up to 1. Light that grazes facets is
            // caught by the normals interpolated over them: some at the silhouettes is missing.
            const float missing = 3.0f - reference.radiance.at(column, row, 1);
            EXPECT_LT(std::abs(missing), 0.1f) << column << " " << row;
            edges += std::abs(missing) > 3e-3f ? 1 : 0;
        }
    }
    EXPECT_LT(edges, reference.pixels / 20);
}

TEST_F(ViewReferenceOf, WaterFromBelowShowsTheSkyByTAndTheSquareOfTheIndex) {
    scene_.camera.position = {0.0, -1.0, 0.0};
    scene_.camera.target = {0.0, 0.0, 0.0};
    scene_.camera.up = {0.0, 0.0, -1.0};
    scene_.camera.verticalFovDegrees = 110.0;
    scene::PlaneShape plane;
    plane.size = {60.0, 60.0};
    addObject(scene_, scene::makePlane(plane), glass(1.333));
    request_.samplesPerSide = 2;
    const ViewReference reference = trace();
    const EmbreeScene embree(scene_);
    const Eye eye(embree, kWidth, kHeight);
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const glm::dvec3 ray = glm::normalize(eye.ray(column + 0.5, row + 0.5));
            const Interface at = interactAt(ray, {0.0, -1.0, 0.0}, 1.333, 1.0);
            EXPECT_EQ(reference.exitPosition.at(column, row, 3), 1.0f);
            // Far from the critical angle, where the reflectance changes within a pixel.
            const double sine = 1.333 * std::sqrt(1.0 - ray.y * ray.y);
            if (std::abs(sine - 1.0) < 0.15) continue;
            const double share = at.reflectance + (1.0 - at.reflectance) * 1.333 * 1.333;
            EXPECT_NEAR(reference.radiance.at(column, row, 0), 3.0 * share, 0.02);
        }
    }
}

TEST_F(ViewReferenceOf, AReceiverBehindGlassHasItsDirectAndItsFillLightAndTheShadowOfTheGlass) {
    scene_.ambientIrradiance = glm::vec3(0.5f);
    scene::Light sun;
    sun.direction = glm::normalize(glm::dvec3(0.0, -1.0, -1.0));
    sun.power = glm::vec3(10.0f);
    scene_.lights.push_back(sun);
    scene::BoxShape wall;
    wall.size = {20.0, 20.0, 0.1};
    addObject(scene_, scene::makeBox(wall), matt(0.6f), {0.0, 0.0, -2.05});
    // Glass of index 1 bends nothing but blocks direct light. The sun comes at 45 degrees: a pane 3
    // m before the wall has its shadow 3 m lower, and the eye sees that through the second pane.
    scene::BoxShape pane;
    pane.size = {20.0, 1.0, 0.01};
    addObject(scene_, scene::makeBox(pane), glass(1.0), {0.0, 0.0, 1.0});
    addObject(scene_, scene::makeBox(pane), glass(1.0), {0.0, -2.0, 1.0});
    scene_.camera.position = {0.0, -1.2, 4.0};
    scene_.camera.target = {0.0, -2.8, -2.0};
    const ViewReference reference = trace();
    const double fill = 0.6 / std::numbers::pi * 0.5;
    const double direct = 0.6 / std::numbers::pi * 10.0 * std::sqrt(0.5);
    int lit = 0;
    int dark = 0;
    forEachRay([&](int column, int row, const glm::dvec3& ray) {
        const double y = -1.2 + ray.y * 6.0 / -ray.z;
        // The second pane, less a pixel of 0.1 m.
        if (y < -3.7 || y > -1.9) return;
        if (std::abs(y + 3.0) < 0.4) {
            EXPECT_NEAR(reference.radiance.at(column, row, 1), fill, 1e-4);
            ++dark;
        } else if (std::abs(y + 3.0) > 0.6) {
            EXPECT_NEAR(reference.radiance.at(column, row, 1), fill + direct, 1e-4);
            ++lit;
        }
    });
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 100);
}

TEST_F(ViewReferenceOf, AMirrorShowsWhatIsBehindTheEye) {
    scene::BoxShape box;
    box.size = {3.0, 3.0, 0.1};
    addObject(scene_, scene::makeBox(box), mirror(), {0.0, 0.0, -0.05});
    scene_.ambientIrradiance = glm::vec3(2.0f);
    scene::BoxShape wall;
    wall.size = {40.0, 40.0, 0.1};
    addObject(scene_, scene::makeBox(wall), matt(0.5f), {0.0, 0.0, 9.0});
    const ViewReference reference = trace();
    int seen = 0;
    forEachRay([&](int column, int row, const glm::dvec3& ray) {
        if (reference.mask.at(column, row, 0) == 0.0f) return;
        ++seen;
        const glm::dvec3 reflected(ray.x, ray.y, -ray.z);
        EXPECT_EQ(reference.exitPosition.at(column, row, 3), 1.0f);
        EXPECT_LT(glm::distance(vectorAt(reference.exitDirection, column, row), reflected),
                  kRounding);
        const glm::dvec3 exit = ray * (4.0 / -ray.z);
        EXPECT_LT(glm::distance(vectorAt(reference.exitPosition, column, row), exit),
                  4.0 * kRounding);
        // Pixels at its edge see some of what is next to it.
        if (std::abs(exit.x) < 1.3 && std::abs(exit.y) < 1.0) {
            EXPECT_NEAR(reference.radiance.at(column, row, 1), 1.0 / std::numbers::pi, 1e-5);
        }
    });
    EXPECT_GT(seen, 500);
}

TEST_F(ViewReferenceOf, TheSameRequestIsTheSameAtAnyNumberOfThreads) {
    addObject(scene_, scene::makeSphere({1.0, 64}), glass(1.5));
    request_.threads = 1;
    const ViewReference one = trace();
    request_.threads = 3;
    const ViewReference three = trace();
    EXPECT_EQ(one.radiance.values, three.radiance.values);
    EXPECT_EQ(one.exitPosition.values, three.exitPosition.values);
}

TEST_F(ViewReferenceOf, WhatIsKeptIsWhatWasTracedAndOfThatSceneAlone) {
    addObject(scene_, scene::makeSphere({1.0, 64}), glass(1.5));
    const test::TemporaryFolder folder;
    std::vector<std::string> reports;
    const auto load = [&] {
        return loadOrTraceView(EmbreeScene(scene_), request_, folder / "cache",
                               [&](const std::string& report) { reports.push_back(report); });
    };
    const auto expectTraced = [&](const ViewReference& found) {
        const ViewReference traced = trace();
        EXPECT_GT(found.pixels, 100u);
        EXPECT_EQ(found.pixels, traced.pixels);
        EXPECT_EQ(found.mask.values, traced.mask.values);
        EXPECT_EQ(found.exitPosition.values, traced.exitPosition.values);
        EXPECT_EQ(found.exitDirection.values, traced.exitDirection.values);
        EXPECT_EQ(found.radiance.values, traced.radiance.values);
        EXPECT_EQ(found.radianceError.values, traced.radianceError.values);
    };
    const auto files = [&] {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "cache"))
            found.push_back(entry.path());
        return found;
    };
    expectTraced(load());
    ASSERT_EQ(files().size(), 1u);
    const std::string whole = readFile(files().front());
    expectTraced(load());
    EXPECT_TRUE(reports.empty());

    // Cut, or with a bit that is another.
    std::string other = whole;
    other[other.size() / 2] = static_cast<char>(other[other.size() / 2] ^ 1);
    for (const std::string& damaged : {whole.substr(0, whole.size() / 2), other, std::string()}) {
        reports.clear();
        writeFileWhole(files().front(), damaged);
        expectTraced(load());
        EXPECT_EQ(reports.size(), 1u);
        EXPECT_EQ(readFile(files().front()), whole);
    }

    scene_.camera.position.x = 0.3;
    expectTraced(load());
    request_.samplesPerSide = 2;
    expectTraced(load());
    EXPECT_EQ(files().size(), 3u);
}

}  // namespace
}  // namespace kaustik::reference
