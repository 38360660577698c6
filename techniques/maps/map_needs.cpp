// SPDX-License-Identifier: MIT
#include "techniques/maps/map_needs.h"

#include <fmt/format.h>

#include "framework/core/error.h"

namespace kaustik {
namespace {

struct LayoutWords {
    const char* holds;
    const char* filter;       // that makes one map of it
    const char* reconstruct;  // that stores it
};

LayoutWords wordsOf(SetLayout layout) {
    switch (layout) {
        case SetLayout::one:
            return {"one map of all flux", "none", "lens"};
        case SetLayout::sizes:
            return {"four sizes of splats", "blend", "four_radii"};
        case SetLayout::levels:
            return {"levels with all flux in each", "levels", "levels"};
        case SetLayout::sharedLevels:
            break;
    }
    return {"levels that share the flux out", "level_sum", "multi_level"};
}

struct SpaceWords {
    const char* place;
    const char* gather;
    const char* name;  // of reconstruct.space
};

SpaceWords wordsOf(StoreSpace space) {
    switch (space) {
        case StoreSpace::screen:
            return {"by the eye's pixels", "screen", "screen"};
        case StoreSpace::light:
            return {"in the lights' maps", "project", "light"};
        case StoreSpace::cube:
            break;
    }
    return {"around caustic generators", "cube", "cube"};
}

StoreSpace spaceOf(const FluxMap& map) {
    if (map.on.views->isEyeView()) return StoreSpace::screen;
    return map.generator >= 0 ? StoreSpace::cube : StoreSpace::light;
}

}  // namespace

void needsMap(const std::string& node, const CausticMap& map, const MapNeeds& needs) {
    const FluxMap& stored = map.maps.front();
    const StoreSpace space = spaceOf(stored);
    if (needs.space && *needs.space != space) {
        throw ConfigError(fmt::format(
            "{} looks light up {}, but it is stored {}; take gather={}, or reconstruct.space={}.",
            node, wordsOf(*needs.space).place, wordsOf(space).place, wordsOf(space).gather,
            wordsOf(*needs.space).name));
    }
    const bool isRead = needs.layout == SetLayout::one
                            ? stored.isOne()
                            : !stored.filtered.valid() && stored.sets.layout == needs.layout;
    if (isRead) return;
    const LayoutWords given = wordsOf(stored.sets.layout);
    const LayoutWords wanted = wordsOf(needs.layout);
    throw ConfigError(fmt::format(
        "{} takes {}, but the map of flux that it is given holds {}; take filter={}, or "
        "reconstruct={}.",
        node, wanted.holds, given.holds, given.filter, wanted.reconstruct));
}

}  // namespace kaustik
