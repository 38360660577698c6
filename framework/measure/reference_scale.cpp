// SPDX-License-Identifier: MIT
#include "framework/measure/reference_scale.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "framework/measure/color.h"

namespace kaustik::measure {

ReferenceScale referenceScale(const ImagePair& pair) {
    const Plane<double> luminances = luminancePlane(pair.reference());
    std::vector<std::pair<double, double>> lit;  // luminance, flux
    double total = 0.0;
    for (std::size_t pixel = 0; pixel < luminances.values.size(); ++pixel) {
        const double flux = luminances.values[pixel] * pair.area(pixel);
        if (flux <= 0.0) continue;
        lit.emplace_back(luminances.values[pixel], flux);
        total += flux;
    }
    ReferenceScale scale;
    if (lit.empty()) return scale;
    std::sort(lit.begin(), lit.end(), [](const auto& a, const auto& b) { return a > b; });
    scale.brightest = lit.front().first;
    double sum = 0.0;
    auto pixel = lit.begin();
    for (const auto& [share, target] :
         {std::pair{0.1, &scale.white}, std::pair{0.5, &scale.typical},
          std::pair{0.9, &scale.faint}}) {
        while (pixel != lit.end() && sum < share * total)
            sum += (pixel++)->second;
        *target = std::prev(pixel)->first;
    }
    return scale;
}

}  // namespace kaustik::measure
