// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/judge/judge.h"
#include "framework/judge/primaries.h"

namespace kaustik::judge {

JudgeOptions optionsOf(const NamedOptions& names, const Spelling& spelled) {
    JudgeOptions options;
    if (names.direct == "with") {
        options.direct = DirectLight::with;
    } else if (names.direct == "without") {
        options.direct = DirectLight::without;
    } else if (names.direct != "auto") {
        throw ConfigError(fmt::format("{}: '{}' is neither auto, with nor without.",
                                      spelled("direct"), names.direct));
    }
    if (names.glass == "seen") {
        options.glass = Glass::seen;
    } else if (names.glass == "hidden") {
        options.glass = Glass::hidden;
    } else if (names.glass != "auto") {
        throw ConfigError(fmt::format("{}: '{}' is neither auto, seen nor hidden.",
                                      spelled("glass"), names.glass));
    }
    if (names.encoding == "linear") {
        options.encoding = Encoding::linear;
    } else if (names.encoding == "srgb") {
        options.encoding = Encoding::srgb;
    } else if (names.encoding == "gamma2.2") {
        options.encoding = Encoding::gamma22;
    } else if (names.encoding != "auto") {
        throw ConfigError(fmt::format("{}: '{}' is neither auto, linear, srgb nor gamma2.2.",
                                      spelled("encoding"), names.encoding));
    }
    if (names.primaries != "auto") {
        const auto found =
            std::find_if(kAllPrimaries.begin(), kAllPrimaries.end(),
                         [&](Primaries primaries) { return names.primaries == nameOf(primaries); });
        if (found == kAllPrimaries.end()) {
            throw ConfigError(
                fmt::format("{}: '{}' is neither auto, rec709, rec2020, p3, acescg nor aces2065.",
                            spelled("primaries"), names.primaries));
        }
        options.primaries = *found;
    }
    if (names.exposure && !(*names.exposure > 0.0))
        throw ConfigError(
            fmt::format("{}: {} is not above 0.", spelled("exposure"), *names.exposure));
    options.exposure = names.exposure;
    return options;
}

}  // namespace kaustik::judge
