// SPDX-License-Identifier: MIT
// How someone else's picture lies over the reference's: mirrored, moved, scaled or cropped.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "framework/image/image.h"

namespace kaustik::judge {

// A pixel p of the reference (continuous, from the top left corner) is seen in their picture,
// mirrored back first, at `theirMiddle + scale warped(p - middle) + shift`, the middles being those
// of the pictures.
struct Registration {
    bool isFlippedX = false;
    bool isFlippedY = false;
    double scale = 1.0;
    glm::dvec2 shift{0.0};     // of their pixels
    double correlation = 0.0;  // of the two at their best, of the square roots of light
    // A homography of places from the middle in halves of the reference's height: that of another
    // camera, for who looks for one (view.h).
    glm::dmat3 warp{1.0};

    [[nodiscard]] glm::dvec2 placeOf(const glm::dvec2& pixel, const Image& reference,
                                     const Image& theirs) const;
};

// The best of all ways up, of scales from a half to twice that of pictures that show the same, and
// of shifts by up to a quarter of the picture, to about a pixel. What is not much better than a
// picture that lies as it should is not taken: symmetric scenes fit both ways.
[[nodiscard]] Registration findRegistration(const Image& theirs, const Image& model,
                                            const Image& mask);

// The picture at places that lie `by` pixels before its own, by the interpolation of resampled().
[[nodiscard]] Image movedBy(const Image& image, const glm::dvec2& by);

[[nodiscard]] Image flipped(const Image& image, bool isFlippedX, bool isFlippedY);

// Their picture in the reference's pixels: cubic between theirs where they are as large, the mean
// over them where they are smaller. `mask` becomes 0 where their picture does not reach.
[[nodiscard]] Image resampled(const Image& theirs, const Registration& registration,
                              const Image& reference, Image& mask);

}  // namespace kaustik::judge
