// SPDX-License-Identifier: MIT
// How an image's values are spread: for the range of false colours and the histogram next to them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>

#include "framework/image/image.h"

namespace kaustik::gui {

struct Histogram {
    static constexpr std::size_t kBins = 96;
    float low = 0.0f;  // least and greatest finite value of any channel of colour
    float high = 0.0f;
    // Below which 99 % of the values above 0 lie (of those below 0 where there are no others): a
    // caustic's few brightest pixels would leave the rest black.
    float bright = 0.0f;
    // Values by even steps from low to twice `bright`; the last counts all above.
    std::array<std::uint32_t, kBins> counts{};
    float end = 0.0f;  // where the last bin begins to count all
};

// Counts the values of the first three channels; a fourth is alpha or a flag.
[[nodiscard]] Histogram histogramOf(const Image& image);
// Of one channel, from 0.
[[nodiscard]] Histogram histogramOf(const Image& image, int channel);
// Of what the first three channels are together: their length as a vector's, or their luminance.
enum class Together { luminance, length };
[[nodiscard]] Histogram histogramOf(const Image& image, Together together);

// Those of one image, each made when it is first asked for, on whatever thread.
class Histograms {
  public:
    [[nodiscard]] const Histogram& all(const Image& image);
    [[nodiscard]] const Histogram& channel(const Image& image, int channel);
    [[nodiscard]] const Histogram& together(const Image& image, Together together);

  private:
    const Histogram& kept(int key, const std::function<Histogram()>& make);

    std::mutex mutex_;
    std::map<int, Histogram> made_;  // by channel; below 0 the others
};

}  // namespace kaustik::gui
