// SPDX-License-Identifier: MIT
// kaustik run --reference certified: the caustic of a run against proved bounds.
#pragma once

#include <filesystem>

#include "framework/certify/certificate.h"

namespace kaustik::app {

inline constexpr const char* kCertifiedReference = "certified";

// The certificate of the scene's paths of up to two interactions, from the cache or computed and
// kept there, with its progress. Throws Error when interrupted; the next call goes on from there.
[[nodiscard]] certify::Certificate certificateFor(const scene::Scene& scene, int width, int height);

// Judges the folder's caustic irradiance: writes certified.png and certified.json there, and prints
// what is proved.
void judgeByCertificate(const certify::Certificate& certificate,
                        const std::filesystem::path& folder);

}  // namespace kaustik::app
