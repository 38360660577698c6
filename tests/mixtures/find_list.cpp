// SPDX-License-Identifier: MIT
#include "tests/mixtures/finds.h"

namespace kaustik::mixtures {

// One that no longer fails is taken out, by a test.
const std::vector<KnownFind>& knownFinds() {
    static const std::vector<KnownFind> finds;
    return finds;
}

const std::vector<MendedFind>& mendedFinds() {
    static const std::vector<MendedFind> finds = {
        // The scene's medium was not in bodies that photons go through at once: 118 %.
        {"medium --set emit.photons=64x64 --set specular=two_interfaces", "energy"},
        {"medium --set emit.photons=64x64 --set specular=deferred", "energy"},
        // One map joined cells that another one of the same generator did not.
        {"mixed --set emit.photons=64x64 --set around.cubes.size=64 --set reconstruct.space=cube "
         "--set gather=cube --set around.points=16",
         "balance"},
        // Half of the light was discarded without a word.
        {"mirror --set emit.photons=64x64 --set reconstruct.triangles.unjoined=discard", "energy"},
        // Batches of one generator's map and the next generator's map had one name.
        {"lights --set emit.photons=64x64 --set around.cubes.size=64 --set reconstruct=lens "
         "--set reconstruct.space=cube --set gather=cube --set around.points=2",
         "bits emit.batch=512"},
        // The refusal named what was taken already.
        {"ball --set emit.photons=64x64 --set driver=hierarchical --set trace=all_hits", "refusal"},
        // Branches whose numbers had no place among their cells' were not stored.
        {"glossy --set emit.photons=64x64 --set driver=hierarchical", "balance"},
        // Rounding decided whether a floor's light lies on a wall's pixels.
        {"lights --set emit.photons=64x64", "scale 128"},
        // A view's direction was rounded by how far out it looks from.
        {"mixed --set emit.photons=64x64 --set trace=secant", "scale 128"},
        {"mixed --set emit.photons=64x64 --set reconstruct.space=cube --set gather=cube",
         "scale 128"},
        // Reflected light was judged by the reference of refracted light.
        {"water --set emit.photons=64x64 --set specular=two_interfaces "
         "--set specular.two_interfaces.branch=reflected",
         "energy"},
        // What was lost was said without a setting that finds it.
        {"lights --set emit.photons=64x64 --set trace.test=epsilon", "energy"},
        {"mixed --set emit.photons=64x64 --set refine.start=16 --set driver=adaptive "
         "--set emit=deferred --set refine.mask=off",
         "energy"},
        {"glossy --set emit.photons=64x64 --set specular.split.levels=0", "energy"}};
    return finds;
}

}  // namespace kaustik::mixtures
