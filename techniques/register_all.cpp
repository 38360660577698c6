// SPDX-License-Identifier: MIT
#include "techniques/register_all.h"

#include "techniques/adaptive_caustic_map/nodes.h"
#include "techniques/caustic_map/nodes.h"
#include "techniques/caustic_triangles/nodes.h"
#include "techniques/planar/nodes.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/raytraced/nodes.h"
#endif
#include "techniques/screen_space_photons/nodes.h"
#include "techniques/shared/nodes.h"

namespace kaustik {

Registry registerAll() {
    Registry registry;
    registerSharedNodes(registry);
    registerScreenSpacePhotons(registry);
#ifdef KAUSTIK_HAS_EMBREE
    registerRaytraced(registry);
#endif
    registerPlanar(registry);
    registerCausticMap(registry);
    registerCausticTriangles(registry);
    registerAdaptiveCausticMap(registry);
    registerNoMedia(registry);
    return registry;
}

}  // namespace kaustik
