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

std::vector<unsigned char> litPixels(const ImagePair& pair) {
    const Plane<double> luminances = luminancePlane(pair.reference());
    Plane<double> noise = luminances;
    std::fill(noise.values.begin(), noise.values.end(), 0.0);
    if (pair.hasStandardError()) noise = luminancePlane(pair.standardError());
    std::vector<unsigned char> lit(luminances.values.size(), 0);
    for (std::size_t pixel = 0; pixel < lit.size(); ++pixel) {
        const bool isLit = luminances.values[pixel] > 3.0 * noise.values[pixel];
        lit[pixel] = pair.counts(pixel) && isLit ? 1 : 0;
    }
    return lit;
}

}  // namespace kaustik::measure
