// SPDX-License-Identifier: MIT
#include "framework/report/run_report.h"

#include "framework/report/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "framework/core/files.h"
#include "framework/report/statistics.h"

namespace kaustik::report {
namespace {

using nlohmann::json;
using namespace transport;

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

json energyJson(const EnergyLedger& ledger) {
    json lost = json::object();
    for (const auto& [account, name] : lossCauses()) {
        if (ledger.watts[account] != 0.0) lost[name] = ledger.watts[account];
    }
    return {{"emitted_w", ledger.watts[kAccountEmitted]},
            {"deposited_w", ledger.watts[kAccountDeposited]},
            {"absorbed_w", ledger.watts[kAccountAbsorbed]},
            {"left_scene_w", ledger.watts[kAccountLeftScene]},
            {"lost_w", lost},
            {"balance", ledger.balance()}};
}

json photonsJson(const EnergyLedger& ledger) {
    const std::uint64_t emitted = ledger.events[kAccountEmitted];
    const std::uint64_t hit = ledger.events[kAccountArrived];
    const std::uint64_t nan = ledger.events[kAccountNotANumber];
    const std::uint64_t stillFlying = ledger.events[kAccountBounceLimit];
    const std::uint64_t rest = hit + nan + stillFlying;
    return {{"emitted", emitted},
            {"specular", emitted},
            {"hit", hit},
            {"missed", emitted > rest ? emitted - rest : 0},
            {"nan", nan}};
}

json passesJson(const RunRecord& record) {
    std::map<std::string, const PassTimes*> timesOf;
    const std::vector<PassTimes> times = timesByPass(record);
    for (const PassTimes& pass : times)
        timesOf[pass.name] = &pass;
    json passes = json::array();
    for (const graph::PassRecord& pass : record.passes) {
        json entry = {{"name", pass.name},
                      {"stage", pass.name.substr(0, pass.name.find('.'))},
                      {"ran", pass.state == graph::PassState::ran},
                      {"why", pass.why}};
        const auto found = timesOf.find(pass.name);
        if (pass.state == graph::PassState::ran && found != timesOf.end()) {
            entry["repeats"] = pass.repeats;
            entry["gpu_ms"] = toJson(summarize(found->second->gpuMilliseconds));
            entry["cpu_ms"] = toJson(summarize(found->second->cpuMilliseconds));
        }
        passes.push_back(std::move(entry));
    }
    return passes;
}

std::vector<double> frameSamples(const RunRecord& record) {
    std::vector<double> samples;
    for (const gl::FrameTime& frame : record.frames)
        samples.push_back(frame.frameMs);
    return samples;
}

std::vector<double> bookkeepingSamples(const RunRecord& record) {
    std::vector<double> samples;
    for (const gl::FrameTime& frame : record.frames)
        samples.push_back(frame.bookkeepingMs);
    return samples;
}

// How wrong what the eye sees through specular surfaces is; "" where it was not judged.
std::string viewLine(const json& view) {
    if (view.is_null()) return "";
    const auto number = [](const json& value, double factor = 1.0) {
        return value.is_null() ? std::string("none")
                               : fmt::format("{:.4g}", factor * value.get<double>());
    };
    std::string line = fmt::format("{:<24}", "view");
    if (view.contains("exit_direction_deg")) {
        const json& direction = view.at("exit_direction_deg");
        line += fmt::format(
            "exit direction median {}°, 95% {}°; position median {} px; interfaces right {}%, lost "
            "{}%; ",
            number(direction.at("median")), number(direction.at("p95")),
            number(view.at("exit_position_px").at("median")),
            number(view.at("interfaces_right"), 100.0), number(view.at("lost"), 100.0));
    }
    if (!view.at("radiance").is_null()) {
        const json& radiance = view.at("radiance");
        line += fmt::format("radiance RMSE {} W/m²/sr, relMSE {}, MAE {}, SSIM {}",
                            number(radiance.at("rmse")), number(radiance.at("rel_mse")),
                            number(radiance.at("mae")), number(radiance.at("ssim")));
    }
    return line + "\n";
}

// How many receivers lie on the wrong side of a shadow.
std::string shadowLine(const json& shadow) {
    if (shadow.at("misclassified").is_null()) return "";
    const auto percent = [&](const char* key) { return 100.0 * shadow.at(key).get<double>(); };
    return fmt::format(
        "{:<24}{:.3g}% of {} pixels misclassified: {:.3g}% lit taken for shadow, {:.3g}% shadow "
        "taken for lit\n",
        "shadow", percent("misclassified"), shadow.at("pixels").get<std::uint64_t>(),
        percent("lit_taken_for_shadow"), percent("shadow_taken_for_lit"));
}

// How much the caustic changes from frame to frame; "" where that was not judged.
std::string flickerLine(const json& flicker) {
    if (flicker.is_null()) return "";
    const auto number = [&](const char* key) { return flicker.at(key).get<double>(); };
    const json& times = flicker.at("of_times_s");
    return fmt::format(
        "{:<24}RMS change {:.4g} W/m² from {:g} s to {:g} s, the truth's {:.4g} (± {:.2g}), "
        "difference {:.3g}\n",
        "flicker", number("rms_w_m2"), times[0].get<double>(), times[1].get<double>(),
        number("truth_rms_w_m2"), number("truth_stderr_w_m2"), number("difference_w_m2"));
}

// A line for hits, and one for every output that has an error.
std::string referenceTable(const RunRecord& record) {
    std::string table;
    const auto orNone = [](const json& value, double factor, const char* unit) {
        return value.is_null() ? std::string("none")
                               : fmt::format("{:.4g}{}", factor * value.get<double>(), unit);
    };
    if (!record.hits.is_null()) {
        table += fmt::format("{:<24}agreement {}, of visible {}; ", "hits",
                             orNone(record.hits.at("agreement"), 100.0, "%"),
                             orNone(record.hits.at("agreement_visible"), 100.0, "%"));
        for (const char* kind : {"missed", "false_hits"}) {
            std::string causes;
            for (const auto& [cause, count] : record.hits.at(kind).items()) {
                if (count == 0) continue;
                causes += fmt::format(" {} {},", cause, count.get<std::uint64_t>());
            }
            if (!causes.empty()) causes.back() = ';';
            table += fmt::format("{}{} ", kind, causes.empty() ? " none;" : causes);
        }
        table += fmt::format("distance median {}, 99% {}\n",
                             orNone(record.hits.at("median_px"), 1.0, " px"),
                             orNone(record.hits.at("p99_px"), 1.0, " px"));
    }
    const auto errorLine = [&](const char* name, const json& error, const char* output,
                               const char* unit) {
        if (!error.contains(output) || error.at(output).is_null()) return;
        const json& errors = error.at(output);
        const auto value = [&](const char* key) { return orNone(errors.at(key), 1.0, ""); };
        const double noise = errors.contains("truth_noise")
                                 ? errors.at("truth_noise").at("rmse").get<double>()
                                 : 0.0;
        table += fmt::format(
            "{:<24}RMSE {} {} (the reference's own {:.2g}), relMSE {}, SSIM {}, FLIP {}, energy "
            "ratio {}\n",
            name, value("rmse"), unit, noise, value("rel_mse"), value("ssim"), value("flip_ldr"),
            value("energy_ratio"));
    };
    const auto errorLines = [&](const char* caustic, const char* inScattered, const json& error) {
        errorLine(caustic, error, "caustic_irradiance", "W/m²");
        errorLine(inScattered, error, "in_scattered", "W/m²/sr");
    };
    if (!record.error.is_null()) {
        errorLines("error", "  in-scattered", record.error);
        if (record.error.contains("modelled_paths")) {
            errorLines("  of modelled paths", "    in-scattered",
                       record.error.at("modelled_paths"));
        }
        if (record.error.contains("flicker")) table += flickerLine(record.error.at("flicker"));
        if (record.error.contains("view")) table += viewLine(record.error.at("view"));
        if (record.error.contains("shadow")) table += shadowLine(record.error.at("shadow"));
    }
    return table;
}

}  // namespace

json needsJson(const scene::SceneNeeds& needs, long long depthComplexity) {
    return {{"specular_interfaces", needs.specularInterfaces},
            {"reflectors", needs.reflectors},
            {"refractors", needs.refractors},
            {"closed_dielectrics", needs.closedDielectrics},
            {"medium", needs.medium},
            {"glossy_receivers", needs.glossyReceivers},
            {"animated", needs.animated},
            {"lights", needs.lights},
            {"receivers", needs.receivers},
            {"depth_complexity", depthComplexity}};
}

std::vector<PassTimes> timesByPass(const RunRecord& record) {
    std::vector<PassTimes> times;
    std::map<std::string, std::size_t> indexOf;
    for (const std::string& name : record.stepNames) {
        if (indexOf.emplace(name, times.size()).second) times.push_back({name, {}, {}});
    }
    for (const gl::FrameTime& frame : record.frames) {
        for (PassTimes& pass : times) {
            pass.gpuMilliseconds.push_back(0.0);
            pass.cpuMilliseconds.push_back(0.0);
        }
        for (std::size_t step = 0; step < frame.passes.size(); ++step) {
            PassTimes& pass = times[indexOf[record.stepNames[step]]];
            pass.gpuMilliseconds.back() += frame.passes[step].gpuMs;
            pass.cpuMilliseconds.back() += frame.passes[step].cpuMs;
        }
    }
    return times;
}

json makeReport(const RunRecord& record, const Renderer& renderer, const gl::DeviceInfo& device) {
    const RenderSettings& settings = renderer.settings();
    json report = {
        {"schema", "kaustik.report/1"},
        {"version", versionString()},
        {"device",
         {{"renderer", device.renderer},
          {"vendor", device.vendor},
          {"gl", device.version},
          {"platform", device.platform},
          {"uuid", device.uuid},
          {"gl_debug", device.debugs},
          {"cpu", processorName()},
          {"threads", std::thread::hardware_concurrency()}}},
        {"scene",
         {{"name", renderer.scene().name},
          {"triangles", triangleCount(renderer.scene())},
          {"needs", needsJson(renderer.needs(), record.layers.complexity)}}},
        {"technique", settings.technique.name},
        {"parameters", settings.params.json()},
        {"disabled", settings.disabledPasses},
        {"time_s", renderer.scene().timeSeconds},
        {"time_step_s", record.timeStepSeconds},
        {"seed", record.seed},
        {"size", {settings.width, settings.height}},
        {"frames", record.frames.size()},
        {"warmup", record.warmup},
        {"timer", record.timer == gl::TimerMode::timestamps ? "gpu" : "finish"},
        {"frame_ms", toJson(summarize(frameSamples(record)))},
        {"bookkeeping_ms", toJson(summarize(bookkeepingSamples(record)))},
        {"graph_build_ms", record.graphBuildMilliseconds},
        {"startup_ms", record.startupMilliseconds},
        {"passes", passesJson(record)},
        {"photons", photonsJson(record.ledger)},
        {"layers",
         {{"allowed", record.layersAllowed},
          {"complexity", record.layers.complexity},
          {"peeled", std::min<std::uint64_t>(record.layers.complexity,
                                             static_cast<std::uint64_t>(record.layersAllowed))},
          {"fragments", record.layers.fragments},
          {"fragments_left_out", record.layers.skipped},
          {"pixels_left_out", record.layers.pixelsSkipped}}},
        {"energy", energyJson(record.ledger)},
        {"memory",
         {{"texture_bytes", record.textureBytes},
          {"buffer_bytes", record.bufferBytes},
          {"scene_bytes", renderer.gpuScene().bytes()},
          {"peak_bytes", record.peakBytes}}},
        {"limits", toJson(reachedLimits(record, renderer))},
        {"warnings", record.warnings}};
    if (!record.map.is_null()) report["map"] = record.map;
    if (!record.cells.is_null()) report["cells"] = record.cells;
    if (!record.hits.is_null()) report["hits"] = record.hits;
    if (!record.error.is_null()) report["error"] = record.error;
    return report;
}

std::string makeTable(const RunRecord& record) {
    const double frame = summarize(frameSamples(record)).median;
    std::string table =
        fmt::format("{:<24}{:>10}{:>9}{:>10}{:>8}\n", "pass", "ms", "±", "CPU ms", "share");
    double sum = 0.0;
    const std::vector<PassTimes> times = timesByPass(record);
    for (const PassTimes& pass : times) {
        const Summary gpu = summarize(pass.gpuMilliseconds);
        sum += gpu.median;
        table += fmt::format("{:<24}{:>10.3f}{:>9.3f}{:>10.3f}{:>7.1f}%\n", pass.name, gpu.median,
                             gpu.standardDeviation, summarize(pass.cpuMilliseconds).median,
                             frame > 0.0 ? 100.0 * gpu.median / frame : 0.0);
    }
    table += fmt::format("{:<24}{:>10.3f}\n", "all passes", sum);
    table += fmt::format("{:<24}{:>10.3f}{:>9.3f}   median of {}, bookkeeping {:.3f} ms\n", "frame",
                         frame, summarize(frameSamples(record)).standardDeviation,
                         record.frames.size(), summarize(bookkeepingSamples(record)).median);
    for (const graph::PassRecord& pass : record.passes) {
        if (pass.state == graph::PassState::ran) continue;
        const char* state = pass.state == graph::PassState::bypassed ? "bypassed" : "skipped";
        table += fmt::format("{:<24}{:>10}   {}\n", pass.name, state, pass.why);
    }
    if (!record.cells.is_null()) {
        const auto count = [&](const char* key) { return record.cells[key].get<unsigned>(); };
        table += fmt::format(
            "cells                 {} photons, {} of them for several cells, of {} probes; level "
            "{}, {} rounds, {} batches\n",
            count("photons"), count("merged"), count("probes"), count("deepest_level"),
            count("rounds"), count("batches"));
    }
    const EnergyLedger& ledger = record.ledger;
    const double emitted = ledger.watts[kAccountEmitted];
    if (emitted > 0.0) {
        const auto share = [&](double watts) { return 100.0 * watts / emitted; };
        table += fmt::format(
            "energy                emitted {:.4g} W: deposited {:.2f}%, absorbed {:.2f}%, "
            "left_scene "
            "{:.2f}%",
            emitted, share(ledger.watts[kAccountDeposited]), share(ledger.watts[kAccountAbsorbed]),
            share(ledger.watts[kAccountLeftScene]));
        for (const auto& [account, name] : lossCauses()) {
            if (ledger.watts[account] != 0.0) {
                table += fmt::format(", {} {:.2f}%", name, share(ledger.watts[account]));
            }
        }
        table += fmt::format("; balance {:.1e}\n", ledger.balance());
    }
    table += referenceTable(record);
    return table;
}

json makeSamples(const RunRecord& record) {
    json passes = json::array();
    for (const PassTimes& pass : timesByPass(record)) {
        passes.push_back({{"name", pass.name},
                          {"gpu_ms", pass.gpuMilliseconds},
                          {"cpu_ms", pass.cpuMilliseconds}});
    }
    return {{"schema", "kaustik.samples/1"},
            {"frame_samples_ms", frameSamples(record)},
            {"bookkeeping_samples_ms", bookkeepingSamples(record)},
            {"passes", passes}};
}

namespace {

// A counter's events, one for each change; viewers draw a track for every value.
class Counter {
  public:
    Counter(json& events, std::string name) : events_(events), name_(std::move(name)) {}
    void set(double timeMs, json values) {
        if (values == last_) return;
        events_.push_back(
            {{"name", name_}, {"ph", "C"}, {"pid", 1}, {"ts", timeMs * 1e3}, {"args", values}});
        last_ = std::move(values);
    }

  private:
    json& events_;
    std::string name_;
    json last_;
};

}  // namespace

json makeChromeTrace(const RunRecord& record) {
    json events = json::array();
    Counter frameTimes(events, "time");
    Counter memory(events, "memory");
    Counter photons(events, "photons");
    double frameBegin = 0.0;
    const auto add = [&](const std::string& name, double startMs, double durationMs, int thread) {
        events.push_back({{"name", name},
                          {"ph", "X"},
                          {"pid", 1},
                          {"tid", thread},
                          {"ts", startMs * 1e3},
                          {"dur", durationMs * 1e3}});
    };
    for (const gl::FrameTime& frame : record.frames) {
        add(fmt::format("frame {}", frame.frame), frameBegin, frame.frameMs, 0);
        frameTimes.set(frameBegin,
                       {{"device_ms", frame.frameMs}, {"bookkeeping_ms", frame.bookkeepingMs}});
        // They are counted in a frame of their own, which repeats the last one.
        if (&frame == &record.frames.back()) photons.set(frameBegin, photonsJson(record.ledger));
        for (std::size_t step = 0; step < frame.passes.size(); ++step) {
            const double begin = frameBegin + frame.passes[step].startMs;
            add(record.stepNames[step], begin, frame.passes[step].gpuMs, 1);
            const auto& [textures, buffers] = record.stepBytes[step];
            memory.set(begin, {{"texture_bytes", textures}, {"buffer_bytes", buffers}});
        }
        frameBegin += frame.frameMs;
    }
    return {{"traceEvents", events}, {"displayTimeUnit", "ms"}};
}

}  // namespace kaustik::report
