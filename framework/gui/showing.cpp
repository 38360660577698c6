// SPDX-License-Identifier: MIT
#include "framework/gui/showing.h"

#include <fmt/format.h>

#include <cmath>

#include "framework/gui/kept_variant.h"

namespace kaustik::gui {
namespace {

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
    image.origin = viewed.origin;
    image.histogram = histogramFor(*viewed.histograms, viewed.values, image.content, image.look);
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
    if (reference.aim) {
        PictureOrigin of{reference.aim->scene, {}, reference.aim->size};
        of.variant.technique.clear();
        image.origin = std::make_shared<const PictureOrigin>(std::move(of));
    }
    image.content = contentOf(image.resource, {});
    image.content.channels.resize(3);
    image.place = describe(TextureSpace::eye);
    image.note = noteOf(reference);
    image.values = reference.irradiance.get();
    image.owner = reference.irradiance;
    image.version = 2 * reference.version;
    image.look = requested.view.lookOf(image.resource);
    image.histogram = histogramFor(*reference.histograms, *image.values, image.content, image.look);
    image.mapping = mappingOf(image.look, image.content, image.histogram, false);
    // Both sides of a split have one scale.
    if (main != nullptr && main->resource == image.resource) image.mapping = main->mapping;
    return image;
}

// `origin`: of the newest frame.
ShownImage ofError(const ShownRequest& requested, const ReferenceState& reference,
                   const ReferenceState::Judgement& judgement, std::uint64_t order,
                   const std::shared_ptr<const PictureOrigin>& origin) {
    ShownImage image;
    image.resource = kErrorResource;
    image.source = "error";
    image.content.quantity = "caustic irradiance less the reference's, mean of the channels";
    image.content.kind = ValueKind::single;
    image.content.space = TextureSpace::eye;
    image.content.channels = {{"error", "W/m²"}};
    image.place = describe(TextureSpace::eye);
    image.note = noteOf(reference);
    if (judgement.order != order) {
        image.age = "of a frame before this one";
    } else {
        image.origin = origin;
    }
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
    image.origin = main.origin;
    image.originOfSubtrahend = other.origin;
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
        case ComparedImage::error: {
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
            const auto& viewed = result.variants[requested.seen()].viewed;
            return ofError(requested, reference, judgement, result.order,
                           viewed ? viewed->origin : nullptr);
        }
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
        showing.words = std::string(isToCome ? "The first picture is being rendered …"
                                             : "There is nothing to show.");
        return showing;
    }
    const ViewedTexture& viewed = *shown.viewed;
    if (viewed.missing == ViewedTexture::Missing::layer) {
        showing.words = "There is no such layer.";
        return showing;
    }
    showing.main = imageOf(viewed, requested.view);
    ShownImage& main = *showing.main;
    if (requested.document.other) main.source = std::string(1, requested.seen() == 0 ? 'A' : 'B');
    noteAge(main, requested, shown);
    main.takesOverlay = main.content.space == TextureSpace::eye && main.regions.empty();
    addCompared(showing, requested, result, reference);
    return showing;
}

}  // namespace kaustik::gui
