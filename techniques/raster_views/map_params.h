// SPDX-License-Identifier: MIT
// Parameters that all nodes of the stage reconstruct share (`reconstruct.param`): where light is
// stored, and how large the maps are.
#pragma once

#include "framework/pipeline/effect.h"
#include "framework/transport/types.h"

namespace kaustik {

// Where light is stored.
enum class StoreSpace : int { screen, light, cube };
// What a light's map covers.
enum class MapCover : int { seen, scene };

// By what the further maps of a light are chosen.
enum class CascadeChoice : int { depth, magnification };

struct ReconstructParams {
    StoreSpace space = StoreSpace::screen;
    int mapSize = 1024;
    MapCover covers = MapCover::seen;
    int cascades = 1;
    CascadeChoice cascadesBy = CascadeChoice::depth;
    int memoryMebibytes = 4096;
    template <class R>
    void reflect(R& r) {
        const char* const onScreen =
            space == StoreSpace::screen ? "light is stored on the screen" : "";
        const char* const notOfLights =
            space == StoreSpace::light ? "" : "reconstruct.space is not light";
        // Others may look receivers up in such maps all the same.
        const auto unlessRead = [](const char* name, const char* reason) {
            return [=](const FrameFacts& facts) { return facts.isRead(name) ? "" : reason; };
        };
        r.choice(space, "space",
                 "screen: by the eye's pixels; light: in a caustic map of each light, as it sees "
                 "the receivers; cube: on six faces around each caustic generator",
                 {"screen", "light", "cube"});
        r.field(mapSize, "map_size",
                "Side of a light's caustic map; half of it where six are needed, around a light or "
                "a generator",
                "texels", params::range(16, 8192))
            .when(unlessRead("reconstruct.map_size", onScreen));
        r.choice(covers, "map_covers",
                 "seen: of a light's, the receivers within what the eye looks at; scene: all of "
                 "them",
                 {"seen", "scene"})
            .when(unlessRead("reconstruct.map_covers", notOfLights));
        r.field(
             cascades, "map_cascades",
             "Maps of each light: one of all that map_covers says, and further ones, of the same "
             "size, of what the eye sees nearer and nearer by, where it looks more closely, or of "
             "what it sees magnified (map_cascades_by)",
             "", params::range(1, 1 + static_cast<int>(transport::kMaxViews)))
            .when(unlessRead("reconstruct.map_cascades", notOfLights));
        r.choice(cascadesBy, "map_cascades_by",
                 "depth: further maps are of what is nearer and nearer to the eye; magnification: "
                 "of those parts of the light's view whose texels are the largest on the screen, "
                 "measured where the eye sees receivers",
                 {"depth", "magnification"})
            .when(unlessRead("reconstruct.map_cascades_by", notOfLights))
            .when(cascades > 1, "with reconstruct.map_cascades=1");
        r.field(memoryMebibytes, "map_memory",
                "Most memory of all caustic maps together and of what the lights see there; larger "
                "ones are halved until they fit, and the report says so",
                "MiB", params::range(1, 1048576))
            .when(unlessRead("reconstruct.map_memory", onScreen));
    }
};

}  // namespace kaustik
