// SPDX-License-Identifier: MIT
// The textures of the graph as a list that opens: name, size and format, unit, and who writes them.
#include <fmt/format.h>

#include <array>
#include <cfloat>

#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/resource_words.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

struct Row {
    std::string name;      // that is shown
    std::string resource;  // "": the picture
    std::string part;      // of it; "": all
    std::array<std::string, 3> cells;
};

std::vector<Row> rowsOf(const VariantResult& result) {
    std::vector<Row> rows = {{"picture", "", "", {"", "", "what the technique shows"}}};
    for (const ListedTexture& texture : result.textures) {
        const std::string units = unitsOf(result, texture.name);
        const std::string writers = writersText(result, texture.name);
        rows.push_back({texture.name,
                        texture.name,
                        "",
                        {sizeAndFormat(result, texture.name), units, writers}});
        for (const ViewedTexture::Region& part : partsOf(result, texture.name)) {
            rows.push_back({texture.name + ": " + part.name,
                            texture.name,
                            part.name,
                            {fmt::format("{}x{}", part.width, part.height), units, writers}});
        }
    }
    return rows;
}

void drawRows(Bench& bench, const std::vector<Row>& rows, const std::string& filter) {
    if (!ImGui::BeginTable("textures", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
        return;
    for (const char* column : {"texture", "size and format", "unit", "written by"})
        ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    for (const Row& row : rows) {
        if (row.name.find(filter) == std::string::npos) continue;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const bool isChosen = row.resource == bench.view.resource && row.part.empty();
        if (ImGui::Selectable(row.name.c_str(), isChosen, ImGuiSelectableFlags_SpanAllColumns) &&
            !isChosen) {
            openTexture(bench, row.resource, row.part);
        }
        bench.map.control("image.texture=" + row.name,
                          row.cells[0] + " | " + row.cells[1] + " | " + row.cells[2]);
        if (isChosen && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
        for (const std::string& cell : row.cells) {
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", cell.c_str());
        }
    }
    ImGui::EndTable();
}

}  // namespace

void drawTextureList(Bench& bench) {
    const std::string shown = bench.view.resource.empty() ? "picture" : bench.view.resource;
    ImGui::SetNextItemWidth(-FLT_MIN);
    const ImVec2 screen = ImGui::GetMainViewport()->WorkSize;
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {screen.x, 0.7f * screen.y});
    const bool isOpen =
        ImGui::BeginCombo("##texture", shown.c_str(), ImGuiComboFlags_PopupAlignLeft);
    bench.map.control("image.texture", shown);
    if (!isOpen) {
        tooltip("Any texture of the graph. One whose pass nothing else needs makes that pass run.");
        return;
    }
    // Only one list can be open.
    static thread_local std::string filter;
    if (ImGui::IsWindowAppearing()) {
        filter.clear();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(static_cast<float>(bench.px(240.0)));
    searchField(bench, filter, "image.texture.search");
    drawRows(bench, rowsOf(bench.editedResult()), filter);
    ImGui::EndCombo();
}

}  // namespace kaustik::gui
