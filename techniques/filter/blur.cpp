// SPDX-License-Identifier: MIT
// filter.blur: a Gaussian over the texels of each map, for photons that were stored as points
// (WD06). Flux a texel, W, before and after, of which it loses none.
#include <utility>

#include "techniques/maps/map_filters.h"
#include "techniques/maps/map_needs.h"

namespace kaustik {
namespace {

struct BlurParams {
    int diameter = 7;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter", "Of the Gaussian; an even number is one less", "texels",
                params::range(1, 63));
    }
};

CausticMap blurMap(FrameBuilder& frame, const BlurParams& params, CausticMap map) {
    needsMap("filter.blur", map, {});
    const int diameter = params.diameter - (params.diameter % 2 == 0 ? 1 : 0);
    return filterMaps(
        frame, "filter.blur", "points become what splats would be", std::move(map),
        [](graph::PassSetup& setup, Filtered& data) {
            data.scratch = setup.image(
                "blurred", createLike(setup, "caustic.blurred", data.map, data.map.sets.perView()));
        },
        [diameter](const Filtered& data, gl::PassContext& context) {
            for (int axis = 0; axis < 2; ++axis) {
                gl::Command command = filterCommand(context, "filter/blur.comp", data.map);
                command.set("diameter", diameter).set("axis", axis);
                dispatchOverMap(command, data.map);
            }
        });
}

}  // namespace

void registerFilterBlur(Registry& registry) {
    registry.node<FilterStage>(
        "blur",
        {"Blurs the map's texels by a Gaussian, for points.", "WD06",
         "It does not know the receivers: it carries light over their edges within the map. It "
         "takes one map and refuses those of several sizes or levels."},
        &blurMap);
}

}  // namespace kaustik
