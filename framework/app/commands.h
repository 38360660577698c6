// SPDX-License-Identifier: MIT
// The subcommands. Each throws kaustik::Error for whatever goes wrong; main turns that into a
// message and an exit code.
#pragma once

#include "framework/app/options.h"
#include "framework/numerics/suite.h"
#include "framework/pipeline/registry.h"
#include "framework/pipeline/renderer.h"

namespace kaustik::app {

void runCommand(const RunOptions& options, const Registry& registry);
// What `run` does with --tile, and `kaustik tiles`. The first throws ConfigError for options of
// `run` that do not go with tiles.
void checkTileOptions(const RunOptions& options);
void traceTileCommand(const RunOptions& options, const Registry& registry);
void tilesCommand(const std::string& folder);
void benchCommand(const BenchOptions& options, const Registry& registry);
void tuneCommand(const TuneOptions& options, const Registry& registry);
void listCommand(const ListOptions& options, const Registry& registry);
void docCommand(const DocOptions& options, const Registry& registry);
void explainCommand(const ExplainOptions& options, const Registry& registry);
void referenceCommand(const ReferenceOptions& options);
void censusCommand(const CensusOptions& options, const Registry& registry);
void certifyCommand(const CertifyCommandOptions& options);
void compareCommand(const CompareOptions& options);
void importCommand(const ImportOptions& options);
void exportCommand(const ExportOptions& options);
void judgeCommand(const JudgeOptions& options);

// Adds to the common hard cases those of a program's techniques; null where there are none.
using AddHardCases = void (*)(numerics::Suite& suite);
void experimentCommand(const ExperimentOptions& options, const Registry& registry,
                       AddHardCases addHardCases);

void checkCommand(const Registry& registry);
void schemaCommand(const std::string& what, const Registry& registry);

// `kaustik gui`, which sits on top of this; null in a program that was built without it.
using GuiCommand = void (*)(const GuiOptions& options, const Registry& registry);

// What a program may bring besides techniques.
struct ProgramParts {
    GuiCommand gui = nullptr;
    AddHardCases addHardCases = nullptr;
};

// The whole command line: parses, runs, prints errors; gives the exit code. A program that adds
// techniques of its own passes its registry.
[[nodiscard]] int runCommandLine(int argc, const char* const* argv, const Registry& registry,
                                 const ProgramParts& parts = {});

// Checks everything that the options name, before any device is asked for.
[[nodiscard]] RenderSettings makeSettings(const SceneOptions& options, const Registry& registry,
                                          long long seed = 1);
// The name of the scene with what these options say, which are no options of other scenes
// (scene/files/own_mesh.h). Throws ConfigError.
void putOwnMesh(std::string& scene, const OwnMeshOptions& options);
// `time`: seconds, or "" for the scene's own. `namedAt`: the place in a file that names the scene,
// for messages; "" for the command line.
[[nodiscard]] scene::Scene loadRequestedScene(const std::string& name, const std::string& time,
                                              const std::string& namedAt = "");

}  // namespace kaustik::app
