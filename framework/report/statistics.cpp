// SPDX-License-Identifier: MIT
#include "framework/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/core/json_schema.h"

namespace kaustik::report {

Summary summarize(std::vector<double> samples) {
    Summary summary;
    if (samples.empty()) return summary;
    std::sort(samples.begin(), samples.end());
    const std::size_t count = samples.size();
    const std::size_t middle = count / 2;
    summary.median =
        count % 2 == 1 ? samples[middle] : 0.5 * (samples[middle - 1] + samples[middle]);
    summary.mean =
        std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(count);
    summary.minimum = samples.front();
    summary.maximum = samples.back();
    const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(count)));
    summary.percentile95 = samples[std::max<std::size_t>(rank, 1) - 1];
    if (count > 1) {
        double squares = 0.0;
        for (const double sample : samples) {
            squares += (sample - summary.mean) * (sample - summary.mean);
        }
        summary.standardDeviation = std::sqrt(squares / static_cast<double>(count - 1));
    }
    return summary;
}

nlohmann::json toJson(const Summary& summary) {
    return jsonOf(summary);
}

}  // namespace kaustik::report
