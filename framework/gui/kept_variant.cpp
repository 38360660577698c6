// SPDX-License-Identifier: MIT
#include "framework/gui/kept_variant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"
#include "framework/gui/medians.h"
#include "framework/gui/showing.h"
#include "framework/measure/image_errors.h"

namespace kaustik::gui {

std::string settingsText(const Variant& variant) {
    std::string name = variant.technique + (variant.isAsPublished ? " as published" : "");
    for (const auto& [parameter, value] : variant.assignments)
        name += fmt::format(", {}={}", parameter, value);
    for (const std::string& pass : variant.disabled)
        name += fmt::format(", without {}", pass);
    return name;
}

std::shared_ptr<const ViewedTexture> KeptVariant::texture(const std::string& resource) const {
    const auto found = std::find_if(textures.begin(), textures.end(),
                                    [&](const auto& one) { return one->name == resource; });
    return found == textures.end() ? nullptr : *found;
}

std::optional<KeptVariant> keep(const FrameResult& result, std::size_t variant,
                                const ReferenceState& reference, std::string& problem) {
    const VariantResult& shown = result.variants[variant];
    if (!shown.isSettled || !shown.viewed || shown.isPreview || !shown.error.empty()) {
        problem = "A variant is kept once its frames have settled.";
        return {};
    }
    KeptVariant kept;
    const Variant& settings =
        variant == 1 && result.document.other ? *result.document.other : result.document.variant;
    kept.name = settingsText(settings);
    kept.document = result.document;
    kept.document.variant = settings;
    kept.document.other.reset();
    for (const auto& texture : shown.outputTextures)
        kept.textures.push_back(texture);
    if (shown.viewed->missing == ViewedTexture::Missing::none &&
        kept.texture(shown.viewed->name) == nullptr) {
        kept.textures.push_back(std::make_shared<const ViewedTexture>(*shown.viewed));
    }
    kept.frameMs = settledMedianOf(shown.frameMs);
    kept.passes = passTable(shown);
    kept.reservations = shown.violations;
    kept.reservations.insert(kept.reservations.end(), shown.warnings.begin(), shown.warnings.end());
    const ReferenceState::Judgement& judgement = reference.judgements[variant];
    if (judgement.order == result.order && hasSameView(reference, result.document)) {
        kept.judgement = judgement;
        kept.reference = noteOf(reference);
    }
    for (const auto& texture : kept.textures)
        kept.bytes += texture->values.values.size() * sizeof(float);
    return kept;
}

std::string whyNoRoom(const std::vector<KeptVariant>& kept, const KeptVariant& more) {
    if (kept.size() >= kMaxKept) {
        return fmt::format(
            "{} variants are kept, which is all that there are keys for; forget one "
            "first.",
            kMaxKept);
    }
    std::size_t bytes = more.bytes;
    for (const KeptVariant& one : kept)
        bytes += one.bytes;
    if (bytes > kMaxKeptBytes) {
        return fmt::format(
            "Kept variants would take {} MiB, and have {} MiB at most; forget one "
            "first.",
            bytes >> 20u, kMaxKeptBytes >> 20u);
    }
    return "";
}

Image colorsOf(const Image& image) {
    const int channels = image.channels >= 3 ? 3 : 1;
    Image colors(image.width, image.height, channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < channels; ++c)
                colors.at(x, y, c) = image.at(x, y, c);
        }
    }
    return colors;
}

ImageDifference differenceBetween(const Image& a, const Image& b) {
    ImageDifference difference;
    if (a.width != b.width || a.height != b.height || a.channels != b.channels) {
        difference.problem = fmt::format("one has {}×{} pixels, the other {}×{}", a.width, a.height,
                                         b.width, b.height);
        return difference;
    }
    const Image first = colorsOf(a);
    const Image second = colorsOf(b);
    Image mean(a.width, a.height, 1);
    const auto channels = static_cast<std::size_t>(first.channels);
    double squares = 0.0;
    for (std::size_t pixel = 0; pixel < mean.values.size(); ++pixel) {
        double sum = 0.0;
        for (std::size_t c = 0; c < channels; ++c) {
            const double one = static_cast<double>(first.values[channels * pixel + c]) -
                               static_cast<double>(second.values[channels * pixel + c]);
            sum += one;
            squares += one * one;
        }
        mean.values[pixel] = static_cast<float>(sum / static_cast<double>(channels));
    }
    difference.rmse = std::sqrt(squares / static_cast<double>(first.values.size()));
    difference.histogram = histogramOf(mean);
    difference.signedMean = std::make_shared<const Image>(std::move(mean));
    try {
        const measure::ImagePair pair({.image = first, .reference = second});
        difference.flip = measure::measureErrors(pair).flipLdr;
    } catch (const Error& error) {
        difference.problem = error.what();
    }
    return difference;
}

}  // namespace kaustik::gui
