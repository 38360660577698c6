// SPDX-License-Identifier: MIT
// How wrong the rays are that a node of the stage `view` follows: where and in which direction each
// leaves the specular surfaces, next to the exact path through the same pixel's middle.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "framework/image/image.h"
#include "framework/reference/view_reference.h"
#include "framework/render/view.h"

namespace kaustik::audit {

// Sorted; of pixels whose exact ray came out and whose ray under test did too.
struct ExitErrors {
    std::vector<double> directionDegrees;
    std::vector<double> positionMeters;
    std::vector<double> positionPixels;  // on the screen
};

struct ViewAudit {
    std::size_t pixels = 0;           // whose middle sees a specular surface
    std::size_t interfacesRight = 0;  // of these: as many specular surfaces hit
    std::size_t lost = 0;             // of these: the exact ray came out, the other did not
    std::size_t notANumber = 0;
    ExitErrors all;
    ExitErrors sameInterfaces;    // of those alone that hit as many
    double meanInterfaces = 0.0;  // exact
};

// `exitPosition` and `exitDirection`: View's, rows from the top, 4 channels.
[[nodiscard]] ViewAudit auditView(const Image& exitPosition, const Image& exitDirection,
                                  const reference::ViewReference& reference,
                                  const render::RasterView& view);

// The entry of report.json; a number that does not exist is null.
[[nodiscard]] nlohmann::json toJson(const ViewAudit& audit);
[[nodiscard]] nlohmann::json viewSchema();

}  // namespace kaustik::audit
