// SPDX-License-Identifier: MIT
// kaustik bench: save renders scenes in rounds and keeps their times, compare says what has become
// faster or slower between two such files, and what the noise hides.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/core/machine.h"
#include "framework/experiment/bench.h"
#include "framework/report/statistics.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"
#include "framework/run/session.h"

namespace kaustik::app {
namespace {

using namespace experiment;

const std::vector<std::string> kDefaultScenes = {"pool", "glass-sphere", "ring", "glass-bunny"};

std::string settingsText(const BenchOptions& options) {
    const SceneOptions& scene = options.scene;
    std::string text = fmt::format("--technique {} --size {} --frames {}", scene.technique,
                                   scene.size, options.frames);
    if (scene.isAsPublished) text += " --as-published";
    if (options.isPrecise) text += " --precise";
    for (const std::string& assignment : scene.assignments)
        text += " --set " + assignment;
    for (const std::string& pass : scene.disabled)
        text += " --disable " + pass;
    return text;
}

// One round of a scene: a session of its own, so that what it begins with is the same every time.
report::RunRecord renderRound(gl::Context& context, const BenchOptions& options,
                              const std::string& name, const Registry& registry) {
    scene::Scene scene = loadRequestedScene(name, options.scene.time);
    run::Session session(context, registry, scene, makeSettings(options.scene, registry),
                         {.isPrecise = options.isPrecise});
    session.render({options.frames, 1}, {{}, [](int) { run::throwIfInterrupted(); }}, nullptr);
    return session.record();
}

void addRound(SceneTimes& times, const report::RunRecord& record, int round) {
    times.frame.push_back(report::summarize(report::frameSamples(record)).median);
    for (const report::PassTimes& pass : report::timesByPass(record))
        times.passes[pass.name].push_back(report::summarize(pass.gpuMilliseconds).median);
    // A pass that takes no time that the clock sees has no ratio.
    std::erase_if(times.passes, [&](const auto& pass) {
        return pass.second.size() != static_cast<std::size_t>(round) + 1 ||
               !(pass.second.back() > 0.0);
    });
}

void save(const BenchOptions& options, const Registry& registry) {
    if (options.files.size() != 1)
        throw ConfigError("bench save: give one file that the times are written to.");
    if (options.rounds < 2)
        throw ConfigError("--rounds: fewer than 2 do not say how much times scatter.");
    run::checkSeries({options.frames, 1}, {"--frames", "", ""});
    const std::vector<std::string>& given =
        options.scenes.empty() ? kDefaultScenes : options.scenes;
    const std::set<std::string> scenes(given.begin(), given.end());  // each once
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(false);
    run::catchInterrupts();
    Bench bench;
    bench.version = versionString();
    // On a software rasteriser the processor is the device.
    bench.device = fmt::format("{}, {}, {} threads", context->info().renderer, processorName(),
                               std::thread::hardware_concurrency());
    bench.settings = settingsText(options);
    run::Progress progress("round", options.rounds * static_cast<int>(scenes.size()));
    int done = 0;
    // Scene after scene in every round, so that what changes on the machine meanwhile is in all of
    // them.
    for (int round = 0; round < options.rounds; ++round) {
        for (const std::string& name : scenes) {
            const report::RunRecord record = renderRound(*context, options, name, registry);
            addRound(bench.scenes[name], record, round);
            if (bench.date.empty()) bench.date = record.timing.date;
            bench.otherProcessors =
                std::max(bench.otherProcessors, record.timing.otherProcessors.value_or(0.0));
            progress.update(++done);
        }
    }
    writeFileWhole(options.files.front(), jsonText(benchJson(bench), 2) + "\n");
    for (const auto& [name, times] : bench.scenes) {
        const report::Summary frame = report::summarize(times.frame);
        fmt::print("{:<24}{:>10.2f} ms{:>8.2f}   median and spread of {} rounds\n", name,
                   frame.median, frame.standardDeviation, options.rounds);
    }
    if (bench.otherProcessors > 0.1) {
        fmt::print(
            "warning: other work kept up to {:.1f} processors busy; on an idle machine smaller "
            "changes show.\n",
            bench.otherProcessors);
    }
    fmt::print("wrote {}\n", options.files.front());
}

std::string lineOf(const std::string& name, const TimeChange& change) {
    const char* const words[] = {"no difference seen", "faster", "slower"};
    return fmt::format("{:<32}{:>7.3f}   {:.3f} to {:.3f}   {}\n", name, change.ratio, change.low,
                       change.high, words[static_cast<int>(change.verdict())]);
}

void compare(const BenchOptions& options) {
    if (options.files.size() != 2)
        throw ConfigError("bench compare: give two files, of before and after.");
    const std::vector<SceneChange> changes =
        compareBenches(readBench(options.files[0]), readBench(options.files[1]));
    fmt::print("{:<32}{:>7}   with 95 % confidence for all scenes together\n",
               "time after / before", "ratio");
    const SceneChange* slowest = nullptr;
    for (const SceneChange& change : changes) {
        fmt::print("{}", lineOf(change.scene, change.frame));
        for (const auto& [pass, of] : change.passes)
            if (of.verdict() != Verdict::undecided) fmt::print("{}", lineOf("  " + pass, of));
        if (slowest == nullptr || change.frame.low > slowest->frame.low) slowest = &change;
    }
    if (options.maxSlowerPercent && slowest->frame.low > 1.0 + *options.maxSlowerPercent / 100.0) {
        throw Error(
            fmt::format("{} is slower by at least {:.1f}%, which is more than --max-slower {:g}.",
                        slowest->scene, 100.0 * (slowest->frame.low - 1.0),
                        *options.maxSlowerPercent),
            kExitFailed);
    }
}

}  // namespace

void benchCommand(const BenchOptions& options, const Registry& registry) {
    if (options.action == "save") return save(options, registry);
    if (options.action == "compare") return compare(options);
    throw ConfigError(
        fmt::format("bench: there is no '{}'; it is save or compare.", options.action));
}

}  // namespace kaustik::app
