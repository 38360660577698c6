// SPDX-License-Identifier: MIT
// An image and the reference that it is judged by. Every measure takes one, and making one checks
// both: no number can come from images with NaN, or from images of different sizes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/image/image.h"

namespace kaustik::measure {

// Linear images with 1 channel (grey, the same as three equal ones), 3, or 4 (alpha is ignored).
// What is optional may be null; names are for messages.
struct PairInputs {
    const Image& image;
    const Image& reference;  // as many channels of colour as the image
    // The mask leaves out pixels where its first channel is 0, such as those without a receiver.
    const Image* mask = nullptr;
    // One standard deviation of the reference's mean in each pixel, not negative.
    const Image* standardError = nullptr;
    // m² of receiver that each pixel sees, in the first channel, not negative: sums of irradiance
    // over the pixels are then flux.
    const Image* area = nullptr;
    std::string imageName = "The image";
    std::string referenceName = "The reference";
    std::string maskName = "The mask";
    std::string standardErrorName = "The standard error";
    std::string areaName = "The area";
};

class ImagePair {
  public:
    // Throws IoError for values that are not finite (or negative where that makes no sense), and
    // ConfigError for sizes or channels that do not fit, or a mask that leaves no pixel.
    explicit ImagePair(const PairInputs& inputs);

    [[nodiscard]] int width() const { return image_.width; }
    [[nodiscard]] int height() const { return image_.height; }
    [[nodiscard]] std::size_t pixelCount() const { return areas_.size(); }
    // The number of pixels that the mask does not leave out; at least 1.
    [[nodiscard]] std::size_t countedPixels() const { return countedPixels_; }
    [[nodiscard]] bool counts(std::size_t pixel) const { return counts_[pixel] != 0; }

    // RGB. Pixels that are left out are 0 in both, so that filters see no difference there.
    [[nodiscard]] const Image& image() const { return image_; }
    [[nodiscard]] const Image& reference() const { return reference_; }

    [[nodiscard]] bool hasStandardError() const { return !standardError_.values.empty(); }
    [[nodiscard]] const Image& standardError() const { return standardError_; }

    // m², or 1 for every pixel where no areas are known; 0 for pixels that are left out.
    [[nodiscard]] bool hasArea() const { return hasArea_; }
    [[nodiscard]] double area(std::size_t pixel) const { return areas_[pixel]; }

  private:
    Image image_;
    Image reference_;
    Image standardError_;
    std::vector<unsigned char> counts_;
    std::vector<double> areas_;
    std::size_t countedPixels_ = 0;
    bool hasArea_ = false;
};

}  // namespace kaustik::measure
