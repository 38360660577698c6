// SPDX-License-Identifier: MIT
#include "techniques/register_all.h"

#include "techniques/screen_space_photons/nodes.h"
#include "techniques/shared/nodes.h"

namespace kaustik {

Registry registerAll() {
    Registry registry;
    registerSharedNodes(registry);
    registerScreenSpacePhotons(registry);
    registerMediaLeftOut(registry);
    return registry;
}

}  // namespace kaustik
