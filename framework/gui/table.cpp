// SPDX-License-Identifier: MIT
#include "framework/gui/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/report/statistics.h"

namespace kaustik::gui {
namespace {

const char* nameOf(graph::PassState state) {
    switch (state) {
        case graph::PassState::ran:
            return "ran";
        case graph::PassState::bypassed:
            return "bypassed";
        case graph::PassState::culled:
            return "culled";
        case graph::PassState::skipped:
            break;
    }
    return "skipped";
}

// Characters, of UTF-8.
std::size_t lengthOf(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
    }));
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string all = "\"";
    for (const char c : text) {
        if (c == '"') all += '"';
        all += c;
    }
    return all + "\"";
}

}  // namespace

std::string toText(const Table& table) {
    std::vector<std::size_t> widths;
    const auto widen = [&](const std::vector<std::string>& row) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], lengthOf(row[i]));
    };
    widen(table.columns);
    for (const auto& row : table.rows)
        widen(row);
    std::string text;
    const auto write = [&](const std::vector<std::string>& row) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += row[i] + std::string(widths[i] - lengthOf(row[i]) + 2, ' ');
        while (!line.empty() && line.back() == ' ')
            line.pop_back();
        text += line + "\n";
    };
    write(table.columns);
    for (const auto& row : table.rows)
        write(row);
    return text;
}

std::string toCsv(const Table& table) {
    std::string text;
    const auto write = [&](const std::vector<std::string>& row) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i > 0) text += ',';
            text += quoted(row[i]);
        }
        text += "\r\n";
    };
    write(table.columns);
    for (const auto& row : table.rows)
        write(row);
    return text;
}

Table passTable(const VariantResult& result) {
    Table table{{"pass", "state", "median, ms", "newest, ms", "repeats", "reason"}, {}};
    for (const graph::PassRecord& pass : result.passes) {
        const auto times = std::find_if(
            result.times.begin(), result.times.end(),
            [&](const report::PassTimes& candidate) { return candidate.name == pass.name; });
        std::vector<std::string> row = {pass.name, nameOf(pass.state), "", ""};
        if (times != result.times.end() && !times->gpuMilliseconds.empty()) {
            std::vector<double> all = times->gpuMilliseconds;
            row[3] = fmt::format("{:.4f}", all.back());
            if (all.size() > 1) all.erase(all.begin());
            row[2] = fmt::format("{:.4f}", report::summarize(std::move(all)).median);
        }
        row.push_back(fmt::format("{}", pass.repeats));
        row.push_back(pass.reason);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table errorTable(const ReferenceState& reference, std::size_t variants) {
    Table table{{"output", "paths", "measure", "A"}, {}};
    if (variants > 1) table.columns.emplace_back("B");
    static constexpr std::array<const char*, 9> kMeasures = {
        "rmse",     "rel_mse",      "smape",
        "mae",      "ssim",         "flip_ldr",
        "flip_hdr", "energy_ratio", "encircled_energy_radius_ratio"};
    using Part = nlohmann::json ReferenceState::Judgement::*;
    const auto add = [&](Part part, const char* paths) {
        const nlohmann::json& first = reference.judgements[0].*part;
        if (!first.is_object()) return;
        for (const char* output : {"caustic_irradiance", "caustic_radiance", "in_scattered"}) {
            if (!first.contains(output) || !first.at(output).is_object()) continue;
            for (const char* measure : kMeasures) {
                std::vector<std::string> row = {output, paths, measure};
                for (std::size_t i = 0; i < variants; ++i) {
                    const nlohmann::json& errors = reference.judgements[i].*part;
                    const nlohmann::json value =
                        errors.is_object() && errors.contains(output) &&
                                errors.at(output).is_object()
                            ? errors.at(output).value(measure, nlohmann::json())
                            : nlohmann::json();
                    row.push_back(value.is_number() ? fmt::format("{:.6g}", value.get<double>())
                                                    : "");
                }
                table.rows.push_back(std::move(row));
            }
        }
    };
    add(&ReferenceState::Judgement::whole, "all");
    add(&ReferenceState::Judgement::modelled, "modelled");
    return table;
}

Table ledgerTable(const EnergyLedger& ledger) {
    using namespace transport;
    Table table{{"energy", "W", "share of emitted"}, {}};
    const double emitted = ledger.watts[kAccountEmitted];
    const auto add = [&](const std::string& name, double watts) {
        table.rows.push_back({name, fmt::format("{:.8g}", watts),
                              emitted > 0.0 ? fmt::format("{:.6f}", watts / emitted) : ""});
    };
    add("emitted", emitted);
    add("deposited", ledger.watts[kAccountDeposited]);
    add("absorbed", ledger.watts[kAccountAbsorbed]);
    add("left the scene", ledger.watts[kAccountLeftScene]);
    for (const auto& [account, name] : lossCauses()) {
        if (ledger.events[account] > 0) add("lost: " + name, ledger.watts[account]);
    }
    return table;
}

}  // namespace kaustik::gui
