// SPDX-License-Identifier: MIT
// One pass closely: what it reads and writes, with small pictures of the textures, and the
// parameters of its node and stage.
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/parameter_row.h"
#include "framework/gui/panels/resource_words.h"
#include "framework/gui/pass_graph.h"
#include "framework/gui/shown_image.h"
#include "framework/gui/widgets.h"
#include "framework/pipeline/effect.h"

namespace kaustik::gui {
namespace {

constexpr double kThumbnailWidth = 64.0;  // at scale 1
constexpr double kThumbnailHeight = 48.0;

const ViewedTexture* thumbnailOf(const VariantResult& result, const std::string& pass,
                                 const std::string& resource, std::size_t& index) {
    if (result.thumbnailsOf != pass) return nullptr;
    for (index = 0; index < std::min(result.thumbnails.size(), Canvas::kThumbnails); ++index) {
        if (result.thumbnails[index]->name == resource) return result.thumbnails[index].get();
    }
    return nullptr;
}

// The texture's first layer as it would be seen on the canvas, in its own proportions.
void drawThumbnail(Bench& bench, const VariantResult& result, const std::string& pass,
                   const std::string& resource, ImVec2 corner, ImVec2 size) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(16, 16, 20, 255));
    std::size_t index = 0;
    const ViewedTexture* viewed = thumbnailOf(result, pass, resource, index);
    if (viewed == nullptr || viewed->values.width < 1 || viewed->values.height < 1) return;
    const Look look = bench.view.lookOf(resource);
    const Histogram& histogram =
        histogramFor(*viewed->histograms, viewed->values, viewed->content, look);
    bench.canvas.show(Canvas::kSides + index, viewed->values, viewed->version,
                      mappingOf(look, viewed->content, histogram, viewed->isEncoded));
    const auto width = static_cast<float>(viewed->values.width);
    const auto height = static_cast<float>(viewed->values.height);
    const float scale = std::min(size.x / width, size.y / height);
    const ImVec2 low(corner.x + 0.5f * (size.x - scale * width),
                     corner.y + 0.5f * (size.y - scale * height));
    draw.AddImage(bench.canvas.texture(Canvas::kSides + index, scale), low,
                  {low.x + scale * width, low.y + scale * height});
}

// A texture or a buffer: what it is, and who is at its other end.
void drawResource(Bench& bench, const VariantResult& result, const graph::PassRecord& pass,
                  const std::string& resource, bool isRead) {
    const bool isTexture = findTexture(result, resource) != nullptr;
    ImGui::PushID((resource + (isRead ? " read" : " written")).c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 picture(static_cast<float>(bench.px(kThumbnailWidth)),
                         static_cast<float>(bench.px(kThumbnailHeight)));
    const float height = isTexture ? picture.y : 2.0f * line;
    const float width = std::max(ImGui::GetContentRegionAvail().x, 40.0f);
    if (ImGui::InvisibleButton("resource", {width, height}) && isTexture)
        openTexture(bench, resource);
    const bool isHovered = ImGui::IsItemHovered() && isTexture;
    std::size_t index = 0;
    const bool hasPicture = thumbnailOf(result, pass.name, resource, index) != nullptr;
    bench.map.control(fmt::format("pass.{}.{}", isRead ? "reads" : "writes", resource),
                      hasPicture  ? "thumbnail"
                      : isTexture ? "texture"
                                  : "buffer");
    const std::string units = unitsOf(result, resource);
    const std::string size = sizeAndFormat(result, resource);
    const std::string other = isRead ? fmt::format("by {}", writersText(result, resource)) : [&] {
        const std::vector<std::string> readers = readersOf(result.passes, resource);
        return readers.empty() ? std::string("read by no pass")
                               : fmt::format("for {}", fmt::join(readers, ", "));
    }();
    std::string explanation = resource;
    if (isTexture) {
        explanation += fmt::format(
            "\n{}\nA click shows it on the canvas. The small picture is of its first layer at the "
            "end of the frame{}",
            contentOf(resource, findTexture(result, resource)->desc).quantity,
            hasPicture ? "." : ", once the frame has settled, where there is room to keep it.");
    }
    tooltip(fmt::format("{}\n{}", explanation, other));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (isHovered) {
        draw.AddRectFilled(corner, {corner.x + width, corner.y + height},
                           ImGui::GetColorU32(ImGuiCol_HeaderHovered));
    }
    const ImU32 quiet = ImGui::GetColorU32(isHovered ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    float x = corner.x;
    if (isTexture) {
        drawThumbnail(bench, result, pass.name, resource, corner, picture);
        x += picture.x + static_cast<float>(bench.px(6.0));
    }
    draw.PushClipRect({x, corner.y}, {corner.x + width, corner.y + height}, true);
    draw.AddText({x, corner.y}, ImGui::GetColorU32(ImGuiCol_Text), resource.c_str());
    draw.AddText({x, corner.y + line}, quiet, (size + (units.empty() ? "" : ", " + units)).c_str());
    if (isTexture) {
        draw.AddText({x, corner.y + 2.0f * line}, quiet, other.c_str());
    }
    draw.PopClipRect();
    ImGui::PopID();
}

void drawResources(Bench& bench, const VariantResult& result, const graph::PassRecord& pass,
                   bool isRead) {
    const std::vector<std::string>& names = isRead ? pass.reads : pass.writes;
    const char* word = isRead ? "reads" : "writes";
    ImGui::Spacing();
    if (names.empty()) {
        ImGui::TextDisabled("%s nothing", word);
        return;
    }
    ImGui::TextColored({0.6f, 0.75f, 1.0f, 1.0f}, "%s", word);
    for (const std::string& name : names)
        drawResource(bench, result, pass, name, isRead);
}

// Whether the parameter is one of the pass's node, or one that its whole stage shares.
bool belongsTo(const std::string& parameter, const std::string& pass) {
    const ParameterName name = splitParameterName(parameter);
    if (name.parameter.empty()) return false;
    if (name.node.empty()) return name.stage == stageOf(pass);
    const std::string node = name.stage + "." + name.node;
    return pass == node || pass.starts_with(node + ".") || pass.ends_with("." + node);
}

void drawItsParameters(Bench& bench, const std::string& pass) {
    try {
        const std::shared_ptr<const VariantParameters> all = bench.editedParameters();
        bool isTable = false;
        for (const params::NamedField& named : all->fields) {
            if (!belongsTo(named.fullName, pass)) continue;
            if (!isTable) {
                ImGui::Spacing();
                ImGui::TextColored({0.6f, 0.75f, 1.0f, 1.0f}, "parameters");
                isTable = beginParameterTable("of the pass");
                if (!isTable) return;
            }
            drawParameterRow(bench, *all, named);
        }
        if (isTable) ImGui::EndTable();
    } catch (const Error& error) {
        ImGui::TextWrapped("%s", error.what());
    }
}

}  // namespace

void drawPassDetail(Bench& bench, const graph::PassRecord& pass) {
    const VariantResult& result = bench.editedResult();
    if (ImGui::SmallButton("×")) bench.view.pass.clear();
    bench.map.control("pass.close", pass.name);
    tooltip("Back to the whole table.");
    ImGui::SameLine();
    ImGui::TextColored(stageColor(bench.registry, stageOf(pass.name)), "%s", pass.name.c_str());
    ImGui::BeginChild("pass");
    const ImVec2 corner = ImGui::GetWindowPos();
    bench.map.area("pass.body", corner.x, corner.y, ImGui::GetWindowWidth(),
                   ImGui::GetWindowHeight());
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("%s: %s", nameOf(pass.state), pass.reason.c_str());
    ImGui::PopTextWrapPos();
    if (pass.state != graph::PassState::skipped) {
        drawResources(bench, result, pass, true);
        drawResources(bench, result, pass, false);
        drawItsParameters(bench, pass.name);
    }
    ImGui::EndChild();
}

}  // namespace kaustik::gui
