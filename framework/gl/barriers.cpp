// SPDX-License-Identifier: MIT
#include "framework/gl/barriers.h"

namespace kaustik::gl {
namespace {

// Those that shaders read by, and the ends of the reads are not waited for by a later store.
bool isShaderAccess(Use use) {
    return use != Use::target && use != Use::updateTexture && use != Use::updateBuffer &&
           use != Use::capture && use != Use::queryResult;
}

}  // namespace

GLbitfield Barriers::before(const std::vector<Access>& accesses) {
    GLbitfield bits = 0;
    for (const Access& access : accesses) {
        const Slot& slot = slots_[access.slot];
        bits |= static_cast<GLbitfield>(access.use) &
                (access.stores ? slot.sinceAccess : slot.sinceStore);
    }
    if (bits != 0) {
        // A barrier is one for all memory.
        for (Slot& slot : slots_) {
            slot.sinceStore &= ~bits;
            slot.sinceAccess &= ~bits;
        }
    }
    for (const Access& access : accesses) {
        Slot& slot = slots_[access.slot];
        if (access.stores) slot.sinceStore = GL_ALL_BARRIER_BITS;
        if (isShaderAccess(access.use)) slot.sinceAccess = GL_ALL_BARRIER_BITS;
    }
    return bits;
}

}  // namespace kaustik::gl
