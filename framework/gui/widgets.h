// SPDX-License-Identifier: MIT
// The controls that several panels use.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "framework/gui/bench.h"
#include "framework/gui/medians.h"
#include "framework/gui/table.h"
#include "framework/params/param_set.h"

namespace kaustik::gui {

// Of what is wrong.
inline const ImVec4 kProblemColor(1.0f, 0.45f, 0.4f, 1.0f);

// A width and a height to type, taken over when both are done with; true when they have changed.
[[nodiscard]] bool inputExtent(const char* label, params::Extent& value, int minimum, int maximum);

// Values over time as a line, the newest at the right, from 0 to the largest.
void sparkline(const std::vector<double>& values, ImVec2 size);

// A bar to drag between two areas; changes `size` by the way along x (or y), times `sign`.
void splitter(const char* name, bool isVertical, float length, float& size, float sign,
              Bench& bench);

// Copies a table as text, or writes it as CSV into the folder of recordings. `name` says which.
void drawTableButtons(Bench& bench, const std::string& name, const Table& table);

// Text that explains the item before it.
void tooltip(const std::string& text);

// Text with an end that is cut where there is no room, and the whole of it under the mouse.
void cutLine(const std::string& text, ImVec2 at, ImU32 color, float room);

// What comes next, so wide, stands in the line of the item before it where there is room.
void sameLineWithRoom(float width);

// A button, checkbox or choice with its name in the screen map.
[[nodiscard]] bool button(Bench& bench, const char* label, const std::string& name);
[[nodiscard]] bool checkbox(Bench& bench, const char* label, bool& value, const std::string& name);
void inputText(Bench& bench, const char* label, const char* hint, std::string& text,
               const std::string& name);
// The width that leaves room for a label to a control's right, but for at least a part of the row.
[[nodiscard]] float widthBeside(const char* label);

// What the options of an open list are searched by. Escape in it closes the list.
void searchField(Bench& bench, std::string& filter, const std::string& name);
// One of several; true when another was chosen. `hint` is seen where there is none yet.
[[nodiscard]] bool choose(Bench& bench, const char* label, const std::vector<std::string>& options,
                          int& index, const std::string& name, const char* hint = "");
// A small mark of a value that is not the default, which takes it back; true when used.
[[nodiscard]] bool resetMark(Bench& bench, const std::string& name, const std::string& before);

// A stage's colour in charts and lists.
[[nodiscard]] ImVec4 stageColor(const Registry& registry, const std::string& stage);
[[nodiscard]] std::string stageOf(const std::string& pass);
// The place of a stage among those of the registry; what is none of them comes last.
[[nodiscard]] std::size_t stageRank(const Registry& registry, const std::string& stage);

// Draws a line that says which of the two variants the panel is of, and changes it, where there are
// two. `panel` begins its names in the screen map.
void chooseVariant(Bench& bench, const std::string& panel);

// What a pass took in the newest frames; null where that is not known.
[[nodiscard]] const report::PassTimes* timesOf(const VariantResult& result,
                                               const std::string& pass);

// Brings a panel to the front by its name, on the side where it is.
void showPanel(Bench& bench, const std::string& name);

}  // namespace kaustik::gui
