// SPDX-License-Identifier: MIT
// The parameters of a variant as panels list them, and which of them have no effect now.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/gui/document.h"
#include "framework/gui/frame_result.h"
#include "framework/params/param_set.h"

namespace kaustik::gui {

struct VariantParameters {
    params::ParamSet params;
    std::vector<params::NamedField> fields;  // all that `params` has
    // By full name why it has none, as `kaustik explain` says it; "" where it has one.
    std::map<std::string, std::string> noEffect;
};

// Panels ask in each frame of the window; it is found out where something has changed.
class VariantParametersCache {
  public:
    // Of `document`'s variant A (0) or B (1), by what `result` has of it; before there is a frame
    // by what is declared alone. Throws ConfigError as settingsOf() does.
    [[nodiscard]] std::shared_ptr<const VariantParameters> of(
        const Document& document, std::size_t index,
        const std::shared_ptr<const FrameResult>& result, const Registry& registry);

  private:
    struct Key {
        Variant variant;
        params::Extent size;
        std::size_t index = 0;
        std::shared_ptr<const FrameResult> result;
        friend bool operator==(const Key&, const Key&) = default;
    };
    Key key_;
    std::shared_ptr<const VariantParameters> newest_;  // null before
};

}  // namespace kaustik::gui
