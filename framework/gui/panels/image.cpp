// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "framework/gui/number_fields.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/resource_words.h"
#include "framework/gui/showing.h"
#include "framework/gui/widgets.h"
#include "framework/transport/watts.h"

namespace kaustik::gui {
namespace {

// What may stand to the right of the split.
struct ComparedChoice {
    ComparedImage image = ComparedImage::none;
    int kept = -1;
    std::string name;
};

std::vector<ComparedChoice> comparedChoices(const Bench& bench) {
    std::vector<ComparedChoice> choices = {
        {ComparedImage::none, -1, "nothing"},
        {ComparedImage::other, -1, "variant B"},
        {ComparedImage::reference, -1, "the reference"},
        {ComparedImage::error, -1, "its error by the reference"}};
    if (bench.document.other) choices.push_back({ComparedImage::difference, -1, "A minus B"});
    for (int i = 0; i < static_cast<int>(bench.kept.size()); ++i) {
        choices.push_back({ComparedImage::kept, i, fmt::format("kept {}", i + 1)});
        choices.push_back({ComparedImage::difference, i, fmt::format("it minus kept {}", i + 1)});
    }
    return choices;
}

void drawChoiceOfCompared(Bench& bench) {
    const std::vector<ComparedChoice> choices = comparedChoices(bench);
    std::vector<std::string> names;
    int index = 0;
    for (const ComparedChoice& choice : choices) {
        const bool isKept =
            choice.image == ComparedImage::kept || choice.image == ComparedImage::difference;
        if (choice.image == bench.view.comparedWith &&
            (!isKept || choice.kept == bench.view.comparedKept)) {
            index = static_cast<int>(names.size());
        }
        names.push_back(choice.name);
    }
    if (choose(bench, "compared with", names, index, "image.compared_with")) {
        bench.view.comparedWith = choices[static_cast<std::size_t>(index)].image;
        bench.view.comparedKept = choices[static_cast<std::size_t>(index)].kept;
    }
    tooltip(
        "What is seen to the right of the split, which can be dragged. The reference is of the "
        "caustic irradiance, and stands next to that. Unlike images do not share a split.");
    if (button(bench, "Save it as EXR and PNG", "image.save")) bench.wantsShownSaved = true;
    tooltip(
        "Its values, and its colours as they are seen, with what it is in the files' metadata, "
        "into the folder of the panel Record.");
}

void drawChoiceOfTexture(Bench& bench) {
    const VariantResult& result = bench.editedResult();
    drawTextureList(bench);
    const ListedTexture* texture = findTexture(result, bench.view.resource);
    if (texture == nullptr) {
        if (bench.view.comparedWith == ComparedImage::reference)
            ImGui::TextDisabled("caustic.irradiance, of which the reference is.");
        return;
    }
    ImGui::TextDisabled("%s", sizeAndFormat(result, texture->name).c_str());
    ImGui::PushTextWrapPos(0.0f);
    const std::string writers = "written by " + writersText(result, texture->name);
    ImGui::TextDisabled("%s", writers.c_str());
    bench.map.control("image.writers", writers);
    ImGui::PopTextWrapPos();
    const TextureContent content = contentOf(bench.view.resource, texture->desc);
    ImGui::TextWrapped("%s", content.quantity.c_str());
    if (!result.viewed || result.viewed->name != bench.view.resource) return;
    const ViewedTexture& viewed = *result.viewed;
    if (viewed.layers > 1) {
        std::string name = fmt::format("%d of 0 to {}", viewed.layers - 1);
        const auto layer = static_cast<std::size_t>(bench.view.layer);
        if (layer < viewed.layerNames.size())
            name = fmt::format("%d: {}", viewed.layerNames[layer]);
        if (ImGui::SliderInt("layer", &bench.view.layer, 0, viewed.layers - 1, name.c_str()))
            keepWithin(bench, "layer", bench.view.layer, 0, viewed.layers - 1);
        bench.map.control("image.layer", fmt::format("{}", bench.view.layer));
    }
}

constexpr float kLargestEnd = 1e30f;

// Where a scale cannot have the ends that were typed.
void drawEffectiveRange(Bench& bench, const ShownImage& image, const Look& look) {
    const ToneMapping used =
        mappingOf(look, image.content, image.histogram, image.mapping.isEncoded);
    if (used.low == look.low && used.high == look.high) return;
    const char* why = look.scale == Scale::symmetric ? "as far to both sides of 0 as the upper end"
                      : look.low >= look.high        ? "the lower end is not below the upper one"
                                                     : "a logarithm has no 0 and nothing below";
    const std::string text =
        fmt::format("The colours go from {:.4g} to {:.4g}: {}.", used.low, used.high, why);
    ImGui::TextWrapped("%s", text.c_str());
    bench.map.control("image.range.used", text);
}

void drawRange(Bench& bench, const ShownImage& image, Look& look) {
    static const std::vector<std::string> kScales = {"linear", "logarithmic", "symmetric about 0"};
    int scale = static_cast<int>(look.scale);
    if (choose(bench, "scale", kScales, scale, "image.scale"))
        look.scale = static_cast<Scale>(scale);
    if (checkbox(bench, "range from the image", look.isRangeAutomatic, "image.range_automatic") &&
        !look.isRangeAutomatic) {
        look.low = image.mapping.low;
        look.high = image.mapping.high;
    }
    if (look.isRangeAutomatic) {
        ImGui::TextDisabled("%.4g to %.4g", double(image.mapping.low), double(image.mapping.high));
        return;
    }
    const float span = std::max(std::abs(look.high - look.low), 1e-30f);
    const float between = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = 0.5f * (ImGui::CalcItemWidth() - between);
    ImGui::SetNextItemWidth(width);
    ImGui::DragFloat("##low", &look.low, span * 0.005f, 0.0f, 0.0f, "%.4g");
    bench.map.control("image.range.low", fmt::format("{}", look.low));
    ImGui::SameLine(0.0f, between);
    ImGui::SetNextItemWidth(width);
    ImGui::DragFloat("range", &look.high, span * 0.005f, 0.0f, 0.0f, "%.4g");
    bench.map.control("image.range.high", fmt::format("{}", look.high));
    if (!ImGui::IsAnyItemActive()) {
        keepWithin(bench, "range", look.low, -kLargestEnd, kLargestEnd);
        keepWithin(bench, "range", look.high, -kLargestEnd, kLargestEnd);
    }
    drawEffectiveRange(bench, image, look);
}

// How the image on the screen becomes colours: each has a look of its own.
void drawLook(Bench& bench, const ShownImage& image) {
    Look look = image.look;
    const std::vector<std::pair<Channel, std::string>> channels = image.channels();
    std::vector<std::string> names;
    int chosen = 0;
    for (const auto& [channel, name] : channels) {
        if (channel == look.channel) chosen = static_cast<int>(names.size());
        names.push_back(name);
    }
    if (choose(bench, "channel", names, chosen, "image.channel"))
        look.channel = channels[static_cast<std::size_t>(chosen)].first;
    static_cast<void>(checkbox(bench, "false colours (F)", look.isFalseColor, "image.false_color"));
    if (look.isFalseColor) {
        drawRange(bench, image, look);
    } else if (!image.mapping.isEncoded) {
        float stops = image.mapping.exposureStops;
        if (ImGui::SliderFloat("exposure (+ -)", &stops, -kMaxStops, kMaxStops, "%.1f stops")) {
            look.exposureStops = stops;
            look.isExposureAutomatic = false;
        }
        bench.map.control("image.exposure", fmt::format("{}", stops));
        if (!look.isExposureAutomatic && !ImGui::IsAnyItemActive())
            keepWithin(bench, "exposure", look.exposureStops, -kMaxStops, kMaxStops);
        // Irradiance is hundreds of W/m²: as it is, all of it is white.
        static_cast<void>(
            checkbox(bench, "expose for the image", look.isExposureAutomatic, "image.fit"));
        tooltip("So that 99 % of what is not 0 is told apart.");
        if (!look.isExposureAutomatic && image.look.isExposureAutomatic) look.exposureStops = stops;
    } else {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextDisabled("The picture is as it is written to beauty.png.");
        ImGui::PopTextWrapPos();
    }
    if (!(look == image.look)) bench.view.looks[image.resource] = look;
}

// How many values lie where, by a logarithm, and, under the mouse, where and how many.
void drawHistogram(Bench& bench, const ShownImage& image) {
    const Histogram& histogram = image.histogram;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, static_cast<float>(bench.px(70.0)));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y},
                       ImGui::GetColorU32(ImGuiCol_FrameBg));
    const std::uint32_t largest =
        *std::max_element(histogram.counts.begin(), histogram.counts.end());
    const float width = std::max(size.x, 1.0f) / static_cast<float>(Histogram::kBins);
    for (std::size_t i = 0; i < Histogram::kBins; ++i) {
        if (histogram.counts[i] == 0) continue;
        const float share = std::log2(1.0f + static_cast<float>(histogram.counts[i])) /
                            std::log2(1.0f + static_cast<float>(largest));
        const float x = corner.x + width * static_cast<float>(i);
        draw.AddRectFilled({x, corner.y + size.y * (1.0f - share)}, {x + width, corner.y + size.y},
                           ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    }
    ImGui::Dummy(size);
    const float place = (ImGui::GetIO().MousePos.x - corner.x) / width;
    const auto bin =
        static_cast<std::size_t>(std::clamp(place, 0.0f, static_cast<float>(Histogram::kBins - 1)));
    const float step = (histogram.end - histogram.low) / static_cast<float>(Histogram::kBins);
    const bool isLast = bin + 1 == Histogram::kBins;
    tooltip(fmt::format(
        "{} values from {:.4g} to {:.4g}. Bars are as high as the logarithm of such numbers; the "
        "last has all from {:.4g} on.",
        histogram.counts[bin], histogram.low + step * static_cast<float>(bin),
        isLast ? histogram.high : histogram.low + step * static_cast<float>(bin + 1),
        histogram.end - step));
    const std::string ends =
        fmt::format("least {:.5g}, greatest {:.5g}", histogram.low, histogram.high);
    ImGui::TextUnformatted(ends.c_str());
    bench.map.control("image.histogram", ends);
}

void drawValues(Bench& bench, const ViewedTexture& viewed) {
    // The picture's own values are colours, which are always finite.
    const std::string of = viewed.isEncoded ? fmt::format(" of '{}'", viewed.checked) : "";
    ImGui::PushTextWrapPos(0.0f);
    if (viewed.notFinite) {
        const measure::NotFinite& found = *viewed.notFinite;
        ImGui::TextColored(ImVec4(1.0f, 0.4f, 1.0f, 1.0f), "%s%s.", describe(found).c_str(),
                           of.c_str());
        bench.map.control("image.not_finite",
                          fmt::format("{}", found.nanCount + found.infinityCount));
    } else {
        ImGui::TextDisabled("All values%s are finite.", of.c_str());
        bench.map.control("image.not_finite", "0");
    }
    ImGui::PopTextWrapPos();
    const Showing showing = showingOf(bench.requested(), *bench.result, *bench.reference);
    for (const std::optional<ShownImage>* image : {&showing.main, &showing.compared}) {
        if (*image && (*image)->version == viewed.version) drawHistogram(bench, **image);
    }
}

void drawProbe(Bench& bench) {
    ViewState& view = bench.view;
    ImGui::Separator();
    static_cast<void>(checkbox(bench, "probe photons (P)", view.probes, "image.probe"));
    tooltip(
        "A click on the picture shows which photons landed there and the paths that they took.");
    if (bench.document.other) ImGui::TextDisabled("Photons are those of variant A.");
    if (!view.probes) return;
    ImGui::SliderFloat("radius", &view.probeRadius, 0.5f, 32.0f, "%.1f px",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    bench.map.control("image.probe_radius");
    const auto& probe = bench.result->probe;
    if (view.probePixel.x < 0) {
        ImGui::TextDisabled("Click on a pixel.");
    } else if (!probe || probe->pixel != view.probePixel) {
        ImGui::TextDisabled("Looking at pixel (%d, %d) …", view.probePixel.x, view.probePixel.y);
    } else {
        ImGui::TextWrapped("%zu photons landed within %.1f px of (%d, %d): %.4g W", probe->landed,
                           double(probe->radiusPixels), probe->pixel.x, probe->pixel.y,
                           transport::wattsOf(probe->fluxWatts));
        bench.map.control("image.probe_landed", fmt::format("{}", probe->landed));
        if (probe->overwritten > 0) {
            ImGui::TextWrapped(
                "Of the last batch alone: %zu photons of those before it are not looked at. More "
                "refine.memory makes fewer batches.",
                probe->overwritten);
        }
        if (ImGui::BeginTable("photons", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) {
            ImGui::TableSetupScrollFreeze(0, 1);
            for (const char* name : {"photon", "px off", "W", "points"})
                ImGui::TableSetupColumn(name);
            ImGui::TableHeadersRow();
            for (const PhotonPath& path : probe->paths) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::Text("%u of light %u", path.origin.cell, path.origin.light + 1);
                ImGui::TableNextColumn();
                ImGui::Text("%.2f", double(path.pixels));
                ImGui::TableNextColumn();
                ImGui::Text("%.3g", transport::wattsOf(path.fluxWatts));
                ImGui::TableNextColumn();
                ImGui::Text("%zu", path.points.size());
            }
            ImGui::EndTable();
        }
    }
}

}  // namespace

void drawImage(Bench& bench) {
    const VariantResult& result = bench.editedResult();
    const ViewedTexture* viewed = result.viewed ? &*result.viewed : nullptr;
    // Of a kept variant that is looked at, its own.
    std::shared_ptr<const ViewedTexture> kept;
    if (const KeptVariant* flipped = bench.requested().flipped()) {
        kept = flipped->texture(bench.view.resource);
        viewed = kept.get();
    }
    chooseVariant(bench, "image");
    ImGui::PushItemWidth(widthBeside("compared with"));
    drawChoiceOfTexture(bench);
    const Showing showing = showingOf(bench.requested(), *bench.result, *bench.reference);
    if (showing.main) drawLook(bench, *showing.main);
    drawChoiceOfCompared(bench);
    ImGui::Separator();
    if (viewed != nullptr && viewed->missing != ViewedTexture::Missing::layer)
        drawValues(bench, *viewed);
    drawProbe(bench);
    ImGui::PopItemWidth();
}

}  // namespace kaustik::gui
