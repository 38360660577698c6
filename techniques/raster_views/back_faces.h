// SPDX-License-Identifier: MIT
// The farthest back faces of the transmitting objects in some view, for whoever asks where a ray
// leaves them (include/views/two_interfaces.glsl; W05).
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct BackFaces {
    graph::Texture<ViewDepth> depth;
    graph::Texture<SurfaceTexel> surface;
    graph::Texture<HitShape> shape;  // in the view's space; where it was asked for
    Views views;                     // one
    // "backDepth", "backSurface", "backShape".
    void sample(graph::PassSetup& setup) const;
};

// Why there are no back faces to be drawn, for a condition.
[[nodiscard]] inline std::string whyNoBodies(const FrameFacts& facts) {
    const bool mayHaveBodies = facts.needs == nullptr || facts.needs->closedDielectrics;
    return mayHaveBodies ? "" : "no dielectric of the scene has an inside";
}

// Why nothing is refracted, for a condition.
[[nodiscard]] inline std::string whyNoDielectric(const FrameFacts& facts) {
    const bool mayRefract = facts.needs == nullptr || facts.needs->refractors > 0;
    return mayRefract ? "" : "the scene has no dielectric";
}

// Why no ray goes from one body to another, for a condition.
[[nodiscard]] inline std::string whyNoOtherBody(const FrameFacts& facts) {
    const bool mayBeSeveral = facts.needs == nullptr || facts.needs->refractors > 1;
    return mayBeSeveral ? whyNoBodies(facts) : "the scene has no more than one body";
}

// How far a refracted ray goes inside, as include/views/two_interfaces.glsl has it.
enum class DistanceInside : int { estimates, search };
template <class R>
void reflectDistance(R& r, DistanceInside& distance, int& steps) {
    r.choice(
         distance, "distance",
         "How far a refracted ray goes inside. search: to where it meets the back faces itself; "
         "estimates: between what the unrefracted ray and the inverse normal have before them "
         "(W05), which takes 15.6 % of a ball's light for totally reflected, where none is",
         {"estimates", "search"})
        .when(&whyNoBodies);
    r.field(steps, "steps",
            "Looks at the back faces for that, each 1.6 times as far as the one before; 0: what "
            "the unrefracted ray has before it",
            "", params::range(0, 64))
        .when(&whyNoBodies);
}

// Where light is booked that comes out totally reflected: in balls physics has none, and it is the
// estimates that lose it.
[[nodiscard]] inline unsigned totalReflectionAccount(const FrameBuilder& frame,
                                                     DistanceInside distance) {
    const bool isFalse =
        distance == DistanceInside::estimates && scene::hasBallsAlone(frame.scene());
    return isFalse ? transport::kAccountAsPublished : transport::kAccountInternalReflectionLimit;
}

// What the pass is called, and the names of its textures begin with.
struct BackFacesPass {
    std::string name;
    std::string reason;
    std::string prefix;
    bool hasShape = false;  // how their normals turn
};
[[nodiscard]] BackFaces drawBackFaces(FrameBuilder& frame, const Geometry& geometry,
                                      const Views& views, const BackFacesPass& pass);

}  // namespace kaustik
