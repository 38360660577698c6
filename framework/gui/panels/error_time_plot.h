// SPDX-License-Identifier: MIT
// Error against time as a picture: points, and the front of those that no other one beats in both.
// For the session's settings (panel Trade-off) as for the runs of a study (panel Study).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "framework/gui/bench.h"

namespace kaustik::gui {

struct ErrorMeasure {
    const char* label;
    const char* key;
    const char* unit;
};
// Those of which less is better.
inline constexpr std::array<ErrorMeasure, 6> kErrorMeasures = {{{"relMSE", "rel_mse", ""},
                                                                {"RMSE", "rmse", "W/m²"},
                                                                {"SMAPE", "smape", ""},
                                                                {"MAE", "mae", "W/m²"},
                                                                {"FLIP", "flip_ldr", ""},
                                                                {"HDR-FLIP", "flip_hdr", ""}}};
// The measure of both panels, with the control to choose another. `panel` begins its name in the
// screen map.
[[nodiscard]] const ErrorMeasure& chooseMeasure(Bench& bench, const std::string& panel);

struct PlottedSetting {
    std::string label;     // a short one, that the plot and its row have in common
    std::string settings;  // what tells it from the others
    std::string remark;    // what else there is to say
    TimeAndError at;
    bool isNow = false;  // it has the settings of the variant at hand
    bool isOnFront = false;
};

// Notes which of them are on the front; gives these, by rising time.
std::vector<std::size_t> markFront(std::vector<PlottedSetting>& points);

// Each gives the one that was clicked. `panel` as above; points are not none.
[[nodiscard]] std::optional<std::size_t> drawErrorTimePlot(
    Bench& bench, const std::string& panel, const std::vector<PlottedSetting>& points,
    const std::vector<std::size_t>& front, const ErrorMeasure& measure);
// The same as a table that is copied and saved.
[[nodiscard]] std::optional<std::size_t> drawErrorTimeRows(
    Bench& bench, const std::string& panel, const std::vector<PlottedSetting>& points,
    const ErrorMeasure& measure);

}  // namespace kaustik::gui
