// SPDX-License-Identifier: MIT
// A picture held against a certificate: a pixel outside of its interval is proved wrong.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "framework/certify/certificate.h"
#include "framework/image/image.h"

namespace kaustik::certify {

struct Verdict {
    std::size_t pixels = 0;  // lit or not, of which some channel is outside
    std::size_t below = 0;   // proved too dark, whatever further paths bring
    std::size_t above = 0;   // proved too bright
    // Too bright for the certified paths; light of longer ones may be the cause.
    std::size_t aboveCertifiedPaths = 0;
    std::size_t undecided = 0;  // lit and inside of an interval wider than a fifth
    double meanLow = 0.0;       // W/m², of all pixels and channels: between these the mean lies
    double meanHigh = 0.0;
    double mean = 0.0;  // of the picture
};

// `irradiance`: RGB, W/m². Throws ConfigError for a picture of another size.
[[nodiscard]] Verdict judge(const Image& irradiance, const Certificate& certificate);
[[nodiscard]] nlohmann::json toJson(const Verdict& verdict);
// Grey: inside; blue: proved too dark; red: proved too bright; orange: too bright for the certified
// paths; green: inside of an interval that decides little. RGB, encoded for a display.
[[nodiscard]] Image verdictPicture(const Image& irradiance, const Certificate& certificate);

}  // namespace kaustik::certify
