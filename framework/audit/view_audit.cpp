// SPDX-License-Identifier: MIT
#include "framework/audit/view_audit.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

namespace kaustik::audit {
namespace {

using nlohmann::json;

glm::dvec3 vectorAt(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

// Pixels from the middle of the picture; a point beside the eye is as far as can be.
glm::dvec2 onScreen(const render::EyeView& view, const glm::dvec3& position) {
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

json quantiles(const std::vector<double>& sorted) {
    const auto at = [&](double share) -> json {
        if (sorted.empty()) return nullptr;
        const double place = share * static_cast<double>(sorted.size() - 1);
        return sorted[static_cast<std::size_t>(std::lround(place))];
    };
    return {{"median", at(0.5)}, {"p95", at(0.95)}, {"p99", at(0.99)}};
}

json toJson(const ExitErrors& errors) {
    return {{"pixels", errors.directionDegrees.size()},
            {"exit_direction_deg", quantiles(errors.directionDegrees)},
            {"exit_position_m", quantiles(errors.positionMeters)},
            {"exit_position_px", quantiles(errors.positionPixels)}};
}

}  // namespace

ViewAudit auditView(const Image& exitPosition, const Image& exitDirection,
                    const reference::ViewReference& reference, const render::EyeView& view) {
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

json toJson(const ViewAudit& audit) {
    const auto share = [&](std::size_t count) -> json {
        if (audit.pixels == 0) return nullptr;
        return static_cast<double>(count) / static_cast<double>(audit.pixels);
    };
    json result = toJson(audit.all);
    result["pixels_compared"] = result.at("pixels");
    result["pixels"] = audit.pixels;
    result["interfaces_right"] = share(audit.interfacesRight);
    result["lost"] = share(audit.lost);
    result["not_a_number"] = audit.notANumber;
    result["mean_interfaces"] = audit.meanInterfaces;
    result["same_interfaces"] = toJson(audit.sameInterfaces);
    return result;
}

}  // namespace kaustik::audit
