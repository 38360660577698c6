// SPDX-License-Identifier: MIT
// What renders by techniques, and what tells of scenes, nodes, files and devices.
#include "framework/app/subcommands.h"

#include <memory>
#include <set>
#include <string>

#include "framework/app/common_options.h"
#include "framework/app/merge.h"
#include "framework/core/error.h"

namespace kaustik::app {
namespace {

// The options and arguments that the command line itself has, by name.
std::set<std::string> givenOptions(const CLI::App& command) {
    std::set<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        names.insert(option->get_single_name());
    }
    return names;
}

}  // namespace

Subcommand addRun(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<RunOptions>();
    CLI::App& command = *app.add_subcommand("run", "Renders a scene; writes pictures and a report");
    addSceneOptions(command, options->scene);
    command.add_option("--frames", options->frames, "Frames that are timed")->capture_default_str();
    command.add_option("--warmup", options->warmup, "Frames before them")->capture_default_str();
    command.add_option("--seed", options->seed, "Seed of everything random")
        ->check(integerRangeError)
        ->capture_default_str();
    command
        .add_option("--time-step", options->timeStepSeconds,
                    "Seconds by which the animation goes on from one timed frame to the next")
        ->capture_default_str();
    command.add_flag("--precise", options->precise,
                     "Times each pass with the device finished around it (software rasterisers)");
    command.add_flag("--ledger,!--no-ledger", options->hasLedger,
                     "Whether frames that are timed sum up the energy ledger; the one that is "
                     "measured does");
    command
        .add_option("--reference", options->reference,
                    "Compare with the reference: none, auto (computed once and kept), a file of "
                    "'kaustik reference', or certified: with proved bounds ('kaustik certify')")
        ->capture_default_str();
    command
        .add_option("--reference-photons", options->referencePhotons,
                    "Photons that the reference of auto has at least")
        ->check(integerRangeError)
        ->capture_default_str();
    command.add_option("--save", options->saved, "A resource to save, by a name from 'explain'")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--device-model", options->deviceModel, kDeviceModelHelp);
    command.add_flag("--capture", options->captures,
                     "One more frame, captured by RenderDoc, which must have started this");
    command.add_option("--tev", options->viewer,
                       "HOST or HOST:PORT of a running tev, which is sent the pictures");
    command.add_option("--out", options->out, "Folder for what is written");
    command.add_option("--tile", options->tile,
                       "K/N: only traces photons on the K-th of N tiles of the screen; no picture");
    command.add_option("--tiles", options->tiles,
                       "Folder of the tiles' hits; without --tile the picture is made of them");
    return {&command, [options, &command, &registry] {
                mergeSettings(*options, givenOptions(command), registry);
                putOwnMesh(options->scene.scene, options->scene.own);
                runCommand(*options, registry);
            }};
}

Subcommand addTiles(CLI::App& app) {
    const auto folder = std::make_shared<std::string>();
    CLI::App& command = *app.add_subcommand(
        "tiles", "Takes of all tiles' hits the first, and says whether there is another round");
    command.add_option("folder", *folder, "That of 'run --tile'")->required();
    return {&command, [folder] { tilesCommand(*folder); }};
}

Subcommand addBench(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<BenchOptions>();
    options->scene.size = "400x300";
    CLI::App& command = *app.add_subcommand(
        "bench", "Keeps times of scenes, or says what has changed between two such files");
    command.add_option("action", options->action, "save or compare")->required();
    command
        .add_option("file", options->files,
                    "save: the file that is written; compare: those of before and after")
        ->required();
    command.add_option("--scene", options->scenes,
                       "save: a scene that is timed; else pool, glass-sphere, ring, glass-bunny");
    command.add_option("--rounds", options->rounds, "save: times that each scene is rendered anew")
        ->check(integerRangeError)
        ->capture_default_str();
    command
        .add_option("--frames", options->frames, "save: frames of a round, after one to warm up")
        ->check(integerRangeError)
        ->capture_default_str();
    command.add_flag("--precise", options->isPrecise,
                     "save: with the device finished around each pass");
    addPictureOptions(command, options->scene);
    command.add_option("--max-slower", options->maxSlowerPercent,
                       "compare: ends with 1 where a scene is slower by more than so many percent");
    return {&command, [options, &registry] { benchCommand(*options, registry); }};
}

Subcommand addTune(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<TuneOptions>();
    CLI::App& command = *app.add_subcommand(
        "tune",
        "Looks for the technique and the number of photons that have an error first, or the least "
        "error within a time, on this device");
    command.add_option("scene", options->scene, "As 'run' takes it")->capture_default_str();
    command.add_option("--error", options->error,
                       "relMSE of the caustic, net of the reference's noise, to be had in the "
                       "least time");
    command.add_option("--time", options->milliseconds,
                       "ms of the caustic's passes, in which to have the least error");
    command.add_option("--size", options->size, "WIDTHxHEIGHT of the picture")
        ->capture_default_str();
    command
        .add_option("--reference-photons", options->referencePhotons,
                    "Of the reference that all are judged by, at least")
        ->check(integerRangeError)
        ->capture_default_str();
    command.add_option("--out", options->out,
                       "Folder for runs and settings; else results/runs/tune/SCENE. What is there "
                       "is not done again");
    return {&command, [options, &registry] { tuneCommand(*options, registry); }};
}

Subcommand addList(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<ListOptions>();
    CLI::App& command = *app.add_subcommand("list", "Prints what there is");
    command.add_option("what", options->what, "scenes, techniques, nodes or params")
        ->capture_default_str();
    command.add_option("--technique", options->technique, "Only what this technique uses");
    command.add_flag("--as-published", options->isAsPublished, "Of it, the row of its paper");
    command.add_flag("--json", options->json, "As JSON");
    return {&command, [options, &registry] { listCommand(*options, registry); }};
}

Subcommand addDoc(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<DocOptions>();
    CLI::App& command =
        *app.add_subcommand("doc", "Prints a node's page, or writes a page for each node");
    command.add_option("node", options->node, "A name from 'list nodes'; without it all of them");
    command.add_option("--out", options->out, "Folder for the pages, each NODE.md");
    return {&command, [options, &registry] { docCommand(*options, registry); }};
}

Subcommand addExplain(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<ExplainOptions>();
    CLI::App& command =
        *app.add_subcommand("explain", "Prints every pass and why it runs or was skipped");
    addSceneOptions(command, options->scene);
    command.add_option("--dot", options->dotFile, "Writes the graph as Graphviz");
    command.add_option("--device-model", options->deviceModel, kDeviceModelHelp);
    return {&command, [options, &command, &registry] {
                mergeSettings(*options, givenOptions(command), registry);
                putOwnMesh(options->scene.scene, options->scene.own);
                explainCommand(*options, registry);
            }};
}

Subcommand addExperiment(CLI::App& app, const Registry& registry, AddHardCases addHardCases) {
    const auto options = std::make_shared<ExperimentOptions>();
    CLI::App& command =
        *app.add_subcommand("experiment", "Does all runs of a study, or draws what they found");
    command.add_option("action", options->action, "run, merge or report")->required();
    command
        .add_option("target", options->targets,
                    "run: the study, a .toml; report: its results; merge: those of its shards")
        ->required();
    command.add_option("--out", options->out, "Folder for the results of run and merge");
    addDeviceOption(command);
    command.add_option("--shard", options->shard,
                       "K/N: run does only the K-th of N parts of the study");
    command
        .add_option("--only", options->only,
                    "KEY=VALUE: run does only the runs with this value of what the study varies; "
                    "repeatable, values of one key are alternatives")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_flag("--incomplete", options->incomplete,
                     "merge takes what there is, though runs are missing");
    command.add_flag("--resume", options->resume, "Leaves finished runs alone");
    return {&command, [options, &registry, addHardCases] {
                experimentCommand(*options, registry, addHardCases);
            }};
}

Subcommand addGui(CLI::App& app, const Registry& registry, GuiCommand gui) {
    const auto options = std::make_shared<GuiOptions>();
    CLI::App& command = *app.add_subcommand("gui", "Opens the workbench");
    command.add_option("scene", options->scene,
                       "A name from 'list scenes', a .toml, .gltf or .glb; else as it was left");
    command.add_option("--describe", options->describe,
                       "A file that always says what is on the screen, as JSON, for tests");
    command
        .add_flag("--unattended", options->unattended,
                  "With --describe, for tests: draws a frame of the window only when no other "
                  "follows at once, and renders as urgently")
        ->needs("--describe");
    addDeviceOption(command);
    return {&command, [options, &registry, gui] {
                if (gui == nullptr) {
                    throw ConfigError(
                        "This program was built without the workbench (KAUSTIK_WITH_GUI); 'kaustik "
                        "run' renders without it.");
                }
                gui(*options, registry);
            }};
}

Subcommand addCheck(CLI::App& app, const Registry& registry) {
    CLI::App& command = *app.add_subcommand(
        "check",
        "Prints what this device offers, what it lacks for which program, and which others there "
        "are");
    addDeviceOption(command);
    return {&command, [&registry] { checkCommand(registry); }};
}

Subcommand addSchema(CLI::App& app, const Registry& registry) {
    const auto what = std::make_shared<std::string>();
    CLI::App& command =
        *app.add_subcommand("schema", "Prints the keys of files, as JSON Schema for editors");
    command.add_option("what", *what, "scene, experiment or report");
    return {&command, [what, &registry] { schemaCommand(*what, registry); }};
}

}  // namespace kaustik::app
