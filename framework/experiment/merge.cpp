// SPDX-License-Identifier: MIT
#include "framework/experiment/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_number.h"
#include "framework/core/json_text.h"
#include "framework/experiment/fingerprint.h"
#include "framework/experiment/results.h"
#include "framework/experiment/run_folder.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kDescription = "experiment.json";

struct Study {
    std::string name;
    std::string text;  // of experiment.json
    int repeats = 1;
    std::vector<PlannedRun> runs;  // hash, axes and products
};

json readDescription(const fs::path& folder) {
    const fs::path file = folder / kDescription;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        throw IoError(fmt::format(
            "{} holds no {}; 'kaustik experiment run SPEC.toml --shard K/N --out {}' makes one.",
            folder.string(), kDescription, folder.string()));
    }
    json described = parseJson(readFile(file), file.string());
    if (!described.is_object() || described.value("schema", json()) != "kaustik.experiment/1")
        throw IoError(fmt::format("{} is not a kaustik.experiment/1.", file.string()));
    return described;
}

// Why two folders cannot be of one study; "" where they are.
std::string differenceBetween(const json& one, const json& other) {
    if (one == other) return "";
    for (const char* key : {"name", "version", "repeats"}) {
        const json mine = one.value(key, json());
        const json its = other.value(key, json());
        if (mine != its) return fmt::format("{} {} instead of {}", key, its.dump(), mine.dump());
    }
    const auto axesOf = [](const json& described) {
        json axes = json::array();
        for (const json& run : described.at("runs"))
            axes.push_back(run.at("axes"));
        return axes;
    };
    if (one.at("runs") != other.at("runs") && axesOf(one) == axesOf(other))
        return "other contents of a scene, or other settings that all its runs share";
    return "other runs or another description";
}

Study readStudy(const std::vector<fs::path>& folders) {
    Study study;
    try {
        const json first = readDescription(folders.front());
        for (const fs::path& folder : folders) {
            const std::string difference = differenceBetween(first, readDescription(folder));
            if (!difference.empty()) {
                throw ConfigError(fmt::format("{} and {} are not of one study: the latter has {}.",
                                              folders.front().string(), folder.string(),
                                              difference));
            }
        }
        study.text = readFile(folders.front() / kDescription);
        study.name = first.at("name");
        study.repeats = wholeNumber<int>(first.at("repeats"));
        for (const json& described : first.at("runs")) {
            PlannedRun run;
            run.hash = described.at("hash");
            if (run.hash.find_first_not_of("0123456789abcdef") != std::string::npos) {
                throw IoError(fmt::format("{}: '{}' is no fingerprint of a run.",
                                          (folders.front() / kDescription).string(), run.hash));
            }
            run.axes = described.at("axes");
            for (const json& product : described.at("products"))
                run.products.push_back(wholeNumber<int>(product));
            study.runs.push_back(std::move(run));
        }
        const std::uint64_t maximum = study.runs.empty() ? 1 : kMaxRuns / study.runs.size();
        if (study.repeats < 1 || static_cast<std::uint64_t>(study.repeats) > maximum) {
            throw IoError(fmt::format("{} is damaged: {} repeats of {} runs cannot be.",
                                      (folders.front() / kDescription).string(), study.repeats,
                                      study.runs.size()));
        }
    } catch (const json::exception& error) {
        throw IoError(fmt::format("{} is damaged: {}.", (folders.front() / kDescription).string(),
                                  error.what()));
    }
    return study;
}

// One repeat of a run: where it is, or why there is none.
struct Merged {
    const PlannedRun* run = nullptr;
    int repeat = 1;
    fs::path from;  // the folder of results that has the one that counts
    bool isDone = false;
    Result result;
    std::string finished;  // when, and all else that the record says
    std::string damage;    // of one that would have counted
};

// Why a run failed, as its record has it.
std::string messageOf(const fs::path& failure) {
    try {
        return parseJson(readFile(failure), failure.string()).at("message").get<std::string>();
    } catch (const json::exception&) {
    } catch (const IoError&) {
    }
    return "its record is damaged";
}

// Takes the run of `folder` where it counts more than what there is by now.
void consider(Merged& merged, const fs::path& folder) {
    const fs::path path = runFolder(folder, *merged.run, merged.repeat);
    std::error_code error;
    if (fs::exists(path, error)) {
        try {
            // What the run was to be is in its record; its name is the fingerprint of that.
            PlannedRun run = *merged.run;
            const fs::path file = path / "run.json";
            const json record = parseJson(readFile(file), file.string());
            if (record.is_object()) run.settings = record.value("settings", json());
            if (fingerprint(run.settings.dump()) != run.hash)
                throw IoError(fmt::format("{}: this is another run.", file.string()));
            const FinishedRun finished = readFinishedRun(path, run, merged.repeat);
            const json& done = finished.record;
            const std::string when = done.value("finished", json()).dump() + done.dump();
            if (merged.isDone && merged.finished <= when) return;
            merged.result = resultOf(run, merged.repeat, finished);
            merged.from = folder;
            merged.isDone = true;
            merged.finished = when;
            return;
        } catch (const IoError& damage) {
            if (merged.damage.empty()) merged.damage = damage.what();
        } catch (const json::exception& damage) {
            if (merged.damage.empty())
                merged.damage = fmt::format("{} is damaged: {}.", path.string(), damage.what());
        }
    }
    const fs::path failure = failureFile(folder, *merged.run, merged.repeat);
    if (merged.isDone || !fs::exists(failure, error)) return;
    const std::string message = messageOf(failure);
    if (!merged.from.empty() && merged.finished <= message) return;
    merged.result = failedResult(*merged.run, merged.repeat, message);
    merged.from = folder;
    merged.finished = message;
}

bool isMissing(const Merged& merged) {
    return merged.from.empty();
}

[[noreturn]] void failMissing(const std::vector<Merged>& all, int missing) {
    const Merged& first = *std::find_if(all.begin(), all.end(), isMissing);
    std::string settings;
    for (const auto& [key, value] : first.run->axes.items())
        settings += fmt::format("{} = {}, ", key, value.dump());
    throw ConfigError(fmt::format(
        "{} of {} runs are missing, the first with {}repeat {}{}. Do their shards first (--resume "
        "leaves finished runs alone), or take what there is with --incomplete.",
        missing, all.size(), settings, first.repeat,
        first.damage.empty()
            ? ""
            : fmt::format(" ({})", first.damage.substr(0, first.damage.size() - 1))));
}

// Brings one run, or why it failed, into `out`.
void bring(const Merged& merged, const fs::path& out) {
    const fs::path failure = failureFile(out, *merged.run, merged.repeat);
    std::error_code error;
    if (merged.isDone) {
        const fs::path place = runFolder(out, *merged.run, merged.repeat);
        if (!fs::equivalent(merged.from, out, error)) {
            const fs::path fresh = unfinishedPath(place);
            fs::remove_all(fresh, error);
            fs::copy(runFolder(merged.from, *merged.run, merged.repeat), fresh,
                     fs::copy_options::recursive, error);
            if (error) {
                const std::string reason = error.message();
                fs::remove_all(fresh, error);
                throw IoError(fmt::format("{} cannot be written: {}.", place.string(), reason));
            }
            moveIntoPlace(fresh, place);
        }
        fs::remove(failure, error);
    } else if (!fs::equivalent(merged.from, out, error)) {
        writeFileWhole(failure, readFile(failureFile(merged.from, *merged.run, merged.repeat)));
    }
}

}  // namespace

ResultsMergeSummary mergeResults(const std::vector<fs::path>& folders,
                                 const ResultsMergeOptions& options) {
    std::vector<fs::path> sources = folders;
    std::error_code error;
    if (fs::exists(options.out / kDescription, error)) sources.push_back(options.out);
    const Study study = readStudy(sources);
    std::vector<Merged> all;
    ResultsMergeSummary summary;
    summary.name = study.name;
    for (const PlannedRun& run : study.runs) {
        for (int repeat = 1; repeat <= study.repeats; ++repeat) {
            Merged merged;
            merged.run = &run;
            merged.repeat = repeat;
            for (const fs::path& folder : sources)
                consider(merged, folder);
            summary.done += merged.isDone ? 1 : 0;
            summary.missing += isMissing(merged) ? 1 : 0;
            if (!merged.isDone && !isMissing(merged)) {
                ++summary.failed;
                if (summary.firstFailure.empty()) summary.firstFailure = merged.finished;
            }
            all.push_back(std::move(merged));
        }
    }
    summary.planned = static_cast<int>(all.size());
    if (summary.missing > 0 && !options.incomplete) failMissing(all, summary.missing);

    const OutputFolder held(options.out, OutputFolder::Use::alone);
    writeFileWhole(options.out / kDescription, study.text);
    std::vector<const Result*> results;
    int brought = 0;
    for (const Merged& merged : all) {
        if (options.isInterrupted()) {
            summary.interrupted = true;
            return summary;
        }
        if (!isMissing(merged)) bring(merged, options.out);
        results.push_back(&merged.result);
        options.onProgress(++brought, summary.planned);
    }
    writeRows(options.out, results);
    writeSamples(options.out, results);
    return summary;
}

}  // namespace kaustik::experiment
