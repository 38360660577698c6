// SPDX-License-Identifier: MIT
#include "framework/experiment/bench.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_schema.h"
#include "framework/core/json_text.h"

namespace kaustik::experiment {

using nlohmann::json;

namespace {

constexpr const char* kSchema = "kaustik.bench/1";
constexpr double kDoubt = 0.05;

}  // namespace

template <class F>
void reflect(F& f, const SceneTimes& times) {
    f.field("frame_ms", times.frame, "Of whole frames, a median for each round");
    f.field("passes", times.passes, "Of each pass that ran in all rounds, ms");
}
template <class F>
void reflect(F& f, const Bench& bench) {
    f.choice("schema", kSchema, {kSchema}, "The format of this file");
    f.field("version", bench.version, "Of the program");
    f.field("date", bench.date, "When it began, UTC");
    f.field("device", bench.device, "The model that the times are of");
    f.field("settings", bench.settings, "Of all scenes");
    f.field("other_processors", bench.otherProcessors, "That other work kept busy, at most");
    f.field("scenes", bench.scenes, "Times by scene");
}

json benchJson(const Bench& bench) {
    return jsonOf(bench);
}

Bench readBench(const std::filesystem::path& file) {
    const json read = parseJson(readFile(file), file.string());
    const auto damaged = [&](const std::string& why) {
        return IoError(
            fmt::format("{} is no file of 'kaustik bench save': {}.", file.string(), why));
    };
    const auto timesOf = [&](const json& list) {
        std::vector<double> times = list.get<std::vector<double>>();
        for (const double time : times)
            if (!(time > 0.0) || !std::isfinite(time)) throw damaged("a time is not above 0");
        if (times.empty()) throw damaged("a scene has no times");
        return times;
    };
    try {
        if (read.at("schema") != kSchema) throw damaged("its schema is another");
        Bench bench{read.at("version"),          read.at("date"),
                    read.at("device"),           read.at("settings"),
                    read.at("other_processors"), {}};
        for (const auto& [name, times] : read.at("scenes").items()) {
            SceneTimes& scene = bench.scenes[name];
            scene.frame = timesOf(times.at("frame_ms"));
            for (const auto& [pass, list] : times.at("passes").items())
                scene.passes[pass] = timesOf(list);
        }
        return bench;
    } catch (const json::exception& error) {
        throw damaged(error.what());
    }
}

// The density is integrated by Simpson's rule over the angle whose tangent is t over the root of
// the degrees, where it is a power of the cosine, and the bound found by halves.
double studentT(double degrees, double doubt) {
    const double log = std::lgamma(0.5 * (degrees + 1.0)) - std::lgamma(0.5 * degrees);
    const double scale = std::exp(log) / std::sqrt(std::acos(-1.0));
    const auto between = [&](double t) {  // the probability from -t to t
        constexpr int kSteps = 400;
        const double end = std::atan(t / std::sqrt(degrees));
        double sum = 0.0;
        for (int i = 0; i <= kSteps; ++i) {
            const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
            sum += weight * std::pow(std::cos(end * i / kSteps), degrees - 1.0);
        }
        return 2.0 * scale * sum * end / (3.0 * kSteps);
    };
    double low = 0.0, high = 1.0;
    while (between(high) < 1.0 - doubt && high < 1e9)
        high *= 2.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (between(middle) < 1.0 - doubt ? low : high) = middle;
    }
    return high;
}

TimeChange changeOfTime(const std::vector<double>& before, const std::vector<double>& after,
                        double doubt) {
    struct Logs {
        double mean = 0.0;
        double error2 = 0.0;  // of the mean, squared
        double degrees = 0.0;
    };
    const auto logsOf = [](const std::vector<double>& times) {
        Logs logs;
        const auto count = static_cast<double>(times.size());
        for (const double time : times)
            logs.mean += std::log(time) / count;
        logs.degrees = count - 1.0;
        for (const double time : times)
            logs.error2 += std::pow(std::log(time) - logs.mean, 2.0);
        logs.error2 /= std::max(logs.degrees, 1.0) * count;
        return logs;
    };
    const Logs a = logsOf(before);
    const Logs b = logsOf(after);
    const double ratio = std::exp(b.mean - a.mean);
    if (a.degrees < 1.0 || b.degrees < 1.0)
        return {ratio, 0.0, std::numeric_limits<double>::infinity()};
    const double error2 = a.error2 + b.error2;
    // Of times that are all alike nothing says how much they scatter but the clock.
    if (!(error2 > 0.0)) return {ratio, ratio, ratio};
    const double degrees =
        error2 * error2 / (a.error2 * a.error2 / a.degrees + b.error2 * b.error2 / b.degrees);
    const double reach = studentT(degrees, doubt) * std::sqrt(error2);
    return {ratio, ratio * std::exp(-reach), ratio * std::exp(reach)};
}

std::vector<SceneChange> compareBenches(const Bench& before, const Bench& after) {
    if (before.device != after.device) {
        throw ConfigError(
            fmt::format("bench: the times are of different devices, '{}' and '{}', which says "
                        "nothing of the versions.",
                        before.device, after.device));
    }
    if (before.settings != after.settings) {
        throw ConfigError(fmt::format("bench: the times are of different settings, '{}' and '{}'.",
                                      before.settings, after.settings));
    }
    std::vector<std::string> both;
    for (const auto& [name, times] : before.scenes)
        if (after.scenes.contains(name)) both.push_back(name);
    if (both.empty()) throw ConfigError("bench: the two have no scene in common.");
    std::vector<SceneChange> changes;
    for (const std::string& name : both) {
        const SceneTimes& then = before.scenes.at(name);
        const SceneTimes& now = after.scenes.at(name);
        const auto doubtOf = [](std::size_t count) { return kDoubt / static_cast<double>(count); };
        SceneChange& change = changes.emplace_back();
        change.scene = name;
        change.frame = changeOfTime(then.frame, now.frame, doubtOf(both.size()));
        std::vector<std::string> passes;
        for (const auto& [pass, times] : then.passes)
            if (now.passes.contains(pass)) passes.push_back(pass);
        for (const std::string& pass : passes)
            change.passes[pass] =
                changeOfTime(then.passes.at(pass), now.passes.at(pass), doubtOf(passes.size()));
    }
    return changes;
}

}  // namespace kaustik::experiment
