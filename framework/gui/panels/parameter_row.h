// SPDX-License-Identifier: MIT
// Parameters of the edited variant as rows of tables: with their controls, grey where they have no
// effect now.
#pragma once

#include <string>

#include "framework/gui/bench.h"
#include "framework/params/param_set.h"

namespace kaustik::gui {

// Why a parameter has no effect now, as `kaustik explain` says it; "" where it has one. `params`:
// those of the edited variant.
[[nodiscard]] std::string whyNoEffectNow(const Bench& bench, const params::ParamSet& params,
                                         const std::string& name);

// Begins a table of two columns for such rows; ImGui::EndTable() must follow where it is true.
[[nodiscard]] bool beginParameterTable(const std::string& name);

// A row of it. `reason`: what whyNoEffectNow() says.
void drawParameterRow(Bench& bench, const params::ParamSet& params, const params::NamedField& named,
                      const std::string& reason);

}  // namespace kaustik::gui
