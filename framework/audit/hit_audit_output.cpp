// SPDX-License-Identifier: MIT
// The photon audit as JSON and as a picture.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/audit/hit_audit.h"
#include "framework/core/json_schema.h"

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

template <class F>
void reflect(F& f, const HitAudit& audit) {
    f.field("photons", audit.photons, "That were traced");
    f.field("exact_hits", audit.exactHits, "Of them those that have an exact first hit");
    f.field("visible", audit.visible, "Of them those whose exact first hit the screen shows");
    f.field("right", audit.right, "Photons with the right fate");
    f.field("right_visible", audit.rightVisible, "Of those that are visible");
    f.field("through_specular", audit.throughSpecular,
            "Photons that were taken straight through a specular surface, to what lies beyond it");
    f.field("nan", audit.notANumber, "Photons that are no numbers");
    f.field("unplaced", audit.unplaced, "Pairs of hits of which one is not before the eye");
    f.field("false_hits", audit.falseHits, "By cause");
    f.field("missed", audit.missed, "By cause");
    f.fieldOrNull("agreement", audit.agreement(), "no photon was traced",
                  "Share of right fates among all photons");
    f.fieldOrNull("agreement_visible", audit.agreementVisible(),
                  "the screen shows no photon's exact first hit", "Among those that are visible");
    f.fieldOrNull("agreement_reachable", audit.agreementReachable(),
                  "the tracer can find no photon's exact first hit",
                  "Among those whose exact first hit the tracer can find");
    const auto quantiles = [&](const std::array<const char*, 4>& keys,
                               const std::optional<Quantiles>& of, const char* sentence) {
        const auto quantile = [&](const char* key, double Quantiles::*part) {
            f.fieldOrNull(key, of ? std::optional((*of).*part) : std::nullopt,
                          "no photon has both a hit and an exact one", sentence);
        };
        quantile(keys[0], &Quantiles::median);
        quantile(keys[1], &Quantiles::percentile95);
        quantile(keys[2], &Quantiles::percentile99);
        quantile(keys[3], &Quantiles::maximum);
    };
    quantiles({"median_m", "p95_m", "p99_m", "max_m"}, audit.meters, "From the exact hit");
    quantiles({"median_px", "p95_px", "p99_px", "max_px"}, audit.pixels,
              "From the exact hit on the screen");
}

nlohmann::json toJson(const HitAudit& audit) {
    return jsonOf(audit);
}

nlohmann::json hitsSchema() {
    return jsonSchemaOf<HitAudit>();
}

Image wrongPhotonsPicture(const HitAudit& audit, const Image& display, int samplesPerSide) {
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
        const glm::dvec2 pixel = glm::floor(photon.pixel / static_cast<double>(samplesPerSide));
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
