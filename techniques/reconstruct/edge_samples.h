// SPDX-License-Identifier: MIT
// What pixels show of which more than one surface is seen: a receiver at each of four places of
// theirs, by exact rays (Embree's where the device renders on the processor). The middle alone
// leaves a pixel's part of a thin thing, or of what lies behind an edge, to its neighbours.
#pragma once

#include <glm/glm.hpp>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct EdgeReceiver {  // xy: as ReceiverTexel; z: the pixel's number among those at an edge + 1; 0:
                       // it is at none
    static constexpr graph::Format format = graph::Format::rgba32f;
};
struct EdgeSample {  // x: view depth in m, negative of a mirror, 0 none; y: area that the pixel
                     // would see of that surface, m²; zw: its outward shading normal, octahedral
    static constexpr graph::Format format = graph::Format::rgba32f;
};

// What the processor has found at a place of a pixel (two texels).
struct SeenAtPlace {
    glm::vec3 shading{0.0f};  // unit, outward, view space
    float depth = 0.0f;       // view depth, m, negative of a mirror; 0: there is none
    glm::vec3 geometric{0.0f};
    float unused = 0.0f;
};

struct EdgeSamples {
    graph::Texture<EdgeReceiver> receiver;  // as large as the picture
    // kEdgeSamples a pixel, in the order of their numbers, in rows
    // (include/views/edge_places.glsl).
    graph::Texture<EdgeSample> samples;
    [[nodiscard]] bool valid() const { return receiver.valid(); }
};

// Of the eye's receivers; made once a frame.
[[nodiscard]] EdgeSamples edgeSamplesOf(FrameBuilder& frame, const Geometry& geometry,
                                        const ReceiverView& eye);

}  // namespace kaustik
