// SPDX-License-Identifier: MIT
// What a run found out, as a table for people.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "framework/report/run_report.h"
#include "framework/report/statistics.h"

namespace kaustik::report {
namespace {

using nlohmann::json;
using namespace transport;

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
        line += fmt::format(
            "radiance RMSE {} W/m²/sr, relMSE {}, SMAPE {}, MAE {}, SSIM {}, energy ratio {}",
            number(radiance.at("rmse")), number(radiance.at("rel_mse")),
            number(radiance.at("smape")), number(radiance.at("mae")), number(radiance.at("ssim")),
            number(radiance.at("energy_ratio")));
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

// What became of the eye's rays through specular surfaces; "" where there are none.
std::string eyeRaysLine(const EyeRays& rays) {
    if (rays.pixels == 0) return "";
    std::string line =
        fmt::format("{:<22}of {} pixels that see a specular surface: came out {:.2f}%",
                    "eye's rays", rays.pixels, 100.0 * rays.shareOf(rays.cameOut));
    for (const auto& [count, name] : {std::pair(rays.lost, "lost"),
                                      {rays.reflectionLimit, "reflection_limit"},
                                      {rays.nestingLimit, "nesting_limit"},
                                      {rays.endedInside, "ended_inside"},
                                      {rays.mirrorLimit, "mirror_limit"}}) {
        if (count > 0) line += fmt::format(", {} {:.2f}%", name, 100.0 * rays.shareOf(count));
    }
    return line + "\n";
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
            "{:<24}RMSE {} {} (the reference's own {:.2g}), relMSE {}, SMAPE {}, SSIM {}, FLIP "
            "{}, energy ratio {}\n",
            name, value("rmse"), unit, noise, value("rel_mse"), value("smape"), value("ssim"),
            value("flip_ldr"), value("energy_ratio"));
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
    table += fmt::format("{:<24}{:>10.3f}{:>9.3f}   {}, bookkeeping {:.3f} ms\n", "frame", frame,
                         summarize(frameSamples(record)).standardDeviation,
                         record.timing.isOfMeasuredFrame
                             ? "with the measurement in it"
                             : fmt::format("median of {}", record.frames.size()),
                         summarize(bookkeepingSamples(record)).median);
    // Less is what a system does by itself.
    if (record.timing.otherProcessors.value_or(0.0) > 0.1) {
        table += fmt::format("{:<24}{:>10.1f}   processors were busy with other work\n",
                             "meanwhile", *record.timing.otherProcessors);
    }
    for (const graph::PassRecord& pass : record.passes) {
        if (pass.state == graph::PassState::ran) continue;
        const char* state = pass.state == graph::PassState::bypassed ? "bypassed" : "skipped";
        table += fmt::format("{:<24}{:>10}   {}\n", pass.name, state, pass.reason);
    }
    if (!record.cells.is_null()) {
        const auto count = [&](const char* key) { return record.cells[key].get<unsigned>(); };
        table += fmt::format(
            "cells                 {} photons, {} of them for several cells, of {} probes; level "
            "{}, {} rounds, {} batches\n",
            count("photons"), count("merged"), count("probes"), count("deepest_level"),
            count("rounds"), count("batches"));
        if (record.cells.contains("squares")) {
            table += "squares looked at    ";
            // From the top of the mip map down.
            const auto& squares = record.cells["squares"];
            for (std::size_t level = squares.size(); level-- > 0;)
                table += fmt::format(" {}", squares[level].get<unsigned>());
            table += "\n";
        }
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
        const double deposited = ledger.watts[kAccountDeposited];
        const PrimitiveFlux& primitives = record.primitives;
        if (deposited > 0.0 && primitives.trianglesWatts + primitives.beamsWatts > 0.0) {
            table += fmt::format(
                "spread by             triangles {:.2f}%, beams of cells that are not joined "
                "{:.2f}% of what was deposited\n",
                100.0 * primitives.trianglesWatts / deposited,
                100.0 * primitives.beamsWatts / deposited);
        }
    }
    if (record.cost) table += costTable(*record.cost, medianByPass(record));
    if (record.eyeRays) table += eyeRaysLine(*record.eyeRays);
    table += referenceTable(record);
    return table;
}

}  // namespace kaustik::report
