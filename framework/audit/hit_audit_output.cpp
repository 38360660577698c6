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
    nlohmann::json result = {{"photons", audit.photons},
                             {"exact_hits", audit.exactHits},
                             {"visible", audit.visible},
                             {"right", audit.right},
                             {"right_visible", audit.rightVisible},
                             {"nan", audit.notANumber},
                             {"unplaced", audit.unplaced},
                             {"false_hits", audit.falseHits},
                             {"missed", audit.missed}};
    const auto set = [&](const std::string& key, const std::optional<double>& value,
                         const char* reason) {
        result[key] = value ? nlohmann::json(*value) : nlohmann::json();
        if (!value) result["reasons"][key] = reason;
    };
    set("agreement", audit.agreement(), "no photon was traced");
    set("agreement_visible", audit.agreementVisible(),
        "the screen shows no photon's exact first hit");
    set("agreement_reachable", audit.agreementReachable(),
        "the tracer can find no photon's exact first hit");
    const auto setAll = [&](const std::string& unit, const std::optional<Quantiles>& of) {
        const auto value = [&](double Quantiles::*part) {
            return of ? std::optional<double>((*of).*part) : std::nullopt;
        };
        const char* const reason = "no photon has both a hit and an exact one";
        set("median_" + unit, value(&Quantiles::median), reason);
        set("p95_" + unit, value(&Quantiles::percentile95), reason);
        set("p99_" + unit, value(&Quantiles::percentile99), reason);
        set("max_" + unit, value(&Quantiles::maximum), reason);
    };
    setAll("m", audit.meters);
    setAll("px", audit.pixels);
    return result;
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
