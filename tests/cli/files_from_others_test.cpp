// SPDX-License-Identifier: MIT
// Files that came from somewhere else, as the program's user meets them: whatever they do to what
// reads them, one message and exit code 2.
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSceneWithMesh = R"([camera]
position = [0, 0, 3]
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[object]]
name = "thing"
material = "chalk"
mesh = "thing.ply"
)";

constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

// The program next to a reader that does what the name of a file tells it.
class MisledReader : public CommandLine {
  protected:
    MisledReader() {
        fs::copy_file(KAUSTIK_BINARY, folder / "bin");
        fs::create_directory(folder / "program");
        fs::rename(folder / "bin", folder / "program/kaustik");
        fs::copy_file(KAUSTIK_MISBEHAVING_READER, folder / "program/kaustik_reader");
        conditions_.program = folder / "program/kaustik";
        conditions_.environment = {{"KAUSTIK_READ_SECONDS", "1"},
                                   {"KAUSTIK_READ_MEBIBYTES", "512"}};
    }
    Outcome explain(const std::string& scene) const {
        static_cast<void>(folder.file(scene, "name = 'x'\n"));
        return run({"explain", scene, "--size", "64x48"}, conditions_);
    }

    Conditions conditions_;
};

TEST_F(MisledReader, ThatCrashesIsOneMessageThatNamesTheFile) {
    for (const char* how : {"crash", "abort", "overflow", "throw"}) {
        for (const char* kind : {".toml", ".glb", ".gltf"}) {
            SCOPED_TRACE(std::string(how) + kind);
            const std::string name = std::string(how) + kind;
            expectFailure(explain(name), 2, {name, "is damaged", "Export it again"});
        }
    }
}

TEST_F(MisledReader, ThatHangsIsOneMessageThatNamesTheFileAndTheLimit) {
    expectFailure(explain("hang.toml"), 2,
                  {"hang.toml takes more than 1 s", "KAUSTIK_READ_SECONDS"});
}

#ifndef __SANITIZE_ADDRESS__  // there the sanitizer watches the memory, and has words of its own
TEST_F(MisledReader, ThatEatsMemoryIsOneMessageThatNamesTheFileAndTheLimit) {
    expectFailure(explain("memory.glb"), 2,
                  {"memory.glb needs more than 512 MiB", "KAUSTIK_READ_MEBIBYTES"});
}
#endif

TEST_F(MisledReader, ThatIsMissingIsAMessageThatSaysWhatToBuild) {
    fs::remove(folder / "program/kaustik_reader");
    expectFailure(explain("well.toml"), 1, {"kaustik_reader", "Build the target"});
}

class FilesFromOthers : public CommandLine {
  protected:
    // Without a name of its own, the scene is called as its file is.
    void writeSceneWithoutName(const std::string& file) const {
        std::string scene = kWavyWater;
        const std::string name = "name = \"wavy\"\n";
        scene.erase(scene.find(name), name.size());
        static_cast<void>(folder.file(file, scene));
    }
};

TEST_F(FilesFromOthers, AreReadByAProcessThatLeavesNothingBehind) {
    static_cast<void>(folder.file("scene.toml", kSceneWithMesh));
    static_cast<void>(folder.file("thing.ply", kPly));
    const Outcome outcome = run({"explain", "scene.toml", "--size", "64x48"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(files(), (std::set<std::string>{"scene.toml", "thing.ply"}));
}

TEST_F(FilesFromOthers, AreExplainedWithTheWarningsThatARunOfThemHas) {
    static_cast<void>(folder.file("scene.toml", kSceneWithMesh));
    std::string ply = kPly;
    ply.replace(ply.find("face 1"), 6, "face 2");
    static_cast<void>(folder.file("thing.ply", ply + "2 0 1\n"));
    const std::string warning = "warning: thing.ply: 1 faces or strips with fewer";
    for (const Outcome& outcome : {run({"explain", "scene.toml", "--size", "64x48"}),
                                   run(smallRun("scene.toml", {"--out", "out"}))}) {
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find(warning), std::string::npos) << outcome.out;
    }
}

TEST_F(FilesFromOthers, MayTakeAsMuchAsTheUserAllows) {
    static_cast<void>(folder.file("scene.toml", kSceneWithMesh));
    static_cast<void>(folder.file("thing.ply", kPly));
    Conditions bad;
    bad.environment = {{"KAUSTIK_READ_SECONDS", "soon"}};
    expectFailure(run({"explain", "scene.toml"}, bad), 2, {"KAUSTIK_READ_SECONDS", "'soon'"});
}

TEST_F(FilesFromOthers, NeedNoNameThatIsUtf8) {
    writeSceneWithoutName("wa\xff.toml");
    const Outcome outcome = run(smallRun("wa\xff.toml", {"--out", "out"}));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(report().at("scene").at("name"), "wa\xef\xbf\xbd");
    EXPECT_TRUE(files().contains("out/trace.json"));
    EXPECT_TRUE(files().contains("out/beauty.png"));
}

TEST_F(FilesFromOthers, NeedNoNameThatIsUtf8ForAReference) {
    writeSceneWithoutName("wa\xff.toml");
    Conditions cached;
    cached.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
    const Outcome outcome = run({"reference", "wa\xff.toml", "--size", "64x48", "--photons", "1000",
                                 "--out", "reference.exr"},
                                cached);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(contents("reference.json")).at("scene"), "wa\xef\xbf\xbd");
    EXPECT_EQ(run(smallRun("wa\xff.toml", {"--out", "out", "--reference", "reference.exr"}), cached)
                  .exitCode,
              0);
}

}  // namespace
}  // namespace kaustik::test
