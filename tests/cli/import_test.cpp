// SPDX-License-Identifier: MIT
// Other renderers' scenes as scene files, in one command, and what comes of them in a run.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4";

// A glass ball above a floor, with walls whose colours come by other ways.
constexpr const char* kMitsubaRoom = R"(<scene version="3.0.0">
<integrator type="path"/>
<sensor type="perspective">
    <float name="fov" value="50"/>
    <transform name="to_world">
        <lookat origin="0, 1.2, 4" target="0, 0.8, 0" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
        <integer name="width" value="320"/>
        <integer name="height" value="240"/>
    </film>
</sensor>
<bsdf type="twosided" id="white">
    <bsdf type="diffuse"><rgb name="reflectance" value="0.7"/></bsdf>
</bsdf>
<bsdf type="diffuse" id="red"><srgb name="reflectance" value="#c02020"/></bsdf>
<bsdf type="dielectric" id="glass"/>
<shape type="rectangle" id="floor">
    <ref id="white"/>
    <transform name="to_world"><scale value="2"/><rotate x="1" angle="-90"/></transform>
</shape>
<shape type="rectangle" id="back">
    <ref id="red"/>
    <transform name="to_world"><scale value="2"/><translate z="-2"/></transform>
</shape>
<shape type="sphere" id="ball">
    <ref id="glass"/>
    <point name="center" x="0" y="0.8" z="0"/>
    <float name="radius" value="0.5"/>
</shape>
<emitter type="point" id="bulb">
    <point name="position" x="0" y="2.5" z="0.5"/>
    <rgb name="intensity" value="20, 18, 15"/>
</emitter>
</scene>
)";

constexpr const char* kTungstenRoom = R"({
"bsdfs": [
    {"name": "floor", "type": "lambert", "albedo": {"type": "checker", "res_u": 8, "res_v": 8}},
    {"name": "glass", "type": "dielectric", "ior": 1.5}
],
"camera": {"type": "pinhole", "fov": 60, "resolution": [320, 240],
    "transform": {"position": [0, 1.2, 4], "look_at": [0, 0.8, 0], "up": [0, 1, 0]}},
"primitives": [
    {"name": "floor", "type": "quad", "bsdf": "floor", "transform": {"scale": 4}},
    {"name": "ball", "type": "sphere", "bsdf": "glass",
     "transform": {"position": [0, 0.8, 0], "scale": 0.5}},
    {"name": "lamp", "type": "quad", "bsdf": {"type": "null"}, "power": 60,
     "transform": {"position": [0, 2.5, 0], "scale": 0.4, "rotation": [180, 0, 0]}}
]
}
)";

class Import : public CommandLine {
  protected:
    [[nodiscard]] Outcome import(const std::string& file, const std::string& contents,
                                 const std::vector<std::string>& more = {}) const {
        static_cast<void>(folder.file(file, contents));
        std::vector<std::string> arguments = {"import", file, "--out", "made.toml"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    // Renders it into `out`, and expects that light goes through glass to the floor.
    void expectCaustic(const std::string& scene = "made.toml") const {
        const Outcome outcome = run(smallRun(scene, {"--set", "photons=128x128", "--out", "out"}));
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_GT(report().at("energy").at("emitted_w").get<double>(), 0.0);
        EXPECT_GT(report().at("energy").at("deposited_w").get<double>(), 0.0);
        EXPECT_EQ(report().at("violations"), json::array());
        EXPECT_EQ(report().at("warnings"), json::array());
    }
    static void expectIn(const std::string& text, const std::vector<std::string>& parts) {
        for (const std::string& part : parts)
            EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n"
                                                          << text;
    }
    // Of a scene with these elements.
    [[nodiscard]] static std::string mitsuba(const std::string& elements) {
        return "<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n";
    }
};

TEST_F(Import, OfAMitsubaRoomRendersItsCaustic) {
    const Outcome outcome = import("room.xml", kMitsubaRoom);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    expectIn(outcome.out,
             {"wrote made.toml: 3 objects, 1 light\n", "kaustik run made.toml --size 320x240",
              "left out: integrator 'path' (room.xml:2)"});
    expectIn(contents("made.toml"),
             {"# left out: integrator 'path' (room.xml:2)", "name = \"ball\"",
              "shape = \"sphere\"\nradius = 0.5\nposition = [0, 0.8, 0]\n", "name = \"glass\"",
              "size = [4, 4]", "intensity = 20\ncolor = [1, 0.9, 0.75]\n", "name = \"white\""});
    // Nothing of where it was made.
    EXPECT_EQ(contents("made.toml").find((folder / ".").parent_path().string()), std::string::npos);
    expectCaustic();
    EXPECT_EQ(report().at("scene").at("needs").at("refractors"), 1);
}

TEST_F(Import, OfATungstenRoomRendersTheCausticOfItsLamp) {
    const Outcome outcome = import("room.json", kTungstenRoom);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    // The floor's pattern is by the whole of it, which no keys say.
    expectIn(contents("made.toml"), {"mesh = \"made_meshes/floor.ply\"", "pattern = \"checker\""});
    EXPECT_TRUE(files().contains("made_meshes/floor.ply"));
    expectIn(contents("made.toml"), {"emission = "});
    expectCaustic();
    EXPECT_GT(report().at("scene").at("needs").at("lights"), 4);  // points of the lamp
    EXPECT_NEAR(report().at("scene").at("needs").at("refractors").get<double>(), 1, 0);
}

TEST_F(Import, NamesMeshesWhereTheyLieAndBakesWhatNoKeysSay) {
    static_cast<void>(folder.file("thing.obj", kTetrahedron));
    const auto shape = [](const char* id, const char* transform) {
        return fmt::format(
            "<shape type=\"obj\" id=\"{}\"><string name=\"filename\" value=\"thing.obj\"/>"
            "<transform name=\"to_world\">{}</transform></shape>\n",
            id, transform);
    };
    const std::string scene =
        mitsuba(shape("turned",
                      "<scale value=\"2\"/><rotate y=\"1\" angle=\"30\"/>"
                      "<translate x=\"1\"/>") +
                shape("sheared", "<matrix value=\"1 1 0 0 0 1 0 0 0 0 1 0 0 0 0 1\"/>") +
                shape("mirrored", "<scale x=\"-1\"/>") + "<shape type=\"disk\" id=\"disk\"/>");
    const Outcome outcome = import("scene.xml", scene);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    expectIn(contents("made.toml"),
             {"mesh = \"thing.obj\"\nposition = [1, 0, 0]\nrotation_degrees = [0, 30, 0]\n"
              "scale = 2\n",
              "mesh = \"made_meshes/sheared.ply\"", "mesh = \"made_meshes/mirrored.ply\"",
              "shape = \"disc\"\nradius = 1\n"});
    EXPECT_EQ(run({"explain", "made.toml"}).exitCode, 0);
    // Elsewhere, what lies not below is copied.
    const Outcome elsewhere = run({"import", "scene.xml", "--out", "there/made.toml"});
    ASSERT_EQ(elsewhere.exitCode, 0) << elsewhere.err;
    expectIn(contents("there/made.toml"), {"mesh = \"made_meshes/thing.obj\""});
    EXPECT_TRUE(files().contains("there/made_meshes/thing.obj"));
    EXPECT_EQ(run({"explain", "there/made.toml"}).exitCode, 0);
}

TEST_F(Import, AMissingTextureIsAnErrorOrGrey) {
    const std::string scene = mitsuba(
        "<shape type=\"disk\"/><shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
        "type=\"bitmap\" "
        "name=\"reflectance\">\n<string name=\"filename\" value=\"wood.png\"/></texture></bsdf>"
        "</shape>");
    expectFailure(import("scene.xml", scene), 1,
                  {"scene.xml:3", "wood.png", "--missing-textures grey"});
    EXPECT_EQ(files(), std::set<std::string>{"scene.xml"});
    const Outcome outcome = import("scene.xml", scene, {"--missing-textures", "grey"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    expectIn(outcome.out, {"left out: texture 'wood.png' (scene.xml:3)", "it is grey"});
    expectIn(contents("made.toml"), {"albedo = 0.5"});
    expectFailure(import("scene.xml", scene, {"--missing-textures", "blue"}), 2, {"'blue'"});
}

// What a name holds is text, and neither a line nor a key of the scene file.
TEST_F(Import, NamesStayNames) {
    const std::string scene = mitsuba(
        "<shape type=\"sphere\" id=\"a&#10;[camera]&quot;\"/><shape type=\"hair\" "
        "id=\"b&#10;time = 3\"/><emitter type=\"point\" id=\"\xff\"/>");
    ASSERT_EQ(import("scene.xml", scene).exitCode, 0);
    EXPECT_EQ(run({"explain", "made.toml"}).exitCode, 0);
    EXPECT_EQ(contents("made.toml").find("\ntime"), std::string::npos);
}

TEST_F(Import, WhatMakesNoSenseIsRefusedInASentence) {
    const auto refuse = [&](const std::string& file, const std::string& text, int exitCode,
                            const std::vector<std::string>& parts) {
        SCOPED_TRACE(text.substr(0, 200));
        expectFailure(import(file, text), exitCode, parts);
        EXPECT_FALSE(files().contains("made.toml"));
    };
    refuse("a.xml", "<!DOCTYPE scene [<!ENTITY a \"&b;\">]><scene/>", 2, {"a.xml:1", "DOCTYPE"});
    refuse("a.xml", mitsuba("<shape type=\"&lol;\"/>"), 2, {"a.xml:2", "&lol;"});
    refuse("a.xml", "not XML", 2, {"a.xml:1", "XML"});
    refuse("a.xml", "<Scene2/>", 2, {"a.xml:1", "<scene>"});
    refuse("a.xml", mitsuba("<include filename=\"../a.xml\"/>"), 2, {"a.xml:2", "own folder"});
    refuse("a.xml", mitsuba("<include filename=\"a.xml\"/>"), 2, {"a.xml:2", "without an end"});
    refuse("a.xml", mitsuba("<ref id=\"nobody\"/>"), 2, {"a.xml:2", "'nobody'"});
    refuse("a.xml", mitsuba("<shape type=\"$what\"/>"), 2, {"a.xml:2", "$what"});
    refuse("a.xml", mitsuba("<emitter type=\"area\"/>"), 2, {"a.xml:2", "area light"});
    refuse("a.xml",
           mitsuba("<shape type=\"rectangle\" id=\"lamp\"><transform name=\"to_world\"><scale "
                   "x=\"0\"/></transform><emitter type=\"area\"/></shape>"),
           2, {"a.xml:2", "'lamp'", "no area"});
    refuse("a.xml", mitsuba("<shape type=\"sphere\"><float name=\"radius\" value=\"x\"/></shape>"),
           2, {"a.xml:2", "'x' is not a number"});
    refuse("a.json", "[]", 2, {"a.json:1", "object"});
    refuse("a.json", "{\"primitives\": [}", 2, {"a.json:1", "JSON"});
    refuse("a.json", "{}", 2, {"a.json:1", "primitives"});
    refuse("a.json", "{\"primitives\": [\n{\"type\": \"quad\", \"bsdf\": \"x\"}]}", 2,
           {"a.json:2", "'x'"});
    refuse("a.obj", kTetrahedron, 2, {"a.obj", "Mitsuba (.xml)"});
    expectFailure(run({"import", "none.xml", "--out", "made.toml"}), 1, {"none.xml"});
    expectFailure(run({"import", "a.xml", "--out", "made.txt"}), 2, {"made.txt", ".toml"});
    expectFailure(run({"import", "a.xml"}), 2, {"--out"});
}

}  // namespace
}  // namespace kaustik::test
