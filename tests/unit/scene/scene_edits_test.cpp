// SPDX-License-Identifier: MIT
#include "framework/scene/scene_edits.h"

#include "framework/core/error.h"
#include "tests/unit/scene/files/scene_file_fixture.h"

namespace kaustik::scene::test {
namespace {

constexpr const char* kBase = R"(
name = "base"
[camera]
position = [0, 2, 3]
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[light]]
name = "lamp"
type = "point"
position = [0, 3, 0]
intensity = 5
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "pond"
shape = "water"
material = "water"
size = [2, 1]
cells = [8, 4]
waves = [{amplitude = 0.1, wavelength = 0.7}]
)";

class Edits : public SceneFile {
  protected:
    Edits() { write("base.toml", kBase); }
    Scene base() const { return loadSceneFile(folder / "base.toml"); }
};

// Numbers that no short decimal hits.
SceneEdits everyEdit() {
    SceneEdits edits;
    Camera camera;
    camera.position = {1.0 / 3.0, 2.1, -4.7};
    camera.target = {0.1, 0.2, 1.0 / 7.0};
    camera.verticalFovDegrees = 100.0 / 3.0;
    edits.camera = camera;
    edits.medium = Medium{glm::vec3(0.1f, 0.2f, 1.0f / 3.0f), glm::vec3(0.01f), -0.3f};
    edits.lights["sun"] = {glm::dvec3(0.3, -1.7, 1.0 / 3.0), {}, 0.7f};
    edits.lights["lamp"] = {{}, glm::dvec3(1.0 / 3.0, 2.0, 0.1), {}};
    edits.waves["pond"] = {{0.05f, 1.0f / 3.0f, 33.3f, 0.1f, -1.0f}, {0.02f, 0.2f, -10, 2, 1.7f}};
    edits.timeSeconds = 2.0 / 3.0;
    return edits;
}

TEST_F(Edits, WrittenAsAFileGiveTheSameBitsAsApplied) {
    Scene applied = base();
    applyEdits(applied, everyEdit());
    const Scene loaded =
        loadSceneFile(write("changed.toml", writeSceneFile("changed", "base.toml", everyEdit())));

    EXPECT_EQ(loaded.camera, applied.camera);
    EXPECT_EQ(loaded.medium, applied.medium);
    EXPECT_EQ(loaded.timeSeconds, applied.timeSeconds);
    ASSERT_EQ(loaded.lights.size(), applied.lights.size());
    for (std::size_t i = 0; i < loaded.lights.size(); ++i) {
        EXPECT_EQ(loaded.lights[i].direction, applied.lights[i].direction);
        EXPECT_EQ(loaded.lights[i].position, applied.lights[i].position);
        EXPECT_EQ(loaded.lights[i].power, applied.lights[i].power);
    }
    EXPECT_EQ(loaded.meshes[0].heightField->waves, applied.meshes[0].heightField->waves);
    EXPECT_EQ(loaded.meshes[0].positions, applied.meshes[0].positions);
    EXPECT_EQ(loaded.meshes[0].normals, applied.meshes[0].normals);
    // They did change something.
    EXPECT_NE(applied.meshes[0].positions, base().meshes[0].positions);
    EXPECT_EQ(applied.lights[0].power, 0.7f * base().lights[0].power);
}

TEST_F(Edits, OfAnExtensionLeaveTheRestAsItWas) {
    const Scene loaded =
        loadSceneFile(write("changed.toml", "extends = \"base.toml\"\ntime = 1.5\n"));
    EXPECT_EQ(loaded.name, "changed");
    EXPECT_EQ(loaded.camera, base().camera);
    EXPECT_EQ(loaded.lights[0].power, base().lights[0].power);
    ASSERT_EQ(loaded.extendedFiles.size(), 1u);
    EXPECT_EQ(loaded.extendedFiles[0].filename(), "base.toml");
    EXPECT_EQ(loaded.file.filename(), "changed.toml");
}

TEST_F(Edits, NameWhatTheSceneDoesNotHave) {
    const auto problem = [&](const std::string& more) {
        return messageOf<ConfigError>("extends = \"base.toml\"\n" + more);
    };
    EXPECT_NE(problem("[[light]]\nname = \"son\"\n").find("did you mean 'sun'"), std::string::npos);
    EXPECT_NE(problem("[[light]]\nname = \"sun\"\nposition = [0, 1, 0]\n").find("no position"),
              std::string::npos);
    EXPECT_NE(problem("[[light]]\nname = \"lamp\"\ndirection = [0, 1, 0]\n").find("no direction"),
              std::string::npos);
    EXPECT_NE(problem("[[water]]\nobject = \"pont\"\nwaves = []\n").find("did you mean 'pond'"),
              std::string::npos);
    EXPECT_NE(problem("[[object]]\nname = \"pond\"\n").find("scene.toml:2"), std::string::npos);
    EXPECT_NE(problem("[[light]]\nname = \"sun\"\ndirection = [0, 0, 0]\n").find("zero vector"),
              std::string::npos);
    EXPECT_THROW(load("extends = \"nothing.toml\"\n"), IoError);
}

TEST_F(Edits, EndWhenScenesExtendEachOther) {
    write("other.toml", "extends = \"scene.toml\"\n");
    EXPECT_NE(messageOf<ConfigError>("extends = \"other.toml\"\n").find("without an end"),
              std::string::npos);
}

TEST_F(Edits, ThatFailChangeNothing) {
    Scene scene = base();
    SceneEdits edits = everyEdit();
    edits.waves["nowhere"] = {};
    EXPECT_THROW(applyEdits(scene, edits), ConfigError);
    EXPECT_EQ(scene.camera, base().camera);
    EXPECT_EQ(scene.lights[0].direction, base().lights[0].direction);
}

}  // namespace
}  // namespace kaustik::scene::test
