// SPDX-License-Identifier: MIT
// Parses the command line and turns errors into messages and exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <set>
#include <system_error>

#include "framework/app/commands.h"
#include "framework/app/merge.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"

namespace kaustik::app {
namespace {

// What follows, and every program that it starts, finds the device in the environment.
void addDeviceOption(CLI::App& command) {
    command.add_option_function<std::string>(
        "--device",
        [](const std::string& device) { ::setenv("KAUSTIK_DEVICE", device.c_str(), 1); },
        "The device: a number or a UUID from 'check', or a part of its name");
    command.add_flag_function(
        "--no-program-cache", [](std::int64_t) { ::setenv("KAUSTIK_PROGRAM_CACHE", "0", 1); },
        "Compiles all shaders anew, and keeps none");
}

// How any scene is rendered.
void addPictureOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("--technique", options.technique, "A name from 'list techniques'")
        ->capture_default_str();
    command.add_flag("--as-published", options.isAsPublished,
                     "The technique as its paper has it to the letter, for its defaults");
    command
        .add_option("--set", options.assignments,
                    "A parameter, as name=value; any unique short form of its name will do")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--disable", options.disabled, "A pass that is not to run")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--size", options.size, "Picture size, WIDTHxHEIGHT")->capture_default_str();
    addDeviceOption(command);
}

constexpr const char* kDeviceModelHelp =
    "A bandwidth of memory, such as 1000GB/s: one more frame counts what each pass reads and "
    "writes, and says how long that takes there at least";
constexpr const char* kSceneHelp =
    "A name from 'list scenes', a .toml, .gltf or .glb, or a mesh: .obj, .ply, .stl, .3ds";

void addOwnMeshOptions(CLI::App& command, OwnMeshOptions& options) {
    command.add_option("--on", options.on,
                       "Stands a mesh, or a .glb, into a scene that is made for it: table, pool, "
                       "room or a .toml; of a mesh alone: table");
    command.add_option("--material", options.material,
                       "What the mesh is of, by its name in that scene: glass, water, mirror, …");
    command.add_option("--up", options.up, "The axis that points up in the mesh's file: y or z");
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, kSceneHelp)->capture_default_str();
    addOwnMeshOptions(command, options.own);
    addPictureOptions(command, options);
    command
        .add_option("--merge", options.merged,
                    "A .toml of settings; a later one counts more, and options more than it")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--time", options.time, "Time of the animation in seconds");
    command.add_flag("--gl-debug", options.glDebug,
                     "Has OpenGL check every pass, which takes time; an error then names its pass");
}

// The options and arguments that the command line itself has, by name.
std::set<std::string> givenOptions(const CLI::App& command) {
    std::set<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        names.insert(option->get_single_name());
    }
    return names;
}

// Merging knows everything else from the parts.
void addMergeOptions(CLI::App& command, ReferenceOptions& options) {
    const std::vector<CLI::Option*> others = command.get_options();
    CLI::Option* const merge = command.add_option(
        "--merge", options.merged, "Instead of a scene: all parts of a reference, as one");
    command.callback([merge, others] {
        for (const CLI::Option* other : others) {
            if (merge->count() > 0 && other->count() > 0)
                throw CLI::ExcludesError(merge->get_name(), other->get_name());
        }
    });
    command
        .add_flag("--incomplete", options.incomplete,
                  "Merges though parts are missing; the reference has fewer photons")
        ->needs(merge);
}

// CLI11 takes a whole number beyond 64 bits for the largest that there is.
std::string integerRangeError(const std::string& text) {
    long long number = 0;
    const char* const first = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [end, problem] = std::from_chars(first, text.data() + text.size(), number);
    if (problem != std::errc::result_out_of_range) return "";  // else it is told as no number
    return fmt::format("{} is not a whole number from {} to {}", text,
                       std::numeric_limits<long long>::min(),
                       std::numeric_limits<long long>::max());
}

std::string unknown(const char* what, const std::string& word,
                    const std::vector<std::string>& names) {
    const std::string suggestion = didYouMean(word, names);
    return fmt::format("There is no {} '{}'{}", what, word, suggestion.empty() ? "." : suggestion);
}

std::vector<std::string> longOptions(const CLI::App& app) {
    std::vector<std::string> options;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            options.push_back(fmt::format("--{}", name));
    }
    return options;
}

// CLI11 says of a misspelt subcommand only that one is required, and of a misspelt option that it
// was not expected.
std::string parseProblem(const CLI::App& app, const CLI::ParseError& error, int argc,
                         const char* const* argv) {
    const std::string text = error.what();
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
        return fmt::format("This is not a number, or not a whole one{}.",
                           text.substr(text.find(':')));
    }
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({}))
        commands.push_back(command->get_name());
    const std::string first = argc > 1 ? argv[1] : "";
    const bool isCommand = std::find(commands.begin(), commands.end(), first) != commands.end();
    if (!first.empty() && !isCommand) {
        if (first[0] == '-') return unknown("option", first, longOptions(app));
        return unknown("subcommand", first, commands);
    }
    for (int i = 2; i < argc && isCommand; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        const std::vector<std::string> options = longOptions(*app.get_subcommand(first));
        const bool isKnown = std::find(options.begin(), options.end(), word) != options.end();
        if (word.rfind("--", 0) == 0 && !isKnown) {
            return unknown("option", word, options);
        }
    }
    return text + ".";
}

// The command whose help would have told.
std::string helpFor(const CLI::App& app, int argc, const char* const* argv) {
    for (const CLI::App* command : app.get_subcommands({})) {
        if (argc > 1 && command->get_name() == argv[1])
            return fmt::format("kaustik {} --help", argv[1]);
    }
    return "kaustik --help";
}

std::string unprintable(int errorNumber) {
    return fmt::format("Standard output cannot be written: {}.", std::strerror(errorNumber));
}

// A full disk may show only when the last of what was printed is written.
void requirePrinted() {
    errno = 0;
    if (std::fflush(stdout) != 0) throw IoError(unprintable(errno));
}

int fail(const std::string& message, int exitCode) {
    fmt::print(stderr, "kaustik: {}\n", message);
    return exitCode;
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const Registry& registry,
                   const ProgramParts& parts) {
    // A file that grows past the shell's limit is then an error of the write, as a full disk is.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app("Real-time caustics by screen-space and image-space photon tracing.", "kaustik");
    app.set_version_flag("--version", versionString());
    app.require_subcommand(1);

    RunOptions run;
    CLI::App* runApp = app.add_subcommand("run", "Renders a scene; writes pictures and a report");
    addSceneOptions(*runApp, run.scene);
    runApp->add_option("--frames", run.frames, "Frames that are timed")->capture_default_str();
    runApp->add_option("--warmup", run.warmup, "Frames before them")->capture_default_str();
    runApp->add_option("--seed", run.seed, "Seed of everything random")
        ->check(integerRangeError)
        ->capture_default_str();
    runApp
        ->add_option("--time-step", run.timeStepSeconds,
                     "Seconds by which the animation goes on from one timed frame to the next")
        ->capture_default_str();
    runApp->add_flag("--precise", run.precise,
                     "Times each pass with the device finished around it (software rasterisers)");
    runApp
        ->add_option("--reference", run.reference,
                     "Compare with the reference: none, auto (computed once and kept), a file of "
                     "'kaustik reference', or certified: with proved bounds ('kaustik certify')")
        ->capture_default_str();
    runApp
        ->add_option("--reference-photons", run.referencePhotons,
                     "Photons that the reference of auto has at least")
        ->check(integerRangeError)
        ->capture_default_str();
    runApp->add_option("--save", run.saved, "A resource to save, by a name from 'explain'")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    runApp->add_option("--device-model", run.deviceModel, kDeviceModelHelp);
    runApp->add_flag("--capture", run.captures,
                     "One more frame, captured by RenderDoc, which must have started this");
    runApp->add_option("--tev", run.viewer,
                       "HOST or HOST:PORT of a running tev, which is sent the pictures");
    runApp->add_option("--out", run.out, "Folder for what is written");
    runApp->add_option("--tile", run.tile,
                       "K/N: only traces photons on the K-th of N tiles of the screen; no picture");
    runApp->add_option("--tiles", run.tiles,
                       "Folder of the tiles' hits; without --tile the picture is made of them");

    std::string tilesFolder;
    CLI::App* tilesApp = app.add_subcommand(
        "tiles", "Takes of all tiles' hits the first, and says whether there is another round");
    tilesApp->add_option("folder", tilesFolder, "That of 'run --tile'")->required();

    BenchOptions bench;
    bench.scene.size = "400x300";
    CLI::App* benchApp = app.add_subcommand(
        "bench", "Keeps times of scenes, or says what has changed between two such files");
    benchApp->add_option("action", bench.action, "save or compare")->required();
    benchApp
        ->add_option("file", bench.files,
                     "save: the file that is written; compare: those of before and after")
        ->required();
    benchApp->add_option("--scene", bench.scenes,
                         "save: a scene that is timed; else pool, glass-sphere, ring, glass-bunny");
    benchApp->add_option("--rounds", bench.rounds, "save: times that each scene is rendered anew")
        ->check(integerRangeError)
        ->capture_default_str();
    benchApp->add_option("--frames", bench.frames, "save: frames of a round, after one to warm up")
        ->check(integerRangeError)
        ->capture_default_str();
    benchApp->add_flag("--precise", bench.isPrecise,
                       "save: with the device finished around each pass");
    addPictureOptions(*benchApp, bench.scene);
    benchApp->add_option(
        "--max-slower", bench.maxSlowerPercent,
        "compare: ends with 1 where a scene is slower by more than so many percent");

    TuneOptions tune;
    CLI::App* tuneApp = app.add_subcommand(
        "tune",
        "Looks for the technique and the number of photons that have an error first, or the least "
        "error within a time, on this device");
    tuneApp->add_option("scene", tune.scene, "As 'run' takes it")->capture_default_str();
    tuneApp->add_option("--error", tune.error,
                        "relMSE of the caustic, net of the reference's noise, to be had in the "
                        "least time");
    tuneApp->add_option("--time", tune.milliseconds,
                        "ms of the caustic's passes, in which to have the least error");
    tuneApp->add_option("--size", tune.size, "WIDTHxHEIGHT of the picture")->capture_default_str();
    tuneApp
        ->add_option("--reference-photons", tune.referencePhotons,
                     "Of the reference that all are judged by, at least")
        ->check(integerRangeError)
        ->capture_default_str();
    tuneApp->add_option("--out", tune.out,
                        "Folder for runs and settings; else results/runs/tune/SCENE. What is there "
                        "is not done again");

    ListOptions list;
    CLI::App* listApp = app.add_subcommand("list", "Prints what there is");
    listApp->add_option("what", list.what, "scenes, techniques, nodes or params")
        ->capture_default_str();
    listApp->add_option("--technique", list.technique, "Only what this technique uses");
    listApp->add_flag("--as-published", list.isAsPublished, "Of it, the row of its paper");
    listApp->add_flag("--json", list.json, "As JSON");

    DocOptions doc;
    CLI::App* docApp =
        app.add_subcommand("doc", "Prints a node's page, or writes a page for each node");
    docApp->add_option("node", doc.node, "A name from 'list nodes'; without it all of them");
    docApp->add_option("--out", doc.out, "Folder for the pages, each NODE.md");

    ExplainOptions explain;
    CLI::App* explainApp =
        app.add_subcommand("explain", "Prints every pass and why it runs or was skipped");
    addSceneOptions(*explainApp, explain.scene);
    explainApp->add_option("--dot", explain.dotFile, "Writes the graph as Graphviz");
    explainApp->add_option("--device-model", explain.deviceModel, kDeviceModelHelp);

    ReferenceOptions reference;
    CLI::App* referenceApp =
        app.add_subcommand("reference", "Computes the ray-traced reference of a scene");
    referenceApp->add_option("scene", reference.scene, kSceneHelp);
    addOwnMeshOptions(*referenceApp, reference.own);
    referenceApp->add_option("--photons", reference.photons, "Stops at this number of photons")
        ->check(integerRangeError);
    referenceApp->add_option("--seconds", reference.seconds, "Stops after this time");
    referenceApp->add_option("--error", reference.standardError,
                             "Stops at this standard error, as a share of a lit pixel's mean");
    referenceApp->add_option("--estimator", reference.estimator, "light or sppm")
        ->capture_default_str();
    referenceApp->add_option("--size", reference.size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    referenceApp->add_option("--time", reference.time, "Time of the animation in seconds");
    referenceApp->add_option("--seed", reference.seed, "Seed of everything random")
        ->check(integerRangeError)
        ->capture_default_str();
    referenceApp->add_option("--threads", reference.threads, "Threads; 0: all; changes no value")
        ->capture_default_str();
    referenceApp->add_flag("--transmission-only", reference.transmissionOnly,
                           "At dielectrics only the refracted branch, unless all is reflected");
    referenceApp
        ->add_option("--interactions", reference.interactions,
                     "Most specular interactions of a photon")
        ->capture_default_str();
    referenceApp->add_flag("--caustic-view", reference.causticView,
                           "Also what the eye sees of it through and in specular surfaces (sppm)");
    referenceApp->add_option("--classes", reference.classes,
                             "Keeps the N brightest classes of paths apart, and all others: layers "
                             "TT, TRT, …, other of NAME.classes.exr");
    referenceApp
        ->add_option("--class", reference.named,
                     "A class to keep apart, as [NAME=]PATTERN: 'L T R+ T D', 'S+ @ring'")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    referenceApp->add_flag("--by-object", reference.byObject,
                           "The classes of --classes are by the first specular object, too");
    referenceApp->add_option("--shard", reference.shard,
                             "K/N: only the K-th of N equal parts of --photons, as a .shard");
    addMergeOptions(*referenceApp, reference);
    referenceApp->add_option("--out", reference.out,
                             "The .exr or .pfm (with --shard: .shard) that is written");

    CensusOptions census;
    CLI::App* censusApp = app.add_subcommand(
        "census",
        "Prints the watts of each class of caustic paths, and what of them each technique forms, "
        "cannot form, and loses");
    censusApp->add_option("scene", census.scene, kSceneHelp)->capture_default_str();
    addOwnMeshOptions(*censusApp, census.own);
    censusApp->add_option("--photons", census.photons, "Photons of the census of paths")
        ->check(integerRangeError)
        ->capture_default_str();
    censusApp
        ->add_option(
            "--technique", census.techniques,
            "A name from 'list techniques'; without it all, with defaults and as published")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    censusApp
        ->add_option("--set", census.assignments, "A parameter of the techniques, as name=value")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    censusApp
        ->add_option("--technique-photons", census.techniquePhotons,
                     "Photons of a technique's frame, WIDTHxHEIGHT")
        ->capture_default_str();
    censusApp->add_option("--size", census.size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    censusApp->add_option("--time", census.time, "Time of the animation in seconds");
    censusApp->add_flag("--json", census.json, "As JSON");
    censusApp->add_option("--out", census.out,
                          "Folder for classes.csv, techniques.csv and census.json");
    addDeviceOption(*censusApp);

    CertifyCommandOptions certify;
    CLI::App* certifyApp = app.add_subcommand(
        "certify", "Encloses each pixel's caustic irradiance in an interval, with a proof");
    certifyApp->add_option("scene", certify.scene, kSceneHelp);
    addOwnMeshOptions(*certifyApp, certify.own);
    certifyApp->add_option("--size", certify.size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    certifyApp->add_option("--time", certify.time, "Time of the animation in seconds");
    certifyApp
        ->add_option("--interactions", certify.interactions,
                     "Most specular interactions of the paths that are certified, 1 to 8")
        ->capture_default_str();
    certifyApp->add_flag("--transmission-only", certify.transmissionOnly,
                         "At dielectrics only the refracted branch, unless all is reflected");
    certifyApp
        ->add_option(
            "--band", certify.band,
            "Pixels by which a cell's place on the screen may be unsure before it is split")
        ->capture_default_str();
    certifyApp->add_option("--depth", certify.depth, "Splits of a triangle at most, each into four")
        ->capture_default_str();
    certifyApp->add_option("--threads", certify.threads, "Threads; 0: all; changes no value")
        ->capture_default_str();
    certifyApp->add_option("--shard", certify.shard, "K/N: only the K-th of N parts, as a .shard");
    certifyApp->add_option("--merge", certify.merged,
                           "All parts of a certificate of this scene, as one");
    certifyApp->add_option("--out", certify.out,
                           "The .exr or .pfm (with --shard: .shard) that names what is written");

    CompareOptions compare;
    CLI::App* compareApp =
        app.add_subcommand("compare", "Prints how wrong an image is against a reference");
    compareApp->add_option("image", compare.image, "An .exr, .pfm or .png")->required();
    compareApp->add_option("reference", compare.reference, "The reference, of the same size")
        ->required();
    compareApp->add_flag("--json", compare.json, "As JSON, with formulas");
    compareApp->add_option("--heatmap", compare.heatMapFile, "Writes where it is wrong, as .png");
    compareApp->add_option("--stderr", compare.standardErrorFile,
                           "The reference's standard error, an image of the same kind");
    compareApp->add_option("--area", compare.areaFile,
                           "An image of the area that a pixel sees, so that sums are flux");
    compareApp->add_option("--ppd", compare.pixelsPerDegree,
                           "Pixels in a degree of the viewer's sight, for FLIP");
    compareApp->add_option("--mask", compare.maskFile, "An image that is 0 where not to compare");

    ImportOptions imported;
    CLI::App* importApp =
        app.add_subcommand("import", "Makes a scene file of another renderer's scene");
    importApp->add_option("file", imported.file, "A scene of Mitsuba, .xml, or Tungsten, .json")
        ->required();
    importApp->add_option("--out", imported.out, "The .toml that is written")->required();
    importApp
        ->add_option("--missing-textures", imported.missingTextures,
                     "What a picture that is not there is: error or grey")
        ->capture_default_str();

    ExportOptions exported;
    CLI::App* exportApp =
        app.add_subcommand("export", "Writes a scene and its meshes for another renderer");
    exportApp->add_option("scene", exported.scene, kSceneHelp)->required();
    addOwnMeshOptions(*exportApp, exported.own);
    exportApp->add_option("--to", exported.to, "povray, mitsuba, gltf or pbrt")->required();
    exportApp->add_option("--out", exported.out, "The folder that is written to")->required();
    exportApp->add_option("--size", exported.size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    exportApp->add_option("--time", exported.time, "Time of the animation in seconds");
    exportApp
        ->add_option("--photons", exported.photons, "That its renderer is asked to shoot, about")
        ->check(integerRangeError)
        ->capture_default_str();

    JudgeOptions judged;
    CLI::App* judgeApp = app.add_subcommand(
        "judge", "Says what is wrong with another renderer's picture of a scene");
    judgeApp->add_option("scene", judged.scene, kSceneHelp)->required();
    judgeApp->add_option("theirs", judged.theirs, "The picture, .exr or .pfm in linear light")
        ->required();
    addOwnMeshOptions(*judgeApp, judged.own);
    judgeApp->add_flag("--caustic-only", judged.causticOnly,
                       "It has no direct light; without either it is found out");
    judgeApp->add_flag("--with-direct", judged.withDirect, "It has direct light, too");
    judgeApp
        ->add_option("--glass", judged.glass,
                     "Whether its eye sees glass and water, or straight through: auto, seen or "
                     "hidden")
        ->capture_default_str();
    judgeApp
        ->add_option("--encoding", judged.encoding,
                     "What its values are: auto, linear, srgb or gamma2.2")
        ->capture_default_str();
    judgeApp->add_option("--exposure", judged.exposure,
                         "Its value for 1 W/m²/sr, where that is known; else it is found");
    judgeApp->add_option("--stderr", judged.theirsErrorFile,
                         "Its standard error, an image of the same size; else it is estimated");
    judgeApp->add_option("--size", judged.size,
                         "Picture size of the reference, WIDTHxHEIGHT, where it is another");
    judgeApp->add_option("--time", judged.time, "Time of the animation in seconds");
    judgeApp->add_option("--photons", judged.photons, "Photons of the reference")
        ->check(integerRangeError)
        ->capture_default_str();
    judgeApp->add_option("--seed", judged.seed, "Seed of the reference")
        ->check(integerRangeError)
        ->capture_default_str();
    judgeApp->add_option("--classes", judged.classes, "Classes of paths at most, the brightest")
        ->capture_default_str();
    judgeApp->add_flag("--no-causes", judged.noCauses,
                       "Only classes: no references of what else may be wrong");
    judgeApp->add_flag("--json", judged.json, "As JSON");
    judgeApp->add_option("--out", judged.out,
                         "Folder for judge.json, judge.txt, where.png and residual.exr");

    ExperimentOptions experiment;
    CLI::App* experimentApp =
        app.add_subcommand("experiment", "Does all runs of a study, or draws what they found");
    experimentApp->add_option("action", experiment.action, "run, merge or report")->required();
    experimentApp
        ->add_option("target", experiment.targets,
                     "run: the study, a .toml; report: its results; merge: those of its shards")
        ->required();
    experimentApp->add_option("--out", experiment.out, "Folder for the results of run and merge");
    addDeviceOption(*experimentApp);
    experimentApp->add_option("--shard", experiment.shard,
                              "K/N: run does only the K-th of N parts of the study");
    experimentApp
        ->add_option("--only", experiment.only,
                     "KEY=VALUE: run does only the runs with this value of what the study varies; "
                     "repeatable, values of one key are alternatives")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    experimentApp->add_flag("--incomplete", experiment.incomplete,
                            "merge takes what there is, though runs are missing");
    experimentApp->add_flag("--resume", experiment.resume, "Leaves finished runs alone");

    GuiOptions guiOptions;
    CLI::App* guiApp = app.add_subcommand("gui", "Opens the workbench");
    guiApp->add_option("scene", guiOptions.scene,
                       "A name from 'list scenes', a .toml, .gltf or .glb; else as it was left");
    guiApp->add_option("--describe", guiOptions.describe,
                       "A file that always says what is on the screen, as JSON, for tests");

    addDeviceOption(*guiApp);

    CLI::App* checkApp =
        app.add_subcommand("check", "Prints what this device offers, and which others there are");
    addDeviceOption(*checkApp);

    std::string schemaOf;
    CLI::App* schemaApp =
        app.add_subcommand("schema", "Prints the keys of files, as JSON Schema for editors");
    schemaApp->add_option("what", schemaOf, "scene, experiment or report");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // --help and --version arrive here too, with exit code 0.
        if (error.get_exit_code() == 0) return app.exit(error);
        return fail(fmt::format("{} '{}' prints what there is.",
                                parseProblem(app, error, argc, argv), helpFor(app, argc, argv)),
                    kExitBadRequest);
    }
    try {
        if (runApp->parsed()) {
            mergeSettings(run, givenOptions(*runApp), registry);
            putOwnMesh(run.scene.scene, run.scene.own);
            runCommand(run, registry);
        }
        if (tilesApp->parsed()) tilesCommand(tilesFolder);
        if (benchApp->parsed()) benchCommand(bench, registry);
        if (tuneApp->parsed()) tuneCommand(tune, registry);
        if (listApp->parsed()) listCommand(list, registry);
        if (docApp->parsed()) docCommand(doc, registry);
        if (explainApp->parsed()) {
            mergeSettings(explain, givenOptions(*explainApp), registry);
            putOwnMesh(explain.scene.scene, explain.scene.own);
            explainCommand(explain, registry);
        }
        if (referenceApp->parsed()) {
            putOwnMesh(reference.scene, reference.own);
            referenceCommand(reference);
        }
        if (censusApp->parsed()) {
            putOwnMesh(census.scene, census.own);
            censusCommand(census, registry);
        }
        if (certifyApp->parsed()) {
            putOwnMesh(certify.scene, certify.own);
            certifyCommand(certify);
        }
        if (compareApp->parsed()) compareCommand(compare);
        if (importApp->parsed()) importCommand(imported);
        if (judgeApp->parsed()) {
            putOwnMesh(judged.scene, judged.own);
            judgeCommand(judged);
        }
        if (exportApp->parsed()) {
            putOwnMesh(exported.scene, exported.own);
            exportCommand(exported);
        }
        if (experimentApp->parsed()) experimentCommand(experiment, registry, parts.addHardCases);
        if (checkApp->parsed()) checkCommand();
        if (schemaApp->parsed()) schemaCommand(schemaOf, registry);
        if (guiApp->parsed()) {
            if (parts.gui == nullptr) {
                throw ConfigError(
                    "This program was built without the workbench (KAUSTIK_WITH_GUI); 'kaustik "
                    "run' renders without it.");
            }
            parts.gui(guiOptions, registry);
        }
        requirePrinted();
        return kExitDone;
    } catch (const Error& error) {
        return fail(error.what(), error.exitCode());
    } catch (const std::bad_alloc&) {
        return fail("out of memory; use fewer photons, layers or pixels.", kExitDeviceLost);
    } catch (const std::system_error& error) {
        if (std::ferror(stdout) != 0) return fail(unprintable(error.code().value()), kExitFailed);
        return fail(fmt::format("unexpected: {}.", error.what()), kExitFailed);
    } catch (const std::exception& error) {
        return fail(fmt::format("unexpected: {}.", error.what()), kExitFailed);
    }
}

}  // namespace kaustik::app
