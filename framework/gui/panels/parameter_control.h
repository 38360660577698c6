// SPDX-License-Identifier: MIT
// The control that a parameter's declaration asks for.
#pragma once

#include <optional>
#include <string>

#include "framework/gui/bench.h"
#include "framework/params/param_set.h"

namespace kaustik::gui {

// A parameter with the control that its declaration asks for: true, with its new text, when the
// user has changed it. `noEffect`: the sentence that says why it has none now, where it has none.
struct ParameterChange {
    bool changed = false;
    std::string text;
    // What there is to say of what the user has just done (typed_value.h); none where nothing was.
    std::optional<std::string> problem = {};
};
[[nodiscard]] ParameterChange drawParameter(Bench& bench, const params::NamedField& named,
                                            const std::string& label,
                                            const std::string& noEffect = "");

}  // namespace kaustik::gui
