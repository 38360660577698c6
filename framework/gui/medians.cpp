// SPDX-License-Identifier: MIT
#include "framework/gui/medians.h"

#include <utility>

#include "framework/report/statistics.h"

namespace kaustik::gui {

double medianOf(std::vector<double> values) {
    return values.empty() ? 0.0 : report::summarize(std::move(values)).median;
}

double settledMedianOf(const std::vector<double>& values) {
    if (values.size() < 2) return medianOf(values);
    return medianOf({values.begin() + 1, values.end()});
}

}  // namespace kaustik::gui
