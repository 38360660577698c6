// SPDX-License-Identifier: MIT
// Parameters of the edited variant as rows of tables: with their controls, grey where they have no
// effect now.
#pragma once

#include <string>

#include "framework/gui/bench.h"

namespace kaustik::gui {

// Begins a table of two columns for such rows; ImGui::EndTable() must follow where it is true.
[[nodiscard]] bool beginParameterTable(const std::string& name);

// A row of it; `named` is one of `all`, which are those of the edited variant.
void drawParameterRow(Bench& bench, const VariantParameters& all, const params::NamedField& named);

}  // namespace kaustik::gui
