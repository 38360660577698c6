// SPDX-License-Identifier: MIT
// How many receivers a node of the stage `shadow` takes for lit that are not, or the other way
// round (K06, section 5, Figs. 11 and 12).
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "framework/image/image.h"
#include "framework/reference/embree_scene.h"

namespace kaustik::audit {

// Over all lights, of pixels whose middle sees a receiver that faces the light.
struct ShadowAudit {
    std::size_t tested = 0;
    std::size_t inShadow = 0;  // exactly
    std::size_t falseShadow = 0;
    std::size_t falseLit = 0;
    void add(const ShadowAudit& other);
};

// `visibility`: of the light with this index, rows from the top, 1 channel; above a half is lit.
// The exact answer is a ray from what the pixel's middle sees to the light, which any surface
// blocks.
[[nodiscard]] ShadowAudit auditShadow(const Image& visibility, std::size_t light,
                                      const reference::EmbreeScene& scene);

// The entry of report.json: shares of `tested`, null where nothing was tested.
[[nodiscard]] nlohmann::json toJson(const ShadowAudit& audit);
[[nodiscard]] nlohmann::json shadowSchema();

}  // namespace kaustik::audit
