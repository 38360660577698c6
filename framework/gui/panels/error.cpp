// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/gui/number_fields.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/shown.h"
#include "framework/gui/widgets.h"
#include "framework/pipeline/account_sentences.h"

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
    constexpr const char* kLabel = "million photons";
    bool isChanged =
        ImGui::SliderFloat(kLabel, &millions, 1.0f, 10000.0f, "%.6g", ImGuiSliderFlags_Logarithmic);
    bench.map.control("error.photons", fmt::format("{:.6g}", millions));
    // Before it is done with, each sign that was typed is a number.
    if (!ImGui::IsAnyItemActive()) {
        const float before = millions;
        keepWithin(bench, kLabel, millions, 1.0f, 10000.0f);
        isChanged = isChanged || millions != before;
    }
    // A count of photons at any time, whatever is being typed.
    if (isChanged) bench.panels.referencePhotons = double(std::clamp(millions, 0.0f, 1e12f)) * 1e6;
    if (progress.isComputing || progress.isEnding) {
        ImGui::ProgressBar(static_cast<float>(progress.share), {-FLT_MIN, 0.0f}, "");
        bench.map.control("error.progress", fmt::format("{}", progress.share));
        ImGui::BeginDisabled(progress.isEnding);
        const char* label = progress.isEnding ? "Stopping …" : "Stop (what there is stays)";
        if (ImGui::Button(label)) bench.referenceWorker.stopComputing();
        bench.map.control("error.stop", progress.isEnding ? "stopping" : "");
        ImGui::EndDisabled();
        // Below the button, which does not move when there is more to say.
        ImGui::TextWrapped("%s", progress.reached.c_str());
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

// An output that is judged, as the report names it.
struct JudgedOutput {
    const char* key;
    const char* name;
    const char* unit;
};
constexpr std::array<JudgedOutput, 3> kOutputs = {
    JudgedOutput{"caustic_irradiance", "caustic irradiance", "W/m²"},
    JudgedOutput{"caustic_radiance", "caustic radiance to the eye", "W/m²/sr"},
    JudgedOutput{"in_scattered", "in-scattered radiance", "W/m²/sr"}};

struct Measure {
    const char* label;
    const char* key;
    bool hasUnit;
    const char* sentence;
};
constexpr std::array<Measure, 9> kMeasures = {
    Measure{"RMSE", "rmse", true,
            "Root of the mean square of all differences; far outliers count most."},
    Measure{"relMSE", "rel_mse", false,
            "Mean square of differences, by the reference's square; what is dim counts as much as "
            "what is bright."},
    Measure{"SMAPE", "smape", false, "Mean of differences by half of both values; 2 at most."},
    Measure{"MAE", "mae", true, "Mean of the absolute differences."},
    Measure{"SSIM", "ssim", false, "Likeness of structure; 1 where both are the same."},
    Measure{"FLIP", "flip_ldr", false,
            "How different both look side by side, tone-mapped; 0 where they look the same."},
    Measure{"HDR-FLIP", "flip_hdr", false, "The same over all exposures."},
    Measure{"energy ratio", "energy_ratio", false,
            "Flux of the frame by that of the reference; 1 where none is lost."},
    Measure{"encircled energy", "encircled_energy_radius_ratio", false,
            "Radius that holds most of the light, by that of the reference; above 1 where it is "
            "blurred."}};

void drawTable(Bench& bench, const char* title, json ReferenceState::Judgement::*part) {
    const auto& judgements = bench.reference->judgements;
    const std::size_t variants = bench.document.other ? 2 : 1;
    if (judgements[0].order == 0 || !(judgements[0].*part).is_object()) return;
    if (!ImGui::BeginTable(title, static_cast<int>(1 + variants), ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthStretch, 2.0f);
    ImGui::TableSetupColumn(variants > 1 ? "A" : "", ImGuiTableColumnFlags_WidthStretch, 1.0f);
    if (variants > 1) ImGui::TableSetupColumn("B", ImGuiTableColumnFlags_WidthStretch, 1.0f);
    ImGui::TableHeadersRow();
    const std::string prefix =
        part == &ReferenceState::Judgement::whole ? "error." : "error.modelled.";
    for (const JudgedOutput& output : kOutputs) {
        const auto isJudged = [&](std::size_t i) {
            const json& errors = judgements[i].*part;
            return errors.is_object() && errors.contains(output.key);
        };
        if (!isJudged(0) && !(variants > 1 && isJudged(1))) continue;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored({0.6f, 0.75f, 1.0f, 1.0f}, "%s", output.name);
        const bool isFirst = &output == &kOutputs.front();
        for (const Measure& measure : kMeasures) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(measure.hasUnit
                                       ? fmt::format("{}, {}", measure.label, output.unit).c_str()
                                       : measure.label);
            tooltip(measure.sentence);
            for (std::size_t i = 0; i < variants; ++i) {
                ImGui::TableNextColumn();
                const std::string value = numberAt(judgements[i].*part, output.key, measure.key);
                ImGui::TextUnformatted(value.c_str());
                tooltip(measure.sentence);
                bench.map.control(
                    fmt::format("{}{}{}{}", prefix, isFirst ? "" : std::string(output.key) + ".",
                                measure.key, i == 0 ? "" : ".b"),
                    value);
            }
        }
    }
    ImGui::EndTable();
}

// Which frame the errors are of, in a colour that cannot be overlooked where it is not this one.
// `canRun`: else there is no newer one to come.
void drawJudgedFrame(Bench& bench, bool canRun) {
    const ReferenceState& reference = *bench.reference;
    const bool isOld = reference.judgements[0].order != bench.result->order;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(isOld ? kProblemColor : ImVec4(0.45f, 0.75f, 0.45f, 1.0f), "%s",
                       !isOld   ? "Errors of this frame."
                       : canRun ? "Errors of a frame before this one; this one is being measured."
                                : "Errors of a frame before; what is set up now cannot run.");
    bench.map.control("error.frame", isOld ? "old" : "new");
    const bool isKnown = std::isfinite(reference.relativeError);
    ImGui::TextUnformatted(
        isKnown ? fmt::format("The reference's own noise: {:.2g} % of a lit pixel. What is smaller "
                              "than that is not told.",
                              100.0 * reference.relativeError)
                      .c_str()
                : "The reference's own noise is unknown.");
    bench.map.control("error.reference_noise",
                      isKnown ? fmt::format("{:.4g}", 100.0 * reference.relativeError) : "");
    ImGui::PopTextWrapPos();
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
    drawTableButtons(bench, "energy", ledgerTable(ledger));
    if (ImGui::BeginTable("ledger", 3, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("energy", ImGuiTableColumnFlags_WidthStretch, 2.0f);
        ImGui::TableSetupColumn("W", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableSetupColumn("%", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableHeadersRow();
        const auto row = [&](const std::string& name, unsigned account) {
            const double watts = ledger.watts[account];
            ImGui::TableNextRow();
            const auto cell = [&](const std::string& text) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(text.c_str());
                tooltip(accountSentence(account));
            };
            cell(name);
            bench.map.control("error.account." + name, accountSentence(account));
            cell(fmt::format("{:.5g}", watts));
            cell(fmt::format("{:.2f}", emitted > 0.0 ? 100.0 * watts / emitted : 0.0));
        };
        row("emitted", kAccountEmitted);
        row("deposited", kAccountDeposited);
        row("absorbed", kAccountAbsorbed);
        row("left the scene", kAccountLeftScene);
        for (const auto& [account, name] : lossCauses()) {
            if (ledger.events[account] > 0) row("lost: " + name, account);
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
        const bool canRun = runObstacle(bench.requested(), *bench.result).empty();
        if (reference.judgements[0].order == 0) {
            const char* text = canRun ? "Measuring the frame …"
                                      : "What is set up cannot run: there is no frame to measure.";
            ImGui::TextDisabled("%s", text);
            bench.map.control("error.unjudged", text);
        } else {
            drawJudgedFrame(bench, canRun);
            drawTableButtons(bench, "errors", errorTable(reference, bench.document.other ? 2 : 1));
            drawTable(bench, "by all paths", &ReferenceState::Judgement::whole);
            drawTable(bench, "by modelled paths", &ReferenceState::Judgement::modelled);
            bool isShown = bench.view.comparedWith == ComparedImage::error;
            if (checkbox(bench, "error next to the picture", isShown, "error.heat_map"))
                bench.view.comparedWith = isShown ? ComparedImage::error : ComparedImage::none;
        }
    }
    drawLedger(bench);
}

}  // namespace kaustik::gui
