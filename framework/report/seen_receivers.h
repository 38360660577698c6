// SPDX-License-Identifier: MIT
// What the pixels of the picture see of receivers, of a frame with one sample a pixel or several.
#pragma once

#include <vector>

namespace kaustik::report {

// Of eye.receiver (framework/pipeline/surfaces.h; two values a texel, `width` texels a row), with
// `side` by `side` texels a pixel: x above 0 where one of them sees a receiver; y: m² of receiver
// that they see together, 0 where none does.
[[nodiscard]] std::vector<float> seenReceivers(const std::vector<float>& receiver, int width,
                                               int side);

}  // namespace kaustik::report
