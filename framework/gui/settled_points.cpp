// SPDX-License-Identifier: MIT
#include "framework/gui/settled_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "framework/gui/medians.h"
#include "framework/gui/showing.h"

namespace kaustik::gui {

std::optional<double> SettledPoint::error(const std::string& measure) const {
    const auto found = errors.find(measure);
    if (found == errors.end() || !found->is_number()) return {};
    const auto value = found->get<double>();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<SettledPoint> settledPoint(const FrameResult& result, std::size_t variant,
                                         const ReferenceState& reference, bool isPrecise) {
    const VariantResult& shown = result.variants[variant];
    if (variant == 1 && !result.document.other) return {};
    if (!shown.isSettled || shown.isPreview || !shown.error.empty() || shown.frameMs.empty())
        return {};
    const ReferenceState::Judgement& judgement = reference.judgements[variant];
    if (judgement.order != result.order || !hasSameView(reference, result.document)) return {};
    if (!judgement.whole.is_object() || !judgement.whole.contains("caustic_irradiance") ||
        !judgement.whole.at("caustic_irradiance").is_object()) {
        return {};
    }
    SettledPoint point;
    point.document = result.document;
    if (variant == 1) point.document.variant = *result.document.other;
    point.document.other.reset();
    point.isPrecise = isPrecise;
    point.frameMs = settledMedianOf(shown.frameMs);
    point.errors = judgement.whole.at("caustic_irradiance");
    point.photons = reference.photons;
    point.reference = noteOf(reference);
    return point;
}

void addPoint(std::vector<SettledPoint>& points, SettledPoint point) {
    const auto same = std::find_if(points.begin(), points.end(), [&](const SettledPoint& other) {
        return other.document == point.document && areComparable(other, point);
    });
    if (same != points.end()) {
        *same = std::move(point);
        return;
    }
    if (points.size() >= kMaxPoints) points.erase(points.begin());
    points.push_back(std::move(point));
}

bool areComparable(const SettledPoint& a, const SettledPoint& b) {
    return a.document.scene == b.document.scene && a.document.edits == b.document.edits &&
           a.document.size == b.document.size && a.isPrecise == b.isPrecise &&
           a.photons == b.photons;
}

std::vector<std::size_t> paretoFront(const std::vector<TimeAndError>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].milliseconds != points[b].milliseconds
                   ? points[a].milliseconds < points[b].milliseconds
                   : points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t index : order) {
        if (!(points[index].error < least)) continue;
        least = points[index].error;
        front.push_back(index);
    }
    return front;
}

}  // namespace kaustik::gui
