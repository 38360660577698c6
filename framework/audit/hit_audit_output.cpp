// SPDX-License-Identifier: MIT
// The photon audit as JSON and as a picture.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/audit/hit_audit.h"

namespace kaustik::audit {
namespace {

glm::vec3 colorOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::missed:
            return {0.25f, 0.6f, 1.0f};
        case Verdict::displaced:
            return {1.0f, 0.9f, 0.2f};
        default:
            return {1.0f, 0.35f, 0.1f};
    }
}

}  // namespace

nlohmann::json toJson(const HitAudit& audit) {
    return {{"agreement", audit.agreement()},
            {"agreement_visible", audit.agreementVisible()},
            {"photons", audit.photons},
            {"exact_hits", audit.exactHits},
            {"visible", audit.visible},
            {"right", audit.right},
            {"right_visible", audit.rightVisible},
            {"nan", audit.notANumber},
            {"median_m", audit.meters.median},
            {"p95_m", audit.meters.percentile95},
            {"p99_m", audit.meters.percentile99},
            {"max_m", audit.meters.maximum},
            {"median_px", audit.pixels.median},
            {"p95_px", audit.pixels.percentile95},
            {"p99_px", audit.pixels.percentile99},
            {"max_px", audit.pixels.maximum},
            {"unplaced", audit.unplaced},
            {"false_hits", audit.falseHits},
            {"missed", audit.missed}};
}

Image wrongPhotonsPicture(const HitAudit& audit, const Image& display) {
    constexpr float kDim = 0.3f;
    Image picture(display.width, display.height, 3);
    for (int y = 0; y < display.height; ++y) {
        for (int x = 0; x < display.width; ++x) {
            const float grey =
                (display.at(x, y, 0) + display.at(x, y, 1) + display.at(x, y, 2)) / 3.0f;
            for (int c = 0; c < 3; ++c)
                picture.at(x, y, c) = kDim * grey;
        }
    }
    for (const WrongPhoton& photon : audit.wrong) {
        const glm::dvec2 pixel = glm::floor(photon.pixel);
        if (!(pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < display.width &&
              pixel.y < display.height)) {
            continue;
        }
        const glm::vec3 color = colorOf(photon.verdict);
        for (int c = 0; c < 3; ++c) {
            picture.at(static_cast<int>(pixel.x), display.height - 1 - static_cast<int>(pixel.y),
                       c) = color[c];
        }
    }
    return picture;
}

}  // namespace kaustik::audit
