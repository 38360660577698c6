// SPDX-License-Identifier: MIT
#include "framework/pipeline/limit.h"

#include <algorithm>
#include <utility>

namespace kaustik {

ReachedLimit bothLimits(const ReachedLimit& one, const ReachedLimit& other) {
    const bool isFarther = std::pair(other.value, other.needed) > std::pair(one.value, one.needed);
    ReachedLimit both = isFarther ? other : one;
    if (one.counted.empty() || one.counted != other.counted) return both;
    both.count = one.count + other.count;
    both.countedWatts = one.countedWatts + other.countedWatts;
    // A lower bound is missed by what lies farther below it.
    if (one.value == other.value && one.needed < one.value && other.needed < other.value)
        both.needed = std::min(one.needed, other.needed);
    return both;
}

}  // namespace kaustik
