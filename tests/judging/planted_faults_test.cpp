// SPDX-License-Identifier: MIT
// Mistakes that are planted in a ray-traced picture of a real scene, with photons of another seed,
// are each named for what they are.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>

#include "framework/core/error.h"
#include "framework/reference/wrong_fresnel.h"
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

// With so few photons that the references' noise is seen, which is none of the mistakes.
constexpr int kWidth = 160;
constexpr int kHeight = 120;
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

    static std::string refusal(Image theirs) {
        try {
            return "no refusal: " + toText(judged(std::move(theirs)));
        } catch (const ConfigError& error) {
            return error.what();
        }
    }

    static void ofNoKindIsFoundInARightPicture();
    static void ofTheFresnelFactorIsNamed();
    static void ofTheLightsPlaceIsNamed();
    static void ofTheCameraIsRefused();
    static void ofTheSceneIsRefused();
    static void ofAMissingPathClassIsReported();
    static void ofTheIndexIsNamed();
    static void ofFlippedNormalsIsNamed();
    static void ofHalfAPixelIsNamed();
    static void ofAGammaIsNamed();
    static void ofThePrimariesIsNamed();

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
    EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
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
    EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
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
    // Its light is nearly even outside of the caustic, and other mistakes together do the same.
    EXPECT_EQ(verdict.registration.shift, glm::dvec2(0.5, 0.5)) << toText(verdict);
    EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
    for (const judge::ClassVerdict& of : verdict.classes)
        EXPECT_TRUE(of.verdict == "there" || of.verdict == "cannot be told") << toText(verdict);
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
    EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
}

// By what colour a table and a post have, no more than from Rec. 709.
void PlantedFault::ofThePrimariesIsNamed() {
    Image theirs = pictureOf(nothing);
    // To Rec. 2020, by Rec. ITU-R BT.2087-0.
    const glm::mat3 matrix = glm::transpose(
        glm::mat3(0.6274f, 0.3293f, 0.0433f, 0.0691f, 0.9195f, 0.0114f, 0.0164f, 0.0880f, 0.8956f));
    for (std::size_t i = 0; i < theirs.values.size(); i += 3) {
        const glm::vec3 pixel =
            matrix * glm::vec3(theirs.values[i], theirs.values[i + 1], theirs.values[i + 2]);
        for (glm::length_t c = 0; c < 3; ++c)
            theirs.values[i + static_cast<std::size_t>(c)] = pixel[c];
    }
    const Verdict verdict = judged(theirs);
    EXPECT_EQ(verdict.primaries, judge::Primaries::rec2020) << toText(verdict);
    EXPECT_NE(find(verdict, "primaries"), nullptr) << toText(verdict);
    EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
}

// Each wrong law, as photons of another seed have it; they are planted on the whole picture.
void PlantedFault::ofTheFresnelFactorIsNamed() {
    scene::Scene scene = *scene_;
    const reference::EmbreeScene embree(scene);
    reference::WrongFresnelRequest request;
    request.width = kWidth;
    request.height = kHeight;
    request.photons = 1 << 21;
    request.seed = 78;
    const auto changes = reference::changesByWrongFresnel(embree, request);
    const std::array<std::string, 3> names = {"fresnel:lossless", "fresnel:schlick",
                                              "fresnel:swapped"};
    for (std::size_t k = 0; k < changes.size(); ++k) {
        Image theirs = pictureOf(nothing);
        for (std::size_t i = 0; i < theirs.values.size(); ++i) {
            theirs.values[i] +=
                static_cast<float>(kExposure) * changes[k].values[i] * subject_->fill.values[i];
        }
        const Verdict verdict = judged(theirs);
        EXPECT_NE(find(verdict, names[k]), nullptr) << toText(verdict);
        for (const judge::ClassVerdict& of : verdict.classes)
            EXPECT_NE(of.verdict, "missing") << toText(verdict);
    }
}

// It moves shadows and caustics, and is no other camera.
void PlantedFault::ofTheLightsPlaceIsNamed() {
    const Verdict verdict = judged(pictureOf(
        [](scene::Scene& scene) { scene.lights.front().position += glm::dvec3(0.03, 0.0, 0.02); }));
    const bool isNamed =
        std::any_of(verdict.findings.begin(), verdict.findings.end(), [](const Finding& finding) {
            return finding.name.starts_with("the place of light 'lamp'");
        });
    EXPECT_TRUE(isNamed) << toText(verdict);
    for (const judge::ClassVerdict& of : verdict.classes)
        EXPECT_NE(of.verdict, "missing") << toText(verdict);
}

void PlantedFault::ofTheCameraIsRefused() {
    const std::vector<std::pair<const char*, Change>> cameras = {
        {"10 cm to the side",
         [](scene::Scene& scene) { scene.camera.position += glm::dvec3(0.1, 0.0, -0.06); }},
        {"from the other side",
         [](scene::Scene& scene) {
             scene.camera.position = {-1.5, 1.5, 2.4};
         }},
        {"from above",
         [](scene::Scene& scene) {
             scene.camera.position = {0.3, 3.2, 0.4};
         }},
        {"elsewhere", [](scene::Scene& scene) {
             scene.camera.target = {-0.7, 0.25, 0.6};
         }}};
    for (const auto& [name, change] : cameras) {
        const std::string said = refusal(pictureOf(change));
        EXPECT_NE(said.find("does not show ball"), std::string::npos) << name << ": " << said;
    }
}

void PlantedFault::ofTheSceneIsRefused() {
    const std::string said = refusal(pictureOf([](scene::Scene& scene) {
        for (scene::Object& object : scene.objects) {
            if (object.name == "post") object.toWorld[3] += glm::dvec4(1.4, 0.0, -0.9, 0.0);
            if (object.name == "ball") object.toWorld[3] += glm::dvec4(-0.5, -0.15, 0.5, 0.0);
        }
    }));
    EXPECT_NE(said.find("does not show ball"), std::string::npos) << said;
}

// All in one, since what they are judged by takes most of the time.
TEST_F(PlantedFault, IsNamedWhateverItIs) {
    ofNoKindIsFoundInARightPicture();
    ofAMissingPathClassIsReported();
    ofTheIndexIsNamed();
    ofFlippedNormalsIsNamed();
    ofHalfAPixelIsNamed();
    ofAGammaIsNamed();
    ofThePrimariesIsNamed();
    ofTheFresnelFactorIsNamed();
    ofTheLightsPlaceIsNamed();
    ofTheCameraIsRefused();
    ofTheSceneIsRefused();
}

}  // namespace
}  // namespace kaustik::run
