// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace kaustik::report {

// Of a series of samples, in their unit; all 0 for none.
struct Summary {
    double median = 0.0;
    double mean = 0.0;
    double minimum = 0.0;
    double maximum = 0.0;
    double percentile95 = 0.0;       // nearest rank
    double standardDeviation = 0.0;  // of the sample (n - 1)
};

[[nodiscard]] Summary summarize(std::vector<double> samples);

// {median, mean, min, max, p95, stdev}
[[nodiscard]] nlohmann::json toJson(const Summary& summary);

}  // namespace kaustik::report
