// SPDX-License-Identifier: MIT
// gather.project: the caustic map of each light projected onto the eye's receivers like a shadow
// map (WD06), light by light. Where a receiver is glossy, a texel's light counts as coming from
// about its mean direction, as widely spread as that is short. In: flux a texel, W; out:
// irradiance, W/m², and radiance, W/m²/sr.
#include <utility>

#include "techniques/maps/map_needs.h"
#include "techniques/maps/projection.h"

namespace kaustik {
namespace {

struct ProjectParams {
    int maxSamples = 4;
    template <class R>
    void reflect(R& r) {
        r.field(maxSamples, "max_samples",
                "Most looks at a map along each side of a pixel that spans several of its texels",
                "", params::range(1, 16));
        r.renamed("places", "max_samples");
    }
};

IrradianceMap projectLightMaps(FrameBuilder& frame, const ProjectParams& params, CausticMap map,
                               Surfaces surfaces) {
    needsMap("gather.project", map, {SetLayout::one, StoreSpace::light});
    return projectMaps(frame,
                       {"gather.project",
                        "each light's map is looked up where the eye's "
                        "receivers lie",
                        params.maxSamples, false},
                       std::move(map), surfaces);
}

}  // namespace

void registerGatherProject(Registry& registry) {
    registry.node<GatherStage>(
        "project",
        {"Looks each light's caustic map up at the eye's receivers, like a shadow map.", "WD06",
         "It takes maps of lights and refuses light that is stored elsewhere. Where a receiver is "
         "glossy, a texel's light counts as spread evenly about its mean direction."},
        &projectLightMaps);
}

}  // namespace kaustik
