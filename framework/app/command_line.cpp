// SPDX-License-Identifier: MIT
// Parses the command line and turns errors into messages and exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"

namespace kaustik::app {
namespace {

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, "A name from 'list scenes', a .toml, .gltf or .glb")
        ->capture_default_str();
    command.add_option("--technique", options.technique, "A name from 'list techniques'")
        ->capture_default_str();
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
    command.add_option("--time", options.time, "Time of the animation in seconds");
}

// CLI11 says of a misspelt subcommand or option only that it was not expected.
std::string suggestion(const CLI::App& app, int argc, const char* const* argv) {
    if (argc < 2) return "";
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({}))
        commands.push_back(command->get_name());
    const std::string first = argv[1];
    if (std::find(commands.begin(), commands.end(), first) == commands.end()) {
        return first.rfind('-', 0) == 0 ? "" : didYouMean(first, commands);
    }
    std::vector<std::string> options;
    for (const CLI::Option* option : app.get_subcommand(first)->get_options()) {
        for (const std::string& name : option->get_lnames())
            options.push_back("--" + name);
    }
    for (int i = 2; i < argc; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        const bool isKnown = std::find(options.begin(), options.end(), word) != options.end();
        if (word.rfind("--", 0) == 0 && !isKnown) return didYouMean(word, options);
    }
    return "";
}

int fail(const std::string& message, int exitCode) {
    fmt::print(stderr, "kaustik: {}\n", message);
    return exitCode;
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const Registry& registry) {
    CLI::App app("Real-time caustics by screen-space and image-space photon tracing.", "kaustik");
    app.set_version_flag("--version", versionString());
    app.require_subcommand(1);

    RunOptions run;
    CLI::App* runApp = app.add_subcommand("run", "Renders a scene; writes pictures and a report");
    addSceneOptions(*runApp, run.scene);
    runApp->add_option("--frames", run.frames, "Frames that are timed")->capture_default_str();
    runApp->add_option("--warmup", run.warmup, "Frames before them")->capture_default_str();
    runApp->add_option("--seed", run.seed, "Seed of everything random")->capture_default_str();
    runApp->add_flag("--precise", run.precise,
                     "Times each pass with the device finished around it (software rasterisers)");
    runApp->add_option("--reference", run.reference, "Compare with the truth: none")
        ->capture_default_str();
    runApp->add_option("--save", run.saved, "A resource to save, by a name from 'explain'")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    runApp->add_option("--out", run.out, "Folder for what is written");

    ListOptions list;
    CLI::App* listApp = app.add_subcommand("list", "Prints what there is");
    listApp->add_option("what", list.what, "scenes, techniques, nodes or params")
        ->capture_default_str();
    listApp->add_option("--technique", list.technique, "Only what this technique uses");
    listApp->add_flag("--json", list.json, "As JSON");

    ExplainOptions explain;
    CLI::App* explainApp =
        app.add_subcommand("explain", "Prints every pass and why it runs or was left out");
    addSceneOptions(*explainApp, explain.scene);
    explainApp->add_option("--dot", explain.dotFile, "Writes the graph as Graphviz");

    CLI::App* checkApp = app.add_subcommand("check", "Prints what this device offers");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // --help and --version arrive here too, with exit code 0.
        if (error.get_exit_code() == 0) return app.exit(error);
        return fail(fmt::format("{}{} ('kaustik --help' prints what there is).", error.what(),
                                suggestion(app, argc, argv)),
                    kExitBadRequest);
    }
    try {
        if (runApp->parsed()) runCommand(run, registry);
        if (listApp->parsed()) listCommand(list, registry);
        if (explainApp->parsed()) explainCommand(explain, registry);
        if (checkApp->parsed()) checkCommand();
        return kExitDone;
    } catch (const Error& error) {
        return fail(error.what(), error.exitCode());
    } catch (const std::bad_alloc&) {
        return fail("out of memory; use fewer photons, layers or pixels.", kExitDeviceLost);
    } catch (const std::exception& error) {
        return fail(fmt::format("unexpected: {}", error.what()), kExitFailed);
    }
}

}  // namespace kaustik::app
