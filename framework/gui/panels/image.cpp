// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

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
        ImGui::SliderInt("layer", &bench.view.layer, 0, viewed.layers - 1, name.c_str(),
                         ImGuiSliderFlags_AlwaysClamp);
        bench.map.control("image.layer", fmt::format("{}", bench.view.layer));
    }
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
    ImGui::DragFloatRange2("range", &look.low, &look.high, span * 0.005f, -1e30f, 1e30f, "%.4g",
                           "%.4g", ImGuiSliderFlags_AlwaysClamp);
    bench.map.control("image.range");
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
        if (ImGui::SliderFloat("exposure (+ -)", &stops, -kMaxStops, kMaxStops, "%.1f stops",
                               ImGuiSliderFlags_AlwaysClamp)) {
            look.exposureStops = stops;
            look.isExposureAutomatic = false;
        }
        bench.map.control("image.exposure", fmt::format("{}", stops));
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
    const Histogram& histogram = showing.main ? showing.main->histogram : viewed.histogram;
    std::vector<float> counts;
    for (const std::uint32_t count : histogram.counts)
        counts.push_back(std::log2(1.0f + static_cast<float>(count)));
    ImGui::PlotHistogram("##histogram", counts.data(), static_cast<int>(counts.size()), 0, nullptr,
                         0.0f, FLT_MAX,
                         {ImGui::GetContentRegionAvail().x, static_cast<float>(bench.px(70.0))});
    bench.map.control("image.histogram");
    tooltip(
        fmt::format("How many values (logarithm) lie where, from {:.5g} to {:.5g}; the last bar "
                    "has all above, up to {:.5g}.",
                    histogram.low, histogram.end, histogram.high));
    ImGui::Text("least %.5g, greatest %.5g", double(histogram.low), double(histogram.high));
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
