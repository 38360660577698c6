// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

std::string errorOf(const KeptVariant& kept, const char* measure) {
    const nlohmann::json& errors = kept.judgement.whole;
    if (!errors.is_object() || !errors.contains("caustic_irradiance") ||
        !errors.at("caustic_irradiance").is_object()) {
        return "–";
    }
    const nlohmann::json value = errors.at("caustic_irradiance").value(measure, nlohmann::json());
    return value.is_number() ? fmt::format("{:.4g}", value.get<double>()) : "–";
}

void forget(Bench& bench, std::size_t index) {
    bench.kept.erase(bench.kept.begin() + static_cast<std::ptrdiff_t>(index));
    bench.pairs.reset();
    const int place = static_cast<int>(index);
    for (int* chosen : {&bench.view.flipped, &bench.view.comparedKept}) {
        if (*chosen == place) *chosen = -1;
        if (*chosen > place) --*chosen;
    }
    if (bench.view.comparedKept < 0 && (bench.view.comparedWith == ComparedImage::kept ||
                                        bench.view.comparedWith == ComparedImage::difference)) {
        bench.view.comparedWith = ComparedImage::none;
    }
}

Table tableOf(const std::vector<KeptVariant>& all) {
    Table table{{"key", "variant", "frame, ms", "RMSE, W/m²", "FLIP", "reference"}, {}};
    for (std::size_t i = 0; i < all.size(); ++i) {
        table.rows.push_back({fmt::format("{}", i + 1), all[i].name,
                              fmt::format("{:.4g}", all[i].frameMs), errorOf(all[i], "rmse"),
                              errorOf(all[i], "flip_ldr"), all[i].reference});
    }
    return table;
}

void drawKept(Bench& bench) {
    std::size_t forgotten = bench.kept.size();
    for (std::size_t i = 0; i < bench.kept.size(); ++i) {
        const KeptVariant& kept = bench.kept[i];
        const std::string name = fmt::format("compare.{}", i + 1);
        ImGui::PushID(static_cast<int>(i));
        ImGui::Separator();
        bool isSeen = bench.view.flipped == static_cast<int>(i);
        if (checkbox(bench, fmt::format("{}", i + 1).c_str(), isSeen, name))
            bench.view.flipped = isSeen ? static_cast<int>(i) : -1;
        tooltip(fmt::format("Seen in place of the newest frame; key {}.", i + 1));
        ImGui::SameLine();
        ImGui::TextWrapped("%s", kept.name.c_str());
        const std::string numbers = fmt::format("{:.4g} ms · RMSE {} W/m² · FLIP {}", kept.frameMs,
                                                errorOf(kept, "rmse"), errorOf(kept, "flip_ldr"));
        ImGui::TextDisabled("%s", numbers.c_str());
        bench.map.control(name + ".numbers", numbers);
        tooltip(kept.reference.empty() ? "There was no reference of its view when it was kept."
                                       : "By a reference of " + kept.reference + ".");
        if (button(bench, "next to it", name + ".compare")) {
            bench.view.comparedWith = ComparedImage::kept;
            bench.view.comparedKept = static_cast<int>(i);
        }
        ImGui::SameLine();
        if (button(bench, "minus it", name + ".difference")) {
            bench.view.comparedWith = ComparedImage::difference;
            bench.view.comparedKept = static_cast<int>(i);
        }
        ImGui::SameLine();
        if (button(bench, "settings", name + ".settings")) {
            bench.document.scene = kept.document.scene;
            bench.document.edits = kept.document.edits;
            bench.document.size = kept.document.size;
            bench.edited() = kept.document.variant;
            bench.view.flipped = -1;
        }
        tooltip("Takes its scene, camera and settings back, and renders them.");
        ImGui::SameLine();
        if (button(bench, "forget", name + ".forget")) forgotten = i;
        ImGui::PopID();
    }
    if (forgotten < bench.kept.size()) forget(bench, forgotten);
}

void drawPairs(Bench& bench) {
    if (bench.kept.empty()) return;
    ImGui::Separator();
    if (button(bench, "RMSE and FLIP of all pairs", "compare.pairs")) bench.wantsPairs = true;
    tooltip("Of the caustic irradiance, W/m²: A as it is now, what was kept, and the reference.");
    if (!bench.pairs) return;
    const Table& pairs = *bench.pairs;
    drawTableButtons(bench, "pairs", pairs);
    if (!ImGui::BeginTable("pairs", static_cast<int>(pairs.columns.size()),
                           ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        return;
    }
    for (const std::string& column : pairs.columns)
        ImGui::TableSetupColumn(column.c_str());
    ImGui::TableHeadersRow();
    for (const auto& row : pairs.rows) {
        ImGui::TableNextRow();
        for (const std::string& cell : row) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(cell.c_str());
        }
        bench.map.control(fmt::format("compare.pair.{}-{}", row[0], row[1]), row[2] + " " + row[3]);
    }
    ImGui::EndTable();
}

}  // namespace

void keepVariant(Bench& bench) {
    std::string problem;
    std::optional<KeptVariant> kept =
        keep(*bench.result, bench.requested().seen(), *bench.reference, problem);
    if (!kept) {
        bench.notify(problem, true, [](const Bench& now) {
            return now.result->variants[now.requested().seen()].isSettled;
        });
        return;
    }
    problem = whyNoRoom(bench.kept, *kept);
    if (!problem.empty()) {
        bench.notify(problem, true, [count = bench.kept.size()](const Bench& now) {
            return now.kept.size() < count;
        });
        return;
    }
    kept->number = ++bench.keptCount;
    bench.kept.push_back(std::move(*kept));
    bench.pairs.reset();
    const std::uint64_t number = bench.kept.back().number;
    const std::size_t place = bench.kept.size();
    bench.notify(fmt::format("Kept as {}: {}.", bench.kept.size(), bench.kept.back().name), false,
                 [number, place](const Bench& now) {
                     return now.kept.size() < place || now.kept[place - 1].number != number;
                 });
}

void drawCompare(Bench& bench) {
    if (button(bench, "Keep what is shown (K)", "compare.keep")) keepVariant(bench);
    std::size_t bytes = 0;
    for (const KeptVariant& kept : bench.kept)
        bytes += kept.bytes;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled(
        "%s", fmt::format("{} of {} kept, {:.1f} of {} MiB. They are gone when the "
                          "workbench ends.",
                          bench.kept.size(), kMaxKept, static_cast<double>(bytes) / (1 << 20),
                          kMaxKeptBytes >> 20u)
                  .c_str());
    ImGui::PopTextWrapPos();
    if (!bench.kept.empty()) drawTableButtons(bench, "kept", tableOf(bench.kept));
    drawKept(bench);
    drawPairs(bench);
}

}  // namespace kaustik::gui
