// SPDX-License-Identifier: MIT
// specular.split, for who chooses between it and another node.
#pragma once

#include "techniques/photon_lists/branches.h"

namespace kaustik {

Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits,
                         Surfaces surfaces);

}  // namespace kaustik
