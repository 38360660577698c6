// SPDX-License-Identifier: MIT
#include "framework/gui/shown_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/gui/kept_variant.h"

namespace kaustik::gui {
namespace {

// The channel that is looked at by itself; -1: all of a colour or a vector.
int singleChannel(const TextureContent& content, Channel channel) {
    const int chosen = static_cast<int>(channel) - static_cast<int>(Channel::red);
    if (channel >= Channel::red && channel <= Channel::alpha &&
        chosen < static_cast<int>(content.channels.size())) {
        return chosen;
    }
    return content.kind == ValueKind::single ? 0 : -1;
}

float encoded(double linear) {
    const double value = std::clamp(linear, 0.0, 1.0);
    return static_cast<float>(value <= 0.0031308 ? 12.92 * value
                                                 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055);
}

std::string number(double value) {
    return fmt::format("{:.3g}", value);
}

const Histogram& histogramFor(const ViewedTexture& viewed, const Look& look) {
    const int channel = singleChannel(viewed.content, look.channel);
    const auto place = static_cast<std::size_t>(channel);
    return channel >= 0 && place < viewed.channelHistograms.size() ? viewed.channelHistograms[place]
                                                                   : viewed.histogram;
}

ShownImage imageOf(const ViewedTexture& viewed, const ViewState& view) {
    ShownImage image;
    image.resource = viewed.name;
    if (!viewed.layerNames.empty())
        image.layerName = viewed.layerNames[static_cast<std::size_t>(viewed.layer)];
    image.content = viewed.content;
    image.place = viewed.place;
    image.values = &viewed.values;
    image.version = viewed.version;
    image.regions = viewed.regions;
    image.look = view.lookOf(viewed.name);
    image.histogram = histogramFor(viewed, image.look);
    image.mapping = mappingOf(image.look, image.content, image.histogram, viewed.isEncoded);
    return image;
}

void noteAge(ShownImage& image, const ShownRequest& requested, const VariantResult& variant) {
    if (variant.isPreview) {
        image.age = "quick picture, half the size and without caustics";
    } else if (variant.order < requested.order || !variant.error.empty()) {
        image.age = "from before the last change";
    }
}

ShownImage ofReference(const ShownRequest& requested, const ReferenceState& reference,
                       const ShownImage* main) {
    ShownImage image;
    image.resource = "caustic.irradiance";
    image.source = "reference";
    image.content = contentOf(image.resource, {});
    image.content.channels.resize(3);
    image.place = describe(TextureSpace::eye);
    image.note = noteOf(reference);
    image.values = reference.irradiance.get();
    image.owner = reference.irradiance;
    image.version = 2 * reference.version;
    image.histogram = histogramOf(*image.values);
    image.look = requested.view.lookOf(image.resource);
    image.mapping = mappingOf(image.look, image.content, image.histogram, false);
    // Both sides of a split have one scale.
    if (main != nullptr && main->resource == image.resource) image.mapping = main->mapping;
    return image;
}

ShownImage ofError(const ShownRequest& requested, const ReferenceState& reference,
                   const ReferenceState::Judgement& judgement, std::uint64_t order) {
    ShownImage image;
    image.resource = kErrorResource;
    image.source = "error";
    image.content.quantity = "caustic irradiance minus that of the reference, mean of the channels";
    image.content.kind = ValueKind::single;
    image.content.space = TextureSpace::eye;
    image.content.channels = {{"error", "W/m²"}};
    image.place = describe(TextureSpace::eye);
    image.note = noteOf(reference);
    if (judgement.order != order) image.age = "of a frame before this one";
    image.values = judgement.error.get();
    image.owner = judgement.error;
    image.version = 2 * reference.version + 1;
    image.histogram = judgement.errorHistogram;
    image.look = requested.view.lookOf(kErrorResource);
    if (!requested.view.looks.contains(kErrorResource)) {
        image.look.isFalseColor = true;
        image.look.scale = Scale::symmetric;
    }
    image.mapping = mappingOf(image.look, image.content, image.histogram, false);
    image.mapping.leavesOut = true;
    return image;
}

ShownImage ofKept(const ShownRequest& requested, const KeptVariant& kept, std::size_t index,
                  const std::shared_ptr<const ViewedTexture>& texture) {
    ShownImage image = imageOf(*texture, requested.view);
    image.owner = texture;
    image.source = fmt::format("kept {}", index + 1);
    image.note = kept.name;
    return image;
}

std::string notKeptWith(std::size_t index, const std::string& resource) {
    return fmt::format("variant {} was kept without {}", index + 1,
                       resource.empty() ? "its picture" : resource);
}

ShownImage ofDifference(const ShownRequest& requested, const ShownImage& main,
                        const ShownImage& other) {
    const ImageDifference& difference = *requested.difference;
    ShownImage image;
    image.resource = kDifferenceResource;
    image.source =
        fmt::format("{} minus {}", main.source.empty() ? "A" : main.source, other.source);
    image.content.quantity = "difference of " + main.content.quantity;
    image.content.kind = ValueKind::single;
    image.content.space = main.content.space;
    image.content.channels = {{"difference", main.content.unit()}};
    image.place = main.place;
    image.note = fmt::format("RMSE {:.4g}", difference.rmse);
    if (difference.flip) image.note += fmt::format(", FLIP {:.4g}", *difference.flip);
    image.values = difference.signedMean.get();
    image.owner = difference.signedMean;
    // No two of them have one place in memory while either is shown.
    image.version = main.version ^ (other.version << 1u) ^ 0x5bd1e995u;
    image.histogram = difference.histogram;
    image.look = requested.view.lookOf(kDifferenceResource);
    if (!requested.view.looks.contains(kDifferenceResource)) {
        image.look.isFalseColor = true;
        image.look.scale = Scale::symmetric;
    }
    image.mapping = mappingOf(image.look, image.content, image.histogram, false);
    return image;
}

// Ticks at round numbers.
std::vector<ColorBar::Tick> ticksOf(const ColorBar& bar) {
    std::vector<ColorBar::Tick> ticks;
    const auto add = [&](double value) {
        const double place = placeOn(bar.scale, bar.low, bar.high, value);
        if (place > -1e-6 && place < 1.0 + 1e-6)
            ticks.push_back({std::clamp(place, 0.0, 1.0), fmt::format("{:.4g}", value)});
    };
    const double low = bar.scale == Scale::symmetric ? -bar.high : bar.low;
    if (bar.scale == Scale::logarithmic) {
        const double first = std::ceil(std::log10(low) - 1e-9);
        const double last = std::floor(std::log10(bar.high) + 1e-9);
        const double step = std::max(1.0, std::ceil((last - first) / 6.0));
        for (double power = first; power <= last; power += step)
            add(std::pow(10.0, power));
        if (ticks.size() >= 2) return ticks;
        ticks.clear();
        add(low);
        add(bar.high);
        return ticks;
    }
    constexpr double kWantedTicks = 5.0;
    const double rough = (bar.high - low) / kWantedTicks;
    if (!(rough > 0.0) || !std::isfinite(rough)) return ticks;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double part = rough / decade;
    const double step = decade * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
    for (double i = std::ceil(low / step - 1e-9); i * step <= bar.high + 1e-9 * step; i += 1.0)
        add(i == 0.0 ? 0.0 : i * step);
    return ticks;
}

// What is asked for to the right of the split; nothing with a reason where it is not there.
std::optional<ShownImage> comparedImageOf(ComparedImage wanted, const ShownRequest& requested,
                                          const FrameResult& result,
                                          const ReferenceState& reference, const ShownImage& main,
                                          std::string& problem) {
    const bool hasReference =
        reference.photons > 0 && reference.irradiance && hasSameView(reference, result.document);
    const ReferenceState::Judgement& judgement = reference.judgements[requested.seen()];
    switch (wanted) {
        case ComparedImage::none:
        case ComparedImage::difference:
            return {};
        case ComparedImage::kept: {
            const auto index = static_cast<std::size_t>(requested.view.comparedKept);
            if (requested.kept == nullptr || index >= requested.kept->size()) return {};
            const KeptVariant& kept = (*requested.kept)[index];
            const auto texture = kept.texture(main.resource);
            if (!texture) {
                problem = notKeptWith(index, main.resource);
                return {};
            }
            ShownImage image = ofKept(requested, kept, index, texture);
            image.mapping = main.mapping;
            return image;
        }
        case ComparedImage::other: {
            const VariantResult& b = result.variants[1];
            if (!b.viewed || b.viewed->values.values.empty()) return {};
            ShownImage image = imageOf(*b.viewed, requested.view);
            image.source = "B";
            noteAge(image, requested, b);
            if (b.viewed->missing == ViewedTexture::Missing::texture) {
                problem = "variant B has no such texture";
                return {};
            }
            // One scale for both, so that what is brighter is more.
            image.mapping = main.mapping;
            return image;
        }
        case ComparedImage::reference:
            if (!hasReference) {
                problem = "there is no reference of this view to show next to it yet";
                return {};
            }
            return ofReference(requested, reference, &main);
        case ComparedImage::error:
            if (!hasReference) {
                problem = "there is no reference of this view to measure its error by yet";
                return {};
            }
            if (!judgement.error) {
                problem = judgement.order == 0 ? "the error next to it is still being measured"
                                               : "no pixel has an error to be shown";
                return {};
            }
            if (judgement.order != result.order)
                problem = "the error next to it is of a frame before and being measured";
            return ofError(requested, reference, judgement, result.order);
    }
    return {};
}

// What stands to the right of the split, where it can be compared.
void addCompared(Showing& showing, const ShownRequest& requested, const FrameResult& result,
                 const ReferenceState& reference) {
    const ShownImage& main = *showing.main;
    const bool isDifference = requested.view.comparedWith == ComparedImage::difference;
    const ComparedImage wanted = !isDifference                      ? requested.view.comparedWith
                                 : requested.view.comparedKept >= 0 ? ComparedImage::kept
                                                                    : ComparedImage::other;
    std::optional<ShownImage> compared =
        comparedImageOf(wanted, requested, result, reference, main, showing.comparedProblem);
    if (!compared) return;
    if (const std::string why = whyNotComparable(main, *compared); !why.empty()) {
        showing.comparedProblem = "nothing stands next to it: " + why;
        return;
    }
    if (!isDifference) {
        showing.compared = std::move(compared);
        return;
    }
    showing.subtrahend = std::move(compared);
    if (!requested.difference ||
        !requested.difference->isOf(main.version, showing.subtrahend->version)) {
        showing.comparedProblem = "the difference next to it is being computed";
    } else if (!requested.difference->signedMean) {
        showing.comparedProblem = "there is no difference: " + requested.difference->problem;
    } else {
        showing.compared = ofDifference(requested, main, *showing.subtrahend);
    }
}

}  // namespace

const KeptVariant* ShownRequest::flipped() const {
    const auto index = static_cast<std::size_t>(view.flipped);
    return kept != nullptr && view.flipped >= 0 && index < kept->size() ? &(*kept)[index] : nullptr;
}

std::string noteOf(const ReferenceState& reference) {
    std::string note =
        fmt::format("{:.3g} million photons", static_cast<double>(reference.photons) * 1e-6);
    if (std::isfinite(reference.relativeError))
        note += fmt::format(", its own noise {:.2g} %", 100.0 * reference.relativeError);
    return note;
}

std::array<float, 3> ColorBar::colorAt(double place) const {
    if (isFalseColor) return falseColor(scale, place);
    const float grey = encoded(place);
    return {grey, grey, grey};
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
        if (!mapping.isEncoded) text += " · " + channelLabel(content, look.channel);
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
        text += fmt::format("  {} {:.5g}", channel.name, value);
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
    for (int c = 0; c < values->channels; ++c)
        text += fmt::format("{}{:.4g}", c == 0 ? "" : "\n", values->at(pixel.x, pixel.y, c));
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
    bar.ticks = ticksOf(bar);
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

std::vector<std::pair<std::string, std::string>> ShownImage::metadata(
    const Document& document) const {
    std::vector<std::pair<std::string, std::string>> all = {
        {"scene", document.scene},
        {"technique",
         source == "B" && document.other ? document.other->technique : document.variant.technique},
        {"image", caption()},
        {"quantity", content.quantity},
        {"space", place}};
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
    const Variant& variant = source == "B" && document.other ? *document.other : document.variant;
    std::string settings;
    for (const auto& [name, value] : variant.assignments)
        settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", name, value);
    if (!settings.empty()) all.emplace_back("settings", settings);
    return all;
}

std::string whyNotComparable(const ShownImage& a, const ShownImage& b) {
    if (a.content.space != b.content.space)
        return fmt::format("{} is {}, {} is {}", a.name(), a.place, b.name(), b.place);
    // A quick picture has fewer pixels of the same view.
    if (a.age.empty() && b.age.empty() &&
        (a.values->width != b.values->width || a.values->height != b.values->height)) {
        return fmt::format("{} has {}×{} pixels, {} has {}×{}", a.name(), a.values->width,
                           a.values->height, b.name(), b.values->width, b.values->height);
    }
    if (b.resource == kErrorResource) return "";
    if (a.mapping.isEncoded != b.mapping.isEncoded || a.content.unit() != b.content.unit() ||
        a.content.kind != b.content.kind) {
        return fmt::format("{} is {}, {} is {}", a.name(), channelLabel(a.content, Channel::color),
                           b.name(), channelLabel(b.content, Channel::color));
    }
    return "";
}

Showing showingOf(const ShownRequest& requested, const FrameResult& result,
                  const ReferenceState& reference) {
    Showing showing;
    const VariantResult& shown = result.variants[requested.seen()];
    if (const KeptVariant* kept = requested.flipped()) {
        const auto index = static_cast<std::size_t>(requested.view.flipped);
        const auto texture = kept->texture(requested.view.resource);
        if (!texture) {
            showing.words = notKeptWith(index, requested.view.resource) + ".";
            showing.words[0] = 'V';
            return showing;
        }
        showing.main = ofKept(requested, *kept, index, texture);
        // What is drawn over it is of the document at hand.
        showing.main->takesOverlay = texture->content.space == TextureSpace::eye &&
                                     kept->document.scene == requested.document.scene &&
                                     kept->document.edits == requested.document.edits;
        addCompared(showing, requested, result, reference);
        return showing;
    }
    if (!shown.viewed) {
        const bool isToCome = result.problem.empty() && shown.error.empty();
        showing.words =
            isToCome ? "The first picture is being rendered …" : "There is nothing to show.";
        return showing;
    }
    const ViewedTexture& viewed = *shown.viewed;
    if (viewed.missing == ViewedTexture::Missing::layer) {
        showing.words = "There is no such layer.";
        return showing;
    }
    showing.main = imageOf(viewed, requested.view);
    ShownImage& main = *showing.main;
    if (requested.document.other) main.source = requested.seen() == 0 ? "A" : "B";
    noteAge(main, requested, shown);
    main.takesOverlay = main.content.space == TextureSpace::eye && main.regions.empty();
    addCompared(showing, requested, result, reference);
    return showing;
}

}  // namespace kaustik::gui
