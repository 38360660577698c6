// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

using nlohmann::json;

std::string numberAt(const json& errors, const char* output, const char* key) {
    if (!errors.is_object()) return "–";
    const auto found = errors.find(output);
    if (found == errors.end() || !found->is_object()) return "–";
    const auto value = found->find(key);
    return value != found->end() && value->is_number() ? fmt::format("{:.4g}", value->get<double>())
                                                       : "–";
}

void drawReference(Bench& bench) {
    const ReferenceState& reference = *bench.reference;
    ImGui::PushTextWrapPos(0.0f);
    if (!reference.problem.empty())
        ImGui::TextColored(kProblemColor, "%s", reference.problem.c_str());
    bench.map.area("error.problem", 0, 0, 0, 0, reference.problem);
    const ReferenceWorker::Progress& progress = bench.referenceProgress;
    const bool isOfThisView = hasSameView(reference, bench.document);
    if (reference.isLooking) {
        ImGui::TextDisabled("Looking for a reference …");
    } else if (!isOfThisView) {
        ImGui::TextDisabled("A reference is looked for once this view is rendered.");
    } else if (reference.photons > 0) {
        ImGui::Text("Reference of %.1f million photons; standard error of a lit pixel %s.",
                    static_cast<double>(reference.photons) * 1e-6,
                    std::isfinite(reference.relativeError)
                        ? fmt::format("{:.2f} %", 100.0 * reference.relativeError).c_str()
                        : "unknown");
    } else {
        ImGui::TextUnformatted("There is no reference of this view yet.");
    }
    ImGui::PopTextWrapPos();
    bench.map.area("error.reference", 0, 0, 0, 0, fmt::format("{}", reference.photons));

    auto millions = static_cast<float>(bench.panels.referencePhotons * 1e-6);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
    if (ImGui::SliderFloat("million photons", &millions, 1.0f, 10000.0f, "%.3g",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
        bench.panels.referencePhotons = double(millions) * 1e6;
    }
    bench.map.control("error.photons");
    if (progress.isComputing || progress.isEnding) {
        ImGui::ProgressBar(static_cast<float>(progress.share), {-FLT_MIN, 0.0f},
                           progress.reached.c_str());
        bench.map.control("error.progress", fmt::format("{}", progress.share));
        ImGui::BeginDisabled(progress.isEnding);
        const char* label = progress.isEnding ? "Stopping …" : "Stop (what there is stays)";
        if (ImGui::Button(label)) bench.referenceWorker.stopComputing();
        bench.map.control("error.stop", progress.isEnding ? "stopping" : "");
        ImGui::EndDisabled();
    } else if (isOfThisView) {
        const bool isEnough =
            static_cast<double>(reference.photons) >= bench.panels.referencePhotons;
        ImGui::BeginDisabled(isEnough);
        if (button(bench, reference.photons > 0 ? "Go on computing" : "Compute in the background",
                   "error.compute")) {
            bench.referenceWorker.compute(
                static_cast<std::uint64_t>(bench.panels.referencePhotons));
        }
        ImGui::EndDisabled();
        tooltip(
            "Light tracing with Embree at low priority. It is kept, also for kaustik run "
            "--reference auto, and goes on where it was left.");
    }
}

void drawTable(Bench& bench, const char* title, json ReferenceState::Judgement::*part) {
    struct Row {
        const char* label;
        const char* key;
    };
    static constexpr std::array<Row, 9> kRows = {
        Row{"RMSE, W/m²", "rmse"},
        Row{"relMSE", "rel_mse"},
        Row{"SMAPE", "smape"},
        Row{"MAE, W/m²", "mae"},
        Row{"SSIM", "ssim"},
        Row{"FLIP", "flip_ldr"},
        Row{"HDR-FLIP", "flip_hdr"},
        Row{"energy ratio", "energy_ratio"},
        Row{"encircled energy", "encircled_energy_radius_ratio"}};
    const auto& judgements = bench.reference->judgements;
    const bool hasOther = bench.document.other.has_value();
    if (judgements[0].order == 0 || !(judgements[0].*part).is_object()) return;
    if (!ImGui::BeginTable(title, hasOther ? 3 : 2, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn(title);
    ImGui::TableSetupColumn(hasOther ? "A" : "");
    if (hasOther) ImGui::TableSetupColumn("B");
    ImGui::TableHeadersRow();
    const std::string prefix =
        part == &ReferenceState::Judgement::whole ? "error." : "error.modelled.";
    for (const Row& row : kRows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.label);
        for (std::size_t i = 0; i < (hasOther ? 2 : 1); ++i) {
            ImGui::TableNextColumn();
            const std::string value = numberAt(judgements[i].*part, "caustic_irradiance", row.key);
            ImGui::TextUnformatted(value.c_str());
            bench.map.control(fmt::format("{}{}{}", prefix, row.key, i == 0 ? "" : ".b"), value);
        }
    }
    ImGui::EndTable();
}

void drawLedger(Bench& bench) {
    const VariantResult& result = bench.editedResult();
    ImGui::Separator();
    chooseVariant(bench, "error");
    if (!result.ledger) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextDisabled("The energy ledger follows once the frames have settled.");
        ImGui::PopTextWrapPos();
        return;
    }
    using namespace transport;
    const EnergyLedger& ledger = *result.ledger;
    const double emitted = ledger.watts[kAccountEmitted];
    if (ImGui::BeginTable("ledger", 3, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("energy", ImGuiTableColumnFlags_WidthStretch, 2.0f);
        ImGui::TableSetupColumn("W", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableSetupColumn("%", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableHeadersRow();
        const auto row = [&](const std::string& name, double watts) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.5g", watts);
            ImGui::TableNextColumn();
            ImGui::Text("%.2f", emitted > 0.0 ? 100.0 * watts / emitted : 0.0);
        };
        row("emitted", emitted);
        row("deposited", ledger.watts[kAccountDeposited]);
        row("absorbed", ledger.watts[kAccountAbsorbed]);
        row("left the scene", ledger.watts[kAccountLeftScene]);
        for (const auto& [account, name] : lossCauses()) {
            if (ledger.events[account] > 0) row("lost: " + name, ledger.watts[account]);
        }
        ImGui::EndTable();
    }
    bench.map.area("error.balance", 0, 0, 0, 0, fmt::format("{:.3g}", ledger.balance()));
    for (const std::string& violation : result.violations) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(kProblemColor, "%s", violation.c_str());
        ImGui::PopTextWrapPos();
    }
    for (const ReachedLimit& limit : result.limits) {
        ImGui::TextWrapped("Limit reached: %s = %g; %s.", limit.parameter.c_str(), limit.value,
                           limit.sentence.c_str());
    }
    for (const std::string& warning : result.warnings)
        ImGui::TextWrapped("%s", warning.c_str());
}

}  // namespace

void drawError(Bench& bench) {
    drawReference(bench);
    const ReferenceState& reference = *bench.reference;
    if (reference.photons > 0) {
        if (reference.judgements[0].order == 0) {
            ImGui::TextDisabled("Measuring the frame …");
        } else {
            const bool isOld = reference.judgements[0].order != bench.result->order;
            ImGui::TextDisabled(isOld ? "Of a frame before this one." : "Of this frame.");
            bench.map.control("error.frame", isOld ? "old" : "new");
            drawTable(bench, "caustic, all paths", &ReferenceState::Judgement::whole);
            drawTable(bench, "modelled paths", &ReferenceState::Judgement::modelled);
            bool isShown = bench.view.sidePicture == SidePicture::error;
            if (checkbox(bench, "heat map beside the picture", isShown, "error.heat_map"))
                bench.view.sidePicture = isShown ? SidePicture::error : SidePicture::none;
        }
    }
    drawLedger(bench);
}

}  // namespace kaustik::gui
