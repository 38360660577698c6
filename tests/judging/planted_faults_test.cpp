// SPDX-License-Identifier: MIT
// Mistakes that are planted in a ray-traced picture of a real scene, with photons of another seed,
// are each named for what they are.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "framework/run/judge_work.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::run {
namespace {

using judge::Finding;
using judge::Subject;
using judge::Verdict;

constexpr const char* kBall = R"(
name = "ball"
[camera]
position = [1.5, 1.5, 2.4]
target = [0.25, 0.25, -0.05]
vertical_fov_degrees = 38
[[light]]
name = "lamp"
type = "point"
position = [-1.8, 3.0, 0.7]
power_watts = 8000
[[material]]
name = "table"
type = "lambertian"
albedo = [0.72, 0.68, 0.6]
[[material]]
name = "wall"
type = "lambertian"
albedo = [0.5, 0.6, 0.4]
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "table"
shape = "plane"
material = "table"
size = [6, 6]
[[object]]
name = "post"
shape = "box"
material = "wall"
size = [0.2, 0.5, 0.2]
position = [-0.7, 0.25, 0.6]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.5
position = [0, 0.7, 0]
segments = 128
)";

constexpr int kWidth = 80;
constexpr int kHeight = 60;
constexpr double kExposure = 2.7;

class PlantedFault : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new test::TemporaryFolder;
        ::setenv("KAUSTIK_CACHE", (*folder_ / "cache").c_str(), 1);
        scene_ = new scene::Scene(scene::loadSceneFile(folder_->file("ball.toml", kBall)));
        JudgedScene request;
        request.width = kWidth;
        request.height = kHeight;
        request.photons = 1 << 21;
        request.classes = 3;
        subject_ = new Subject(subjectOf(*scene_, request, &watch()));
    }
    static void TearDownTestSuite() {
        delete subject_;
        delete scene_;
        delete folder_;
    }
    static const Watch& watch() {
        static const Watch silent{[] { return true; }, [](double, const std::string&) {}};
        return silent;
    }

    using Change = std::function<void(scene::Scene&)>;
    static Image pictureOf(const Change& change, const std::string& without = "",
                           int pixelsAPixel = 1) {
        scene::Scene scene = *scene_;
        change(scene);
        JudgedScene request;
        request.width = kWidth * pixelsAPixel;
        request.height = kHeight * pixelsAPixel;
        request.photons = 1 << 21;
        request.seed = 77;
        request.classes = 3;
        request.causes = false;
        const Subject of = subjectOf(scene, request, &watch());
        Image picture = of.direct;
        for (const judge::Light& light : of.classes) {
            if (light.name == without) continue;
            for (std::size_t i = 0; i < picture.values.size(); ++i)
                picture.values[i] += light.radiance.values[i];
        }
        for (float& value : picture.values)
            value *= static_cast<float>(kExposure);
        return picture;
    }
    static void nothing(scene::Scene&) {}

    static Verdict judged(Image theirs) {
        Subject subject = *subject_;
        subject.theirsName = "theirs.exr";
        subject.theirs = std::move(theirs);
        return judge::judge(subject, {});
    }
    static const Finding* find(const Verdict& verdict, const std::string& name) {
        for (const Finding& finding : verdict.findings) {
            if (finding.name == name) return &finding;
        }
        return nullptr;
    }

    static void ofNoKindIsFoundInARightPicture();
    static void ofAMissingPathClassIsReported();
    static void ofTheIndexIsNamed();
    static void ofFlippedNormalsIsNamed();
    static void ofHalfAPixelIsNamed();
    static void ofAGammaIsNamed();

    static inline test::TemporaryFolder* folder_ = nullptr;
    static inline scene::Scene* scene_ = nullptr;
    static inline Subject* subject_ = nullptr;
};

void PlantedFault::ofNoKindIsFoundInARightPicture() {
    const Verdict verdict = judged(pictureOf(nothing));
    EXPECT_TRUE(verdict.findings.empty()) << toText(verdict);
    EXPECT_NEAR(verdict.exposure / kExposure, 1.0, 0.01);
    EXPECT_TRUE(verdict.hasDirect);
    EXPECT_TRUE(verdict.glassIsHidden);
}

void PlantedFault::ofAMissingPathClassIsReported() {
    for (const char* const name : {"TT", "R"}) {
        const Verdict verdict = judged(pictureOf(nothing, name));
        EXPECT_NE(find(verdict, std::string("missing:") + name), nullptr) << toText(verdict);
        EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
    }
}

void PlantedFault::ofTheIndexIsNamed() {
    const Verdict verdict = judged(pictureOf([](scene::Scene& scene) {
        for (scene::Material& material : scene.materials) {
            if (material.kind == scene::MaterialKind::dielectric) material.ior += 0.02f;
        }
    }));
    const Finding* const finding = find(verdict, "the index of refraction of 'glass'");
    ASSERT_NE(finding, nullptr) << toText(verdict);
    EXPECT_NEAR(finding->value, 0.02, 0.006) << toText(verdict);
    for (const judge::ClassVerdict& of : verdict.classes)
        EXPECT_NE(of.verdict, "missing") << toText(verdict);
}

void PlantedFault::ofFlippedNormalsIsNamed() {
    const Verdict verdict = judged(pictureOf([](scene::Scene& scene) {
        for (const scene::Object& object : scene.objects) {
            if (scene.materials[object.material].kind != scene::MaterialKind::dielectric) continue;
            scene::Mesh& mesh = scene.meshes[object.mesh];
            for (glm::vec3& normal : mesh.normals)
                normal = -normal;
            for (glm::uvec3& triangle : mesh.triangles)
                std::swap(triangle.y, triangle.z);
        }
    }));
    const Finding* const finding = find(verdict, "normals of 'ball'");
    ASSERT_NE(finding, nullptr) << toText(verdict);
    EXPECT_NEAR(finding->value, 1.0, 0.1) << toText(verdict);
}

void PlantedFault::ofHalfAPixelIsNamed() {
    // At twice the size half a pixel is a whole one.
    const Image large = pictureOf(nothing, "", 2);
    Image moved(kWidth, kHeight, 3);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (int c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (int i = 0; i < 4; ++i) {
                    sum += large.at(std::clamp(2 * x - 1 + i % 2, 0, large.width - 1),
                                    std::clamp(2 * y - 1 + i / 2, 0, large.height - 1), c);
                }
                moved.at(x, y, c) = 0.25f * sum;
            }
        }
    }
    const Verdict verdict = judged(moved);
    ASSERT_NE(find(verdict, "shift"), nullptr) << toText(verdict);
    // On a picture as small as this, whose light is nearly even outside of the caustic.
    EXPECT_NEAR(verdict.registration.shift.x, 0.5, 0.12) << toText(verdict);
    EXPECT_NEAR(verdict.registration.shift.y, 0.5, 0.12) << toText(verdict);
}

void PlantedFault::ofAGammaIsNamed() {
    Image theirs = pictureOf(nothing);
    for (float& value : theirs.values) {
        const double linear = 0.01 * static_cast<double>(value);
        value = static_cast<float>(
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
    }
    const Verdict verdict = judged(theirs);
    EXPECT_EQ(verdict.encoding, judge::Encoding::srgb) << toText(verdict);
    EXPECT_NE(find(verdict, "encoding"), nullptr);
}

// All in one, since what they are judged by takes most of the time.
TEST_F(PlantedFault, IsNamedWhateverItIs) {
    ofNoKindIsFoundInARightPicture();
    ofAMissingPathClassIsReported();
    ofTheIndexIsNamed();
    ofFlippedNormalsIsNamed();
    ofHalfAPixelIsNamed();
    ofAGammaIsNamed();
}

}  // namespace
}  // namespace kaustik::run
