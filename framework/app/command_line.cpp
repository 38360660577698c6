// SPDX-License-Identifier: MIT
// Parses the command line and turns errors into messages and exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "framework/app/commands.h"
#include "framework/app/subcommands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"

namespace kaustik::app {
namespace {

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

    // In the order in which --help lists them.
    const std::vector<Subcommand> subcommands = {
        addRun(app, registry),
        addTiles(app),
        addBench(app, registry),
        addTune(app, registry),
        addList(app, registry),
        addDoc(app, registry),
        addExplain(app, registry),
        addReference(app),
        addCensus(app, registry),
        addCertify(app),
        addCompare(app),
        addImport(app),
        addExport(app),
        addJudge(app),
        addExperiment(app, registry, parts.addHardCases),
        addGui(app, registry, parts.gui),
        addCheck(app, registry),
        addSchema(app, registry),
    };

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
        for (const Subcommand& subcommand : subcommands) {
            if (subcommand.parser->parsed()) subcommand.execute();
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
