// SPDX-License-Identifier: MIT
#include "framework/image/pfm.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "framework/core/error.h"
#include "framework/image/eight_bits.h"
#include "framework/image/image_limits.h"

namespace kaustik {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

// The words before the pixels of a Netpbm-like file: separated by white space, '#' to the end of
// the line is a comment, and exactly one white-space character follows the last word.
class Header {
  public:
    Header(std::string_view bytes, const std::string& name, const char* format)
        : bytes_(bytes), name_(name), format_(format) {}

    template <class Number>
    Number number(const char* what) {
        const std::string_view text = word();
        Number value{};
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (text.empty() || problem != std::errc() || end != text.data() + text.size()) {
            fail(fmt::format("its header has no valid {}", what));
        }
        return value;
    }

    std::string_view word() {
        while (at_ < bytes_.size() && (isBlank(bytes_[at_]) || bytes_[at_] == '#')) {
            if (bytes_[at_] == '#') {
                while (at_ < bytes_.size() && bytes_[at_] != '\n')
                    ++at_;
            } else {
                ++at_;
            }
        }
        const std::size_t begin = at_;
        // The longest word that means anything is a float with all of its digits.
        while (at_ < bytes_.size() && !isBlank(bytes_[at_]) && at_ - begin < 64)
            ++at_;
        return bytes_.substr(begin, at_ - begin);
    }

    // What follows the header; it must be exactly `count` bytes.
    std::string_view pixels(std::uint64_t count) {
        if (at_ >= bytes_.size() || !isBlank(bytes_[at_])) fail("its header is cut off");
        const std::string_view rest = bytes_.substr(at_ + 1);
        if (rest.size() < count) {
            fail(fmt::format("it is cut off: {} bytes of pixels of {}", rest.size(), count));
        }
        if (rest.size() > count) {
            fail(fmt::format("{} bytes follow the last pixel", rest.size() - count));
        }
        return rest;
    }

    void checkSize(std::int64_t width, std::int64_t height, int channels) {
        const std::string problem = imageSizeProblem(width, height, channels);
        if (!problem.empty()) throw IoError(fmt::format("{} {}.", name_, problem));
    }

    [[noreturn]] void fail(const std::string& reason) {
        throw IoError(fmt::format("{} is not a whole {} file: {}.", name_, format_, reason));
    }

  private:
    std::string_view bytes_;
    const std::string& name_;
    const char* format_;
    std::size_t at_ = 0;
};

float floatFromBytes(const char* bytes, bool littleEndian) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) {
        const int shift = littleEndian ? 8 * i : 8 * (3 - i);
        bits |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << shift;
    }
    return std::bit_cast<float>(bits);
}

void appendLittleEndian(std::string& bytes, float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>((bits >> (8 * i)) & 0xffu);
}

}  // namespace

Image decodePfm(std::string_view bytes, const std::string& name) {
    Header header(bytes, name, "PFM");
    const std::string_view magic = header.word();
    if (magic != "PF" && magic != "Pf") header.fail("it does not begin with PF or Pf");
    const int channels = magic == "PF" ? 3 : 1;
    const auto width = header.number<std::int64_t>("width");
    const auto height = header.number<std::int64_t>("height");
    header.checkSize(width, height, channels);
    // A negative scale says that the values are little-endian.
    const auto scale = header.number<double>("scale");
    if (!std::isfinite(scale) || scale == 0.0) header.fail("its scale is zero or not finite");
    const bool littleEndian = scale < 0.0;
    const auto factor = static_cast<float>(std::abs(scale));

    const std::size_t rowValues =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    // Before memory is taken for them.
    const std::string_view pixels = header.pixels(4 * rowValues * static_cast<std::size_t>(height));
    Image image(static_cast<int>(width), static_cast<int>(height), channels);
    for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
        float* const target = image.values.data() + row * rowValues;
        const char* const source =
            pixels.data() + 4 * rowValues * (static_cast<std::size_t>(height) - 1 - row);
        for (std::size_t i = 0; i < rowValues; ++i) {
            target[i] = floatFromBytes(source + 4 * i, littleEndian) * factor;
        }
    }
    return image;
}

Image decodePpm(std::string_view bytes, const std::string& name) {
    Header header(bytes, name, "PPM");
    if (header.word() != "P6") header.fail("it does not begin with P6 (binary colour)");
    const auto width = header.number<std::int64_t>("width");
    const auto height = header.number<std::int64_t>("height");
    header.checkSize(width, height, 3);
    const auto maximum = header.number<std::int64_t>("maximum");
    if (maximum < 1 || maximum > 65535) header.fail("its maximum is not in 1 to 65535");
    const std::size_t bytesPerValue = maximum > 255 ? 2 : 1;

    const std::size_t values =
        3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::string_view pixels = header.pixels(bytesPerValue * values);
    Image image(static_cast<int>(width), static_cast<int>(height), 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        std::int64_t value = 0;
        for (std::size_t byte = 0; byte < bytesPerValue; ++byte) {  // most significant first
            value = 256 * value + static_cast<unsigned char>(pixels[bytesPerValue * i + byte]);
        }
        if (value > maximum) header.fail(fmt::format("a value is above its maximum, {}", maximum));
        image.values[i] = static_cast<float>(value) / static_cast<float>(maximum);
    }
    return image;
}

std::string encodePfm(const Image& image) {
    std::string bytes = fmt::format("{}\n{} {}\n-1.0\n", image.channels == 3 ? "PF" : "Pf",
                                    image.width, image.height);
    bytes.reserve(bytes.size() + 4 * image.values.size());
    for (int y = image.height - 1; y >= 0; --y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c)
                appendLittleEndian(bytes, image.at(x, y, c));
        }
    }
    return bytes;
}

std::string encodePpm(const Image& image) {
    std::string bytes = fmt::format("P6\n{} {}\n255\n", image.width, image.height);
    const int repeats = image.channels == 1 ? 3 : 1;
    for (const unsigned char value : toEightBits(image)) {
        bytes.append(static_cast<std::size_t>(repeats), static_cast<char>(value));
    }
    return bytes;
}

}  // namespace kaustik
