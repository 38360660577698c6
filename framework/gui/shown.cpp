// SPDX-License-Identifier: MIT
#include "framework/gui/shown.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/gui/kept_variant.h"
#include "framework/gui/showing.h"

namespace kaustik::gui {
namespace {

using Missing = ViewedTexture::Missing;

std::size_t variantsOf(const Document& document) {
    return document.other ? 2 : 1;
}

// "A: " where there are two.
std::string prefixOf(const Document& document, std::size_t variant) {
    if (!document.other) return "";
    return variant == 0 ? "A: " : "B: ";
}

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

Shown stale(const std::string& reason, Shown::Remedy remedy) {
    return {Shown::Kind::stale, "Not what was asked for: " + oneLine(reason), remedy};
}

bool hasSettings(const Document& document) {
    const auto has = [](const Variant& variant) {
        return !variant.assignments.empty() || !variant.disabled.empty();
    };
    return has(document.variant) || (document.other && has(*document.other));
}

Shown problemStatus(const ShownRequest& requested, const FrameResult& result,
                    const std::optional<Document>& whole) {
    if (result.isLost) {
        return stale(result.problem + " 'kaustik run' renders without this window.",
                     Shown::Remedy::restart);
    }
    const std::string& scene = requested.document.scene;
    if (whole && whole->scene != scene) return stale(result.problem, Shown::Remedy::back);
    const bool isDefault = scene == Document().scene;  // whose mesh may be missing
    return stale(result.problem, isDefault ? Shown::Remedy::none : Shown::Remedy::defaultScene);
}

Shown ofError(const ShownRequest& requested, const std::string& error,
              const std::optional<Document>& whole) {
    if (whole && !(*whole == requested.document)) return stale(error, Shown::Remedy::back);
    return stale(error,
                 hasSettings(requested.document) ? Shown::Remedy::forget : Shown::Remedy::none);
}

Shown missingStatus(const ShownRequest& requested, const ViewedTexture& viewed,
                    const std::string& prefix) {
    if (viewed.missing == Missing::texture) {
        return stale(fmt::format("{}there is no texture '{}' with these settings; the picture is "
                                 "shown in its place.",
                                 prefix, requested.view.resource),
                     Shown::Remedy::picture);
    }
    return stale(fmt::format("{}'{}' has no layer {}: it has {}, which are 0 to {}.", prefix,
                             viewed.name, viewed.layer, viewed.layers, viewed.layers - 1),
                 Shown::Remedy::layer);
}

// What is seen until something newer is rendered.
Shown staleStatus(const FrameResult& result) {
    const VariantResult& first = result.variants[0];
    if (!first.viewed) return {Shown::Kind::rendering, "The first picture is being rendered.", {}};
    if (first.isPreview) {
        return {Shown::Kind::preview,
                "A quick picture of half the size and without caustics, until a whole one is "
                "rendered.",
                {}};
    }
    return {Shown::Kind::rendering,
            "What is shown is from before the last change, which is being rendered.",
            {}};
}

// What the technique says of the picture by itself: what it cannot form, joins or leaves out.
std::vector<std::string> reservationsOf(const VariantResult& variant) {
    std::vector<std::string> all = variant.violations;
    all.insert(all.end(), variant.warnings.begin(), variant.warnings.end());
    for (const ReachedLimit& limit : variant.limits) {
        all.push_back(fmt::format("Limit reached: {} = {:g}; {}.", limit.parameter, limit.value,
                                  limit.sentence));
    }
    return all;
}

}  // namespace

bool hasSameView(const ReferenceState& reference, const Document& document) {
    return reference.aim && reference.aim->scene == document.scene &&
           reference.aim->edits == document.edits && reference.aim->size == document.size;
}

std::string runObstacle(const ShownRequest& requested, const FrameResult& result) {
    if (!result.problem.empty()) return result.problem;
    for (std::size_t i = 0; i < variantsOf(requested.document); ++i) {
        const VariantResult& variant = result.variants[i];
        if (variant.order >= requested.order && !variant.error.empty())
            return prefixOf(requested.document, i) + variant.error;
    }
    return result.shaderProblem;
}

bool isRendered(const ShownRequest& requested, const FrameResult& result) {
    if (!result.problem.empty() || !(result.document == requested.document)) return false;
    for (std::size_t i = 0; i < variantsOf(requested.document); ++i) {
        const VariantResult& variant = result.variants[i];
        if (variant.order < requested.order || !variant.error.empty() || variant.isPreview ||
            !variant.absentPasses.empty() || !variant.viewed) {
            return false;
        }
    }
    return true;
}

Shown shownOf(const ShownRequest& requested, const FrameResult& result,
              const ReferenceState& reference, const std::optional<Document>& whole) {
    const KeptVariant* kept = requested.flipped();
    if (kept != nullptr && kept->texture(requested.view.resource) == nullptr) {
        Shown shown;
        shown.kind = Shown::Kind::stale;
        shown.remedy = Shown::Remedy::picture;
        shown.sentence =
            fmt::format("Variant {} was kept without {}. Key {} leads back to the newest frame.",
                        requested.view.flipped + 1,
                        requested.view.resource.empty() ? "its picture" : requested.view.resource,
                        requested.view.flipped + 1);
        return shown;
    }
    if (kept != nullptr) {
        Shown shown;
        shown.sentence = fmt::format(
            "Kept variant {} is shown as it was rendered: {}. Key {} leads back to the newest "
            "frame.",
            requested.view.flipped + 1, kept->name, requested.view.flipped + 1);
        shown.reservations = kept->reservations;
        if (!shown.reservations.empty()) shown.kind = Shown::Kind::limited;
        return shown;
    }
    const Shown rendering = staleStatus(result);
    // A lost device answers no order.
    if (result.order < requested.order && !result.isLost) return rendering;
    if (!result.problem.empty()) return problemStatus(requested, result, whole);
    for (std::size_t i = 0; i < variantsOf(requested.document); ++i) {
        const VariantResult& variant = result.variants[i];
        const std::string prefix = prefixOf(requested.document, i);
        if (variant.order >= requested.order && !variant.error.empty())
            return ofError(requested, prefix + variant.error, whole);
    }
    for (std::size_t i = 0; i < variantsOf(requested.document); ++i) {
        const VariantResult& variant = result.variants[i];
        if (variant.isPreview || variant.order < requested.order || !variant.viewed)
            return rendering;
        if (variant.viewed->missing != Missing::none)
            return missingStatus(requested, *variant.viewed, prefixOf(requested.document, i));
    }
    if (!result.shaderProblem.empty()) {
        return stale(
            "the last good shaders are in use, until this is mended: " + result.shaderProblem,
            Shown::Remedy::none);
    }
    Shown shown;
    for (std::size_t i = 0; i < variantsOf(requested.document); ++i) {
        const VariantResult& variant = result.variants[i];
        for (const std::string& reservation : reservationsOf(variant))
            shown.reservations.push_back(prefixOf(requested.document, i) + reservation);
        if (variant.violations.empty() || shown.kind == Shown::Kind::impossible) continue;
        shown.kind = Shown::Kind::impossible;
        shown.sentence = prefixOf(requested.document, i) + variant.violations.front();
    }
    if (shown.kind == Shown::Kind::impossible) return shown;
    const std::string missing = showingOf(requested, result, reference).comparedProblem;
    shown.sentence = missing.empty()
                         ? "What is shown is what was asked for."
                         : fmt::format("The picture is what was asked for; {}.", missing);
    if (!shown.reservations.empty()) {
        shown.kind = Shown::Kind::limited;
        shown.sentence =
            fmt::format("What is shown is what was asked for, with {}: {}",
                        shown.reservations.size() == 1
                            ? "a reservation"
                            : fmt::format("{} reservations", shown.reservations.size()),
                        oneLine(shown.reservations.front()));
        if (!missing.empty()) shown.sentence += fmt::format(" And {}.", missing);
    }
    return shown;
}

const char* nameOf(Shown::Kind kind) {
    switch (kind) {
        case Shown::Kind::requested:
            return "asked";
        case Shown::Kind::rendering:
            return "rendering";
        case Shown::Kind::preview:
            return "preview";
        case Shown::Kind::limited:
            return "limited";
        case Shown::Kind::impossible:
            return "impossible";
        case Shown::Kind::stale:
            break;
    }
    return "stale";
}

std::string labelOf(Shown::Remedy remedy) {
    switch (remedy) {
        case Shown::Remedy::back:
            return "Back to what is shown";
        case Shown::Remedy::forget:
            return "Forget all settings";
        case Shown::Remedy::defaultScene:
            return "Open the default scene";
        case Shown::Remedy::picture:
            return "Show the picture";
        case Shown::Remedy::layer:
            return "Show the last layer";
        case Shown::Remedy::restart:
            return "Start the renderer again";
        case Shown::Remedy::none:
            break;
    }
    return "";
}

}  // namespace kaustik::gui
