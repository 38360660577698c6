// SPDX-License-Identifier: MIT
// Requests that make no sense: each gets one message that says what is wrong, where, and what to do
// instead, and leaves nothing behind.
#include <map>
#include <sstream>

#include "framework/core/files.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

struct BadRequest {
    std::string name;  // what is bad about it
    std::vector<std::string> arguments;
    std::vector<std::string> parts;  // what the message says
    int exitCode = 2;
};

class BadRequests : public CommandLine, public testing::WithParamInterface<BadRequest> {};

TEST_P(BadRequests, AreRefusedWithAMessageAndNothingElse) {
    const Outcome outcome = run(GetParam().arguments);
    expectFailure(outcome, GetParam().exitCode, GetParam().parts);
    EXPECT_TRUE(files().empty());
}

std::string nameOf(const testing::TestParamInfo<BadRequest>& info) {
    return info.param.name;
}

const std::string kRange = "WIDTHxHEIGHT, each from 1 to 16384";

INSTANTIATE_TEST_SUITE_P(
    Words, BadRequests,
    testing::Values(
        BadRequest{"NoSubcommand", {}, {"subcommand is required", "--help"}},
        BadRequest{"UnknownSubcommand", {"rnu"}, {"no subcommand 'rnu'", "did you mean 'run'?"}},
        BadRequest{"UnknownOption", {"--versio"}, {"'--versio'", "did you mean '--version'?"}},
        BadRequest{"UnknownOptionOfRun",
                   {"run", "ring", "--frame", "3"},
                   {"no option '--frame'", "did you mean '--frames'?"}},
        BadRequest{"UnknownOptionWithItsValue", {"run", "--siz=8x8"}, {"'--siz'", "'--size'"}},
        BadRequest{"OptionWithoutItsValue", {"run", "ring", "--set"}, {"--set"}},
        BadRequest{"SecondScene", {"run", "ring", "pool"}, {"not expected: pool"}},
        BadRequest{"ShadowRaysOfATracerWithoutLayers",
                   {"run", "ring", "--set", "trace=raytraced", "--set", "shadow=rays"},
                   {"shadow.rays", "layers", "shadow=map", "trace=hierarchical"}},
        BadRequest{"ShadowRaysOfATracerOfPlanes",
                   {"run", "ring", "--technique", "planar", "--set", "shadow=rays"},
                   {"shadow.rays", "layers", "shadow=map", "trace=hierarchical"}},
        BadRequest{"UnknownScene",
                   {"run", "flat-watr"},
                   {"no scene 'flat-watr'", "did you mean 'flat-water'?", "pool"}},
        BadRequest{"UnknownSceneOfExplain", {"explain", "rign"}, {"did you mean 'ring'?"}},
        BadRequest{"FolderAsScene", {"run", "/proc"}, {"no scene '/proc'"}},
        BadRequest{"UnknownTechnique",
                   {"run", "ring", "--technique", "screen_space_photon"},
                   {"no technique", "did you mean 'screen_space_photons'?"}},
        BadRequest{"UnknownTechniqueOfList",
                   {"list", "params", "--technique", "x"},
                   {"no technique 'x'", "screen_space_photons"}},
        BadRequest{"UnknownList", {"list", "scens"}, {"'scens'", "did you mean 'scenes'?"}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Settings, BadRequests,
    testing::Values(
        BadRequest{"UnknownNode",
                   {"run", "ring", "--set", "trace=linse"},
                   {"--set", "'linse'", "did you mean 'lines'?"}},
        BadRequest{"UnknownParameter",
                   {"run", "ring", "--set", "trace.epsilom=1"},
                   {"--set", "'trace.epsilom'", "did you mean 'trace.epsilon'?"}},
        BadRequest{"FormerNameOfAParameter",
                   {"run", "ring", "--set", "secant.most=1"},
                   {"--set", "'secant.most'", "it is called 'trace.secant.max_steps' now"}},
        BadRequest{"ParameterWithoutName", {"run", "ring", "--set", "=1"}, {"'=1'", "name=value"}},
        BadRequest{"ParameterWithoutValue",
                   {"run", "ring", "--set", "layers.count"},
                   {"'layers.count'", "name=value"}},
        BadRequest{"ParameterBelowItsRange",
                   {"run", "ring", "--set", "layers.count=0"},
                   {"layers.count", "'0'", "from 1 to 64"}},
        BadRequest{"ParameterAboveItsRange",
                   {"run", "ring", "--set", "layers.count=65"},
                   {"layers.count", "'65'", "from 1 to 64"}},
        BadRequest{"FractionOfALayer",
                   {"run", "ring", "--set", "layers.count=2.5"},
                   {"layers.count", "'2.5'", "whole number"}},
        BadRequest{"NegativeLength",
                   {"run", "ring", "--set", "trace.epsilon=-1"},
                   {"trace.epsilon", "'-1'", " m"}},
        BadRequest{"NotANumber",
                   {"run", "ring", "--set", "trace.epsilon=nan"},
                   {"trace.epsilon", "'nan'"}},
        BadRequest{"NumberWithATail",
                   {"run", "ring", "--set", "trace.epsilon=0.1x"},
                   {"trace.epsilon", "'0.1x'"}},
        BadRequest{"NumberThatOverflows",
                   {"run", "ring", "--set", "trace.epsilon=1e999"},
                   {"trace.epsilon", "'1e999'"}},
        BadRequest{"OneNumberForAnExtent",
                   {"run", "ring", "--set", "photons=64"},
                   {"emit.photons", "'64'", "WIDTHxHEIGHT"}},
        BadRequest{"PictureWithoutPixels", {"run", "ring", "--size", "0x0"}, {"'0x0'", kRange}},
        BadRequest{"PictureTooWide", {"run", "ring", "--size", "99999x1"}, {"'99999x1'", kRange}},
        BadRequest{"SizeThatIsNone", {"run", "ring", "--size", "big"}, {"--size", "'big'", kRange}},
        BadRequest{"NoFrames", {"run", "ring", "--frames", "0"}, {"--frames", "0"}},
        BadRequest{"FramesThatAreNoNumber",
                   {"run", "ring", "--frames", "few"},
                   {"not a number", "--frames", "few"}},
        BadRequest{"NegativeWarmUp", {"run", "ring", "--warmup", "-1"}, {"--warmup", "-1"}},
        BadRequest{"SeedThatIsNoNumber", {"run", "ring", "--seed", "x"}, {"--seed", "x"}},
        BadRequest{"SeedBeyondWholeNumbers",
                   {"run", "ring", "--seed", "18446744073709551616"},
                   {"--seed", "18446744073709551616", "9223372036854775807"}},
        BadRequest{"SeedBeyondWholeNumbersOfAReference",
                   {"reference", "ring", "--seed", "-9223372036854775809"},
                   {"--seed", "-9223372036854775809"}},
        BadRequest{"PhotonsBeyondWholeNumbers",
                   {"reference", "ring", "--photons", "99999999999999999999"},
                   {"--photons", "99999999999999999999"}},
        BadRequest{"FramesBeyondWholeNumbers",
                   {"run", "ring", "--frames", "18446744073709551617"},
                   {"--frames", "18446744073709551617"}},
        BadRequest{"TimeThatIsNoNumber", {"run", "ring", "--time", "noon"}, {"--time", "'noon'"}},
        BadRequest{"InfiniteTime", {"run", "ring", "--time", "inf"}, {"--time", "'inf'"}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Graph, BadRequests,
    testing::Values(BadRequest{"DisablesAnUnknownPass",
                               smallRun("ring", {"--disable", "triangls"}),
                               {"--disable", "'triangls'",
                                "did you mean 'reconstruct.triangles'?"}},
                    BadRequest{"DisablesARequiredPass",
                               smallRun("ring", {"--disable", "emit.grid"}),
                               {"--disable", "'emit.grid'", "required"}},
                    BadRequest{"DisablesARequiredPassBesidesAnother",
                               smallRun("ring", {"--disable", "triangles", "--disable", "grid"}),
                               {"--disable", "'emit.grid'", "required"}},
                    BadRequest{"DisablesOneOfTwo",
                               smallRun("ring", {"--disable", "interface"}),
                               {"--disable", "eye.interface", "specular.interface", "which"}},
                    BadRequest{"SavesAnUnknownResource",
                               smallRun("ring", {"--save", "photons.flx"}),
                               {"'photons.flx'", "did you mean 'photons.flux'?"}},
                    BadRequest{"SavesABuffer",
                               smallRun("ring", {"--save", "ledger"}),
                               {"--save", "'ledger'", "buffer"}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Files, BadRequests,
    testing::Values(BadRequest{"MissingSceneFile", {"run", "no.toml"}, {"no.toml", "No such"}, 1},
                    BadRequest{"MissingGltfFile", {"run", "no.glb"}, {"no.glb", "No such"}, 1},
                    BadRequest{"FolderThatCannotBeMade",
                               smallRun("ring", {"--out", "/proc/none/out"}),
                               {"--out", "/proc/none/out", "cannot be made"},
                               1},
                    BadRequest{"FolderThatCannotBeWritten",
                               smallRun("ring", {"--out", "/proc"}),
                               {"--out", "/proc", "written"},
                               1},
                    BadRequest{"GraphThatCannotBeWritten",
                               {"explain", "ring", "--size", "64x48", "--dot", "/proc/none/dot"},
                               {"/proc/none", "No such"},
                               1}),
    nameOf);

using BadScene = CommandLine;

TEST_F(BadScene, ThatIsNotTomlIsRefusedWithFileAndLine) {
    static_cast<void>(folder.file("broken.toml", "name = 'x'\n\n[camera\n"));
    expectFailure(run({"run", "broken.toml"}), 2, {"broken.toml:3:", "TOML"});
}

TEST_F(BadScene, WithAnUnknownKeyIsRefusedWithFileLineAndTheNearestKey) {
    static_cast<void>(folder.file("scene.toml", "[camera]\npositon = [0, 1, 2]\n"));
    expectFailure(run({"run", "scene.toml"}), 2,
                  {"scene.toml:2:", "'positon'", "did you mean 'position'?"});
}

TEST_F(BadScene, WithAValueOutOfRangeIsRefusedWithFileAndLine) {
    static_cast<void>(folder.file(
        "scene.toml", "[[material]]\nname = 'white'\ntype = 'lambertian'\nalbedo = 1.5\n"));
    expectFailure(run({"run", "scene.toml"}), 2, {"scene.toml:4:", "albedo", "1.5"});
}

TEST_F(BadScene, ThatIsAFolderIsRefused) {
    std::filesystem::create_directory(folder / "scene.toml");
    expectFailure(run({"run", "scene.toml"}), 1, {"scene.toml", "directory"});
}

TEST_F(BadScene, ThatCannotBeReadIsAnErrorAndNotAnEmptyScene) {
    // A file that opens and whose first byte cannot be read, whoever asks.
    std::filesystem::create_symlink("/proc/self/mem", folder / "scene.toml");
    expectFailure(run(smallRun("scene.toml")), 1, {"scene.toml", "cannot be read"});
}

// A scene whose only object is the mesh thing.obj.
constexpr const char* kSceneWithMesh = R"([[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[object]]
name = "thing"
material = "chalk"
mesh = "thing.obj"
)";

class BadMesh : public CommandLine {
  protected:
    BadMesh() { static_cast<void>(folder.file("scene.toml", kSceneWithMesh)); }
};

TEST_F(BadMesh, ThatIsMissingIsNamedWithTheLineAndHowToGetIt) {
    expectFailure(run({"run", "scene.toml"}), 1,
                  {"scene.toml:8:", "'thing.obj'", "put it there", "experiments/fetch_meshes.sh"});
}

// The option of experiments/fetch_meshes.sh that gets each of the meshes in its lists.
std::map<std::string, std::string> fetchedMeshes() {
    const std::string script = readFile(projectRoot() / "experiments/fetch_meshes.sh");
    std::map<std::string, std::string> options;
    for (const auto& [list, option] : {std::pair<std::string, std::string>("GLMARK2_MESHES=(", ""),
                                       {"DRAGON_MESHES=(", " --dragons"},
                                       {"TEAPOT_MESHES=(", " --teapot"}}) {
        const std::size_t begin = script.find(list) + list.size();
        std::istringstream names(script.substr(begin, script.find(')', begin) - begin));
        for (std::string name; names >> name;)
            options[name] = option;
    }
    return options;
}

TEST_F(BadMesh, OfThePapersThatIsMissingIsAnsweredWithTheCommandThatFetchesIt) {
    const std::map<std::string, std::string> meshes = fetchedMeshes();
    EXPECT_EQ(meshes.at("dragon_vrip_res2.ply.gz"), " --dragons");
    Conditions conditions;
    // A project without meshes, whatever this machine has.
    conditions.environment["KAUSTIK_ROOT"] = (folder / "").string();
    for (const auto& [name, option] : meshes) {
        std::string scene = kSceneWithMesh;
        scene.replace(scene.find("thing.obj"), std::string("thing.obj").size(), name);
        static_cast<void>(folder.file("scene.toml", scene));
        expectFailure(
            run({"run", "scene.toml"}, conditions), 1,
            {"'" + name + "'", "run experiments/fetch_meshes.sh" + option + " to get it."});
    }
}

TEST_F(BadMesh, ThatIsCutOffInALineIsNamedWithItsLine) {
    static_cast<void>(folder.file("thing.obj", "v 0 0 0\nv 1 0 0\nv 0 1"));
    expectFailure(run({"run", "scene.toml"}), 1, {"thing.obj:3:"});
}

TEST_F(BadMesh, WhoseFacesAreCutOffIsRefused) {
    static_cast<void>(folder.file("thing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
    expectFailure(run({"run", "scene.toml"}), 1, {"thing.obj", "no faces"});
}

TEST_F(BadMesh, ThatIsAFolderIsRefused) {
    std::filesystem::create_directory(folder / "thing.obj");
    expectFailure(run({"run", "scene.toml"}), 1, {"thing.obj"});
}

}  // namespace
}  // namespace kaustik::test
