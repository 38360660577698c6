// SPDX-License-Identifier: MIT
// Certificates as the commands make them: with progress, stopped by Ctrl-C without loss.
#pragma once

#include <filesystem>

#include "framework/certify/certificate.h"

namespace kaustik::app {

// A whole part, with its progress on standard error, kept in `keep` on the way. Throws Error when
// interrupted; the next call goes on from there.
[[nodiscard]] certify::CertificatePart certifyWithProgress(
    const scene::Scene& scene, const certify::CertificateRequest& request, const Shard& shard,
    int threads, const std::filesystem::path& keep);

}  // namespace kaustik::app
