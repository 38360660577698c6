// SPDX-License-Identifier: MIT
// Lists of photons: their length, and where each is. C++ and GLSL both read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::transport {
using glm::uvec2;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define KAUSTIK_INLINE
#endif

KAUSTIK_INLINE PhotonList photonListOf(uint count, uint rowLength) {
    PhotonList list;
    list.count = count;
    list.rowLength = rowLength;
    uint groups = (count + kPhotonGroup - 1u) / kPhotonGroup;
    list.groupsX = groups < kMaxGroupsX ? groups : kMaxGroupsX;
    list.groupsY = (groups + kMaxGroupsX - 1u) / kMaxGroupsX;
    list.groupsZ = 1u;
    list.vertices = 4u;
    list.instances = count;
    list.firstVertex = 0u;
    list.firstInstance = 0u;
    return list;
}

KAUSTIK_INLINE uvec2 photonTexel(PhotonList list, uint index) {
    return uvec2(index % list.rowLength, index / list.rowLength);
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
