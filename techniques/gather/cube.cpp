// SPDX-License-Identifier: MIT
// gather.cube: the light cube map of each caustic generator looked up where the eye's receivers
// lie, by their direction from its reference point, with their distance as a shadow test (U08,
// section 4.3). Four texels around count that see the same surface. In: flux a texel of a face, W;
// out: irradiance, W/m², and, where a receiver is glossy, radiance by its BRDF, W/m²/sr.
#include <utility>

#include "techniques/maps/map_needs.h"
#include "techniques/maps/projection.h"

namespace kaustik {
namespace {

enum class Incidence : int { mean, centre };

struct CubeParams {
    int maxSamples = 4;
    Incidence incidence = Incidence::mean;
    template <class R>
    void reflect(R& r) {
        r.field(maxSamples, "max_samples",
                "Most looks at a cube along each side of a pixel that spans several of its texels",
                "", params::range(1, 16));
        r.renamed("places", "max_samples");
        r.choice(incidence, "incidence",
                 "Where light comes from that a glossy receiver reflects. mean: the mean of what "
                 "has arrived in a texel; centre: the reference point",
                 {"mean", "centre"})
            .when([](const FrameFacts& facts) {
                const bool mayBeGlossy = facts.needs == nullptr || facts.needs->glossyReceivers;
                return mayBeGlossy ? "" : "no receiver is glossy";
            });
    }
};

IrradianceMap gatherCubes(FrameBuilder& frame, const CubeParams& params, CausticMap map,
                          Surfaces surfaces) {
    needsMap("gather.cube", map, {SetLayout::one, StoreSpace::cube});
    return projectMaps(frame,
                       {"gather.cube",
                        "the light around each generator is looked up where the "
                        "eye's receivers lie",
                        params.maxSamples, params.incidence == Incidence::centre},
                       std::move(map), surfaces);
}

}  // namespace

void registerGatherCube(Registry& registry) {
    registry.node<GatherStage>(
        "cube",
        {"Looks each generator's light cube map up at the eye's receivers, by direction and "
         "distance.",
         "U08, section 4.3",
         "It takes maps around caustic generators and refuses light that is stored elsewhere. "
         "Receivers that the reference point does not see get nothing; where a receiver is glossy "
         "a texel's light counts as spread evenly about its mean direction, or with "
         "incidence=centre as coming from one."},
        &gatherCubes);
}

}  // namespace kaustik
