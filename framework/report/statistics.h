// SPDX-License-Identifier: MIT
// Statistics of series of measured times.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace kaustik::report {

// A series of samples in a few numbers, in the samples' unit; all 0 where there are no samples.
struct Summary {
    double median = 0.0;
    double mean = 0.0;
    double minimum = 0.0;
    double maximum = 0.0;
    double percentile95 = 0.0;       // nearest rank
    double standardDeviation = 0.0;  // of the sample (n - 1)
};

[[nodiscard]] Summary summarize(std::vector<double> samples);

[[nodiscard]] nlohmann::json toJson(const Summary& summary);
template <class F>
void reflect(F& f, const Summary& summary) {
    f.field("median", summary.median, "The middle one, or the mean of both");
    f.field("mean", summary.mean, "");
    f.field("min", summary.minimum, "");
    f.field("max", summary.maximum, "");
    f.field("p95", summary.percentile95, "95th percentile, by the nearest rank");
    f.field("stdev", summary.standardDeviation, "Standard deviation of the sample");
}

}  // namespace kaustik::report
