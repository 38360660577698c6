// SPDX-License-Identifier: MIT
#include "framework/gui/shown_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/gui/kept_variant.h"

namespace kaustik::gui {
namespace {

float encoded(double linear) {
    const double value = std::clamp(linear, 0.0, 1.0);
    return static_cast<float>(value <= 0.0031308 ? 12.92 * value
                                                 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055);
}

std::string number(double value) {
    return fmt::format("{:.3g}", value);
}

// A whole number as it is, as long as a float tells it from its neighbours.
std::string digitsOf(float value, int digits) {
    const bool isWhole = std::abs(value) < 16777216.0f && std::round(value) == value;
    return isWhole ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, digits);
}

std::string tickText(double value, Scale scale) {
    if (scale == Scale::logarithmic) {
        // 10⁻⁴ and not 0.0001.
        const double power = std::round(std::log10(value));
        const bool isPower = std::abs(value / std::pow(10.0, power) - 1.0) < 1e-9;
        if (isPower && std::abs(power) > 3.5) return powerText(static_cast<int>(power));
    }
    // 50000 and not 5e+04, as long as it has room.
    const double size = std::abs(value);
    const bool isPlain = size >= 1e3 && size < 1e6 && std::round(value) == value;
    return isPlain ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

// Of the longest label, without its sign.
std::size_t longest(const std::vector<ColorBar::Tick>& ticks) {
    std::size_t length = 0;
    for (const ColorBar::Tick& tick : ticks)
        length = std::max(length, tick.label.size() - (tick.label.starts_with('-') ? 1 : 0));
    return length;
}

// Gives the labels a power of ten in common where that makes them shorter, "5" and not "0.0005".
void shorten(ColorBar& bar) {
    constexpr std::size_t kShort = 3;
    const double size = std::max(std::abs(bar.low), std::abs(bar.high));
    if (longest(bar.ticks) <= kShort || !(size > 0.0) || !std::isfinite(size)) return;
    const double power = std::floor(std::log10(size) + 1e-9);
    const double unit = std::pow(10.0, power);
    std::vector<ColorBar::Tick> ticks = ticksOn(bar.scale, bar.low / unit, bar.high / unit);
    if (longest(ticks) >= longest(bar.ticks)) return;
    bar.ticks = std::move(ticks);
    bar.power = static_cast<int>(power);
}

}  // namespace

std::string powerText(int exponent) {
    static constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                            "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : fmt::format("{}", std::abs(exponent)))
        text += kDigits[static_cast<std::size_t>(digit - '0')];
    return text;
}

std::vector<ColorBar::Tick> ticksOn(Scale scale, double lowest, double high) {
    std::vector<ColorBar::Tick> ticks;
    const auto add = [&](double value) {
        const double place = placeOn(scale, lowest, high, value);
        if (place > -1e-6 && place < 1.0 + 1e-6)
            ticks.push_back({std::clamp(place, 0.0, 1.0), tickText(value, scale)});
    };
    const double low = scale == Scale::symmetric ? -high : lowest;
    if (scale == Scale::logarithmic) {
        const double first = std::ceil(std::log10(low) - 1e-9);
        const double last = std::floor(std::log10(high) + 1e-9);
        const double step = std::max(1.0, std::ceil((last - first) / 6.0));
        for (double power = first; power <= last; power += step)
            add(std::pow(10.0, power));
        if (ticks.size() >= 2) return ticks;
        ticks.clear();
        add(low);
        add(high);
        return ticks;
    }
    constexpr double kWantedTicks = 5.0;
    const double rough = (high - low) / kWantedTicks;
    if (!(rough > 0.0) || !std::isfinite(rough)) return ticks;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double part = rough / decade;
    const double step = decade * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1.0)
        add(i == 0.0 ? 0.0 : i * step);
    return ticks;
}

std::array<float, 3> ColorBar::colorAt(double place) const {
    if (isFalseColor) return falseColor(scale, place);
    const float grey = encoded(place);
    return {grey, grey, grey};
}

int singleChannel(const TextureContent& content, Channel channel) {
    const int chosen = static_cast<int>(channel) - static_cast<int>(Channel::red);
    if (channel >= Channel::red && channel <= Channel::alpha &&
        chosen < static_cast<int>(content.channels.size())) {
        return chosen;
    }
    return content.kind == ValueKind::single ? 0 : -1;
}

const Histogram& histogramFor(Histograms& histograms, const Image& values,
                              const TextureContent& content, const Look& look) {
    if (const int channel = singleChannel(content, look.channel); channel >= 0)
        return histograms.channel(values, std::clamp(channel, 0, std::max(values.channels - 1, 0)));
    // False colours are of one number a pixel.
    if (!look.isFalseColor && look.channel != Channel::luminance) return histograms.all(values);
    return histograms.together(
        values, content.kind == ValueKind::vector ? Together::length : Together::luminance);
}

std::string channelLabel(const TextureContent& content, Channel channel) {
    const int single = singleChannel(content, channel);
    if (single >= 0) return labelOf(content.channels[static_cast<std::size_t>(single)]);
    std::string what = content.quantity;
    if (channel == Channel::luminance)
        what = content.kind == ValueKind::vector ? "length" : "luminance of " + content.quantity;
    return content.unit().empty() ? what : fmt::format("{}, {}", what, content.unit());
}

ToneMapping mappingOf(const Look& look, const TextureContent& content, const Histogram& histogram,
                      bool isEncoded) {
    ToneMapping mapping;
    mapping.isEncoded = isEncoded;
    mapping.kind = content.kind;
    mapping.channel = look.channel;
    mapping.isFalseColor = look.isFalseColor;
    mapping.scale = look.scale;
    mapping.exposureStops = isEncoded ? 0.0f : look.exposureStops;
    const float largest = std::max(std::abs(histogram.low), std::abs(histogram.high));
    if (look.isExposureAutomatic && !isEncoded) {
        const float white = content.kind == ValueKind::vector ? largest : histogram.bright;
        mapping.exposureStops =
            white > 0.0f ? std::clamp(-std::log2(white), -kMaxStops, kMaxStops) : 0.0f;
    }
    mapping.low = look.low;
    mapping.high = look.high;
    if (look.isRangeAutomatic) {
        mapping.low = std::min(histogram.low, 0.0f);
        mapping.high = histogram.bright;
        if (look.scale == Scale::symmetric) {
            // A few pixels at an edge would leave all others white.
            const float typical = std::max(std::abs(histogram.bright), std::abs(histogram.low));
            mapping.high =
                std::min(typical, histogram.bright > 0.0f ? 4.0f * histogram.bright : typical);
            mapping.low = -mapping.high;
        } else if (look.scale == Scale::logarithmic) {
            mapping.low = 1e-4f * mapping.high;
        }
    }
    if (look.scale == Scale::logarithmic) {
        mapping.high = mapping.high > 0.0f ? mapping.high : 1.0f;
        if (!(mapping.low > 0.0f)) mapping.low = 1e-4f * mapping.high;
    }
    if (look.scale == Scale::symmetric) {
        mapping.high = std::max(std::abs(mapping.high), std::numeric_limits<float>::min());
        mapping.low = -mapping.high;
    }
    if (!(mapping.high > mapping.low))
        mapping.high = mapping.low + std::max(std::abs(mapping.low) * 1e-3f, 1e-30f);
    return mapping;
}

std::string ShownImage::caption() const {
    std::string text = source.empty() ? "" : source + ": ";
    if (resource == kErrorResource || resource == kDifferenceResource) {
        // No texture of the graph: what it is says all.
        text += fmt::format("{}, {}", content.quantity, content.unit());
    } else {
        text += name();
        if (!layerName.empty()) text += " · " + layerName;
        // Of the picture as it is, the name says all.
        if (const std::optional<ColorBar> bar = colorBar()) text += " · " + bar->label;
    }
    text += " · " + place;
    if (!note.empty()) text += " · " + note;
    if (!age.empty()) text += " · " + age;
    return text;
}

bool ShownImage::contains(glm::ivec2 pixel) const {
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= values->width || pixel.y >= values->height)
        return false;
    return regions.empty() ||
           std::any_of(regions.begin(), regions.end(), [&](const ViewedTexture::Region& region) {
               return pixel.x >= region.x && pixel.y >= region.y &&
                      pixel.x < region.x + region.width && pixel.y < region.y + region.height;
           });
}

std::string ShownImage::valuesAt(glm::ivec2 pixel) const {
    if (!contains(pixel)) return "";
    std::string text;
    glm::ivec2 inRegion = pixel;
    for (const ViewedTexture::Region& region : regions) {
        if (pixel.x < region.x || pixel.x >= region.x + region.width || pixel.y < region.y ||
            pixel.y >= region.y + region.height) {
            continue;
        }
        inRegion = pixel - glm::ivec2(region.x, region.y);
        text = fmt::format(" of {}", region.name);
    }
    text = fmt::format("({}, {}){}", inRegion.x, inRegion.y, text);
    for (int c = 0; c < values->channels; ++c) {
        const float value = values->at(pixel.x, pixel.y, c);
        const auto index = static_cast<std::size_t>(c);
        const ChannelContent channel =
            index < content.channels.size() ? content.channels[index] : ChannelContent{};
        if (mapping.leavesOut && std::isnan(value)) return text + "  left out";
        text += fmt::format("  {} {}", channel.name, digitsOf(value, 5));
        // Once for all that have it.
        const bool isLast = index + 1 >= content.channels.size() ||
                            content.channels[index + 1].unit != channel.unit;
        if (isLast && !channel.unit.empty()) text += " " + channel.unit;
    }
    return text;
}

std::string ShownImage::numbersAt(glm::ivec2 pixel) const {
    if (!contains(pixel)) return "";
    std::string text;
    for (int c = 0; c < values->channels; ++c) {
        if (c > 0) text += '\n';
        text += digitsOf(values->at(pixel.x, pixel.y, c), 4);
    }
    return text;
}

std::optional<ColorBar> ShownImage::colorBar() const {
    if (mapping.isEncoded && !mapping.isFalseColor) return {};
    ColorBar bar;
    bar.isFalseColor = mapping.isFalseColor;
    if (mapping.isFalseColor) {
        const bool isSingle = singleChannel(content, look.channel) >= 0;
        bar.scale = mapping.scale;
        bar.low = double(mapping.low);
        bar.high = double(mapping.high);
        bar.label = channelLabel(content, isSingle ? look.channel : Channel::luminance);
    } else {
        const double white = std::exp2(-double(mapping.exposureStops));
        const bool isVector = content.kind == ValueKind::vector && look.channel == Channel::color;
        bar.scale = isVector ? Scale::symmetric : Scale::linear;
        bar.low = isVector ? -white : 0.0;
        bar.high = white;
        bar.label = channelLabel(content, look.channel);
    }
    bar.clipsLow = double(histogram.low) < bar.low * (bar.low > 0.0 ? 1.0 - 1e-6 : 1.0 + 1e-6);
    bar.clipsHigh = double(histogram.high) > bar.high * (1.0 + 1e-6);
    bar.ticks = ticksOn(bar.scale, bar.low, bar.high);
    if (bar.scale != Scale::logarithmic) shorten(bar);
    return bar;
}

std::vector<std::pair<Channel, std::string>> ShownImage::channels() const {
    std::vector<std::pair<Channel, std::string>> all;
    if (content.kind != ValueKind::single)
        all.emplace_back(Channel::color,
                         content.kind == ValueKind::vector ? "x, y, z as colours" : "colour");
    for (std::size_t c = 0; c < content.channels.size(); ++c) {
        all.emplace_back(static_cast<Channel>(static_cast<int>(Channel::red) + static_cast<int>(c)),
                         labelOf(content.channels[c]));
    }
    if (content.kind != ValueKind::single)
        all.emplace_back(Channel::luminance,
                         content.kind == ValueKind::vector ? "length" : "luminance");
    return all;
}

std::string ShownImage::identity() const {
    const auto text = [](const PictureOrigin& of) {
        // The reference has no technique.
        const std::string by = of.variant.technique.empty() ? "" : ", " + settingsText(of.variant);
        return fmt::format("{}{}, {}×{} px", of.scene, by, of.size.width, of.size.height);
    };
    if (!origin) return "";
    return text(*origin) + (originOfSubtrahend ? "; less " + text(*originOfSubtrahend) : "");
}

std::vector<std::pair<std::string, std::string>> ShownImage::metadata() const {
    std::vector<std::pair<std::string, std::string>> all = {
        {"image", caption()}, {"quantity", content.quantity}, {"space", place}};
    const auto addOrigin = [&](const PictureOrigin& of, const std::string& prefix) {
        all.emplace_back(prefix + "scene", of.scene);
        all.emplace_back(prefix + "size", fmt::format("{}x{}", of.size.width, of.size.height));
        if (of.variant.technique.empty()) return;
        all.emplace_back(prefix + "technique", of.variant.technique);
        all.emplace_back(prefix + "settings", settingsText(of.variant));
    };
    if (origin) addOrigin(*origin, "");
    if (originOfSubtrahend) addOrigin(*originOfSubtrahend, "subtrahend ");
    std::string units;
    for (const ChannelContent& channel : content.channels)
        units += (units.empty() ? "" : "; ") + labelOf(channel);
    all.emplace_back("channels", units);
    if (const std::optional<ColorBar> bar = colorBar()) {
        static constexpr std::array<const char*, 3> kScales = {"linear", "logarithmic",
                                                               "symmetric"};
        all.emplace_back("colours", fmt::format("{} from {} to {}: {}",
                                                kScales[static_cast<std::size_t>(bar->scale)],
                                                number(bar->low), number(bar->high), bar->label));
    }
    return all;
}

}  // namespace kaustik::gui
