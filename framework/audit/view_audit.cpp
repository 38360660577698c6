// SPDX-License-Identifier: MIT
#include "framework/audit/view_audit.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "framework/core/json_schema.h"

namespace kaustik::audit {
namespace {

using nlohmann::json;

glm::dvec3 vectorAt(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

// Pixels from the middle of the picture; a point next to the eye is as far as can be.
glm::dvec2 onScreen(const render::RasterView& view, const glm::dvec3& position) {
    const double depth = std::max(-position.z, view.nearMeters);
    return glm::dvec2(position) / (depth * view.footprintPerMeter());
}

void add(ExitErrors& errors, double degrees, double meters, double pixels) {
    errors.directionDegrees.push_back(degrees);
    errors.positionMeters.push_back(meters);
    errors.positionPixels.push_back(pixels);
}

void sort(ExitErrors& errors) {
    for (std::vector<double>* values :
         {&errors.directionDegrees, &errors.positionMeters, &errors.positionPixels}) {
        std::sort(values->begin(), values->end());
    }
}

}  // namespace

ViewAudit auditView(const Image& exitPosition, const Image& exitDirection,
                    const reference::ViewReference& reference, const render::RasterView& view) {
    ViewAudit audit;
    double interfaces = 0.0;
    for (int y = 0; y < reference.mask.height; ++y) {
        for (int x = 0; x < reference.mask.width; ++x) {
            if (reference.mask.at(x, y, 0) == 0.0f) continue;
            ++audit.pixels;
            const float exactCount = reference.exitPosition.at(x, y, 3);
            interfaces += static_cast<double>(exactCount);
            const bool isSame = exitPosition.at(x, y, 3) == exactCount;
            if (isSame) ++audit.interfacesRight;
            if (reference.exitDirection.at(x, y, 3) == 0.0f) continue;
            const glm::dvec3 position = vectorAt(exitPosition, x, y);
            const glm::dvec3 direction = vectorAt(exitDirection, x, y);
            const double length = glm::length(direction);
            if (!std::isfinite(length + position.x + position.y + position.z)) {
                ++audit.notANumber;
                continue;
            }
            if (exitDirection.at(x, y, 3) <= transport::kPathLost || length == 0.0) {
                ++audit.lost;
                continue;
            }
            const glm::dvec3 exactPosition = vectorAt(reference.exitPosition, x, y);
            const glm::dvec3 exactDirection = vectorAt(reference.exitDirection, x, y);
            const glm::dvec3 unit = direction / length;
            // By sine and cosine: exact for small angles and for large ones.
            const double degrees = glm::degrees(std::atan2(
                glm::length(glm::cross(unit, exactDirection)), glm::dot(unit, exactDirection)));
            const double meters = glm::distance(position, exactPosition);
            const double pixels =
                glm::distance(onScreen(view, position), onScreen(view, exactPosition));
            add(audit.all, degrees, meters, pixels);
            if (isSame) add(audit.sameInterfaces, degrees, meters, pixels);
        }
    }
    if (audit.pixels > 0) audit.meanInterfaces = interfaces / static_cast<double>(audit.pixels);
    sort(audit.all);
    sort(audit.sameInterfaces);
    return audit;
}

struct QuantilesTable {
    std::optional<double> median;
    std::optional<double> percentile95;
    std::optional<double> percentile99;
};
template <class F>
void reflect(F& f, const QuantilesTable& table) {
    f.fieldOrNull("median", table.median, "", "");
    f.fieldOrNull("p95", table.percentile95, "", "95th percentile");
    f.fieldOrNull("p99", table.percentile99, "", "99th percentile");
}
QuantilesTable quantiles(const std::vector<double>& sorted) {
    if (sorted.empty()) return {};
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(sorted.size() - 1);
        return sorted[static_cast<std::size_t>(std::lround(place))];
    };
    return {at(0.5), at(0.95), at(0.99)};
}

template <class F>
void reflectExits(F& f, const ExitErrors& errors, const char* pixelsKey) {
    f.field(pixelsKey, errors.directionDegrees.size(), "Whose rays came out on both sides");
    f.field("exit_direction_deg", quantiles(errors.directionDegrees),
            "Between the exact direction and the one under test");
    f.field("exit_position_m", quantiles(errors.positionMeters), "Between both places");
    f.field("exit_position_px", quantiles(errors.positionPixels), "The same on the screen");
}
template <class F>
void reflect(F& f, const ExitErrors& errors) {
    reflectExits(f, errors, "pixels");
}

template <class F>
void reflect(F& f, const ViewAudit& audit) {
    const auto share = [&](const char* key, std::size_t count, const char* sentence) {
        const double of = static_cast<double>(audit.pixels);
        f.fieldOrNull(
            key, audit.pixels > 0 ? std::optional(static_cast<double>(count) / of) : std::nullopt,
            "", sentence);
    };
    f.field("pixels", audit.pixels, "Whose middle sees a specular surface");
    reflectExits(f, audit.all, "pixels_compared");
    share("interfaces_right", audit.interfacesRight, "Of them: as many surfaces hit");
    share("lost", audit.lost, "Of them: the exact ray came out, the other did not");
    f.field("not_a_number", audit.notANumber, "Pixels with such a place or direction");
    f.field("mean_interfaces", audit.meanInterfaces, "Surfaces that the exact ray hits");
    f.field("same_interfaces", audit.sameInterfaces, "Of those alone that hit as many");
}

json toJson(const ViewAudit& audit) {
    return jsonOf(audit);
}

json viewSchema() {
    return jsonSchemaOf<ViewAudit>();
}

}  // namespace kaustik::audit
