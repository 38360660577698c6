// SPDX-License-Identifier: MIT
// Lists of photons and their hits as the processor reads them back: for whoever judges, probes or
// shows them. Eye view space, m, W. All of it waits for the device. After a frame what is read must
// have been asked for (graph::Graph::request); within a pass, be declared by it (texelsOf).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/pipeline/renderer.h"

namespace kaustik {

// A word of a texel (a fate, a material, media) that is none.
inline constexpr std::uint32_t kNoWord = ~0u;

// A photon as it is read back: the fields of transport::Photon and transport::Hit.
struct PhotonTexel {
    glm::vec3 position{0.0f};
    float footprintMeters = 0.0f;
    glm::vec3 direction{0.0f};
    std::uint32_t fate = transport::kFateNone;
    glm::vec3 fluxWatts{0.0f};
    std::uint32_t media = 0;
    transport::PhotonOrigin origin{};
};
struct HitTexel {
    glm::vec3 position{0.0f};
    float distanceMeters = 0.0f;
    glm::vec3 normal{0.0f};
    std::uint32_t material = 0;  // index + 1
    glm::vec3 fluxWatts{0.0f};
    std::uint32_t fate = transport::kFateNone;
    [[nodiscard]] bool isHit() const {
        return fate == transport::kFateReceiver || fate == transport::kFateSpecular;
    }
};

// The photons in the order of the list.
[[nodiscard]] std::vector<PhotonTexel> readPhotons(const Renderer& renderer,
                                                   const Photons& photons);
[[nodiscard]] std::vector<PhotonTexel> readPhotons(const gl::PassContext& context,
                                                   const Photons& photons);
[[nodiscard]] std::vector<HitTexel> readHits(const Renderer& renderer, const Hits& hits);
[[nodiscard]] std::vector<HitTexel> readHits(const gl::PassContext& context, const Hits& hits);

// All that both read of hits and their photons.
[[nodiscard]] std::vector<graph::ResourceRef> texelsOf(const Hits& hits);

}  // namespace kaustik
