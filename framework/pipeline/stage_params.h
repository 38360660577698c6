// SPDX-License-Identifier: MIT
// Parameters that all nodes of a stage share (`stage.param`).
#pragma once

#include "framework/params/field.h"
#include "framework/transport/types.h"

namespace kaustik {

struct LayersParams {
    int count = 8;
    template <class R>
    void reflect(R& r) {
        r.field(count, "count",
                "Most depth layers that are kept; deeper fragments are counted and skipped", "",
                params::range(1, 64));
    }
};

struct EmitParams {
    params::Extent photons{256, 256};
    int batch = 4194304;
    template <class R>
    void reflect(R& r) {
        r.field(photons, "photons", "Photons along each side of a light's grid", "",
                params::range(1, 16384));
        r.field(
            batch, "batch",
            "Most photons that are emitted at once, which bounds the memory of lists, 112 bytes "
            "a photon and list, 160 with beams, or twice that with both branches; more follow "
            "in batches of whole rows",
            "", params::range(1, 268435456));
    }
};

// By what it is told that a cell of a light's view needs no more photons.
enum class RefineMetric : int { traversal, map, eye };
enum class RefineSwitch : int { on, off };

struct RefineParams {
    RefineMetric metric = RefineMetric::map;
    float tolerance = 1.0f;
    int finest = 4096;
    int start = 64;
    int check = 512;
    float medium = 4.0f;
    RefineSwitch mask = RefineSwitch::on;
    RefineSwitch signature = RefineSwitch::on;
    int memoryMebibytes = 1024;
    template <class R>
    void reflect(R& r) {
        r.choice(metric, "metric",
                 "traversal: split to the finest cells; map: until four photons arrive in one "
                 "texel of what light is stored in; eye: until they do in one of the eye's "
                 "pixels, or where the eye does not see them",
                 {"traversal", "map", "eye"});
        r.field(tolerance, "tolerance",
                "Four photons become one where they arrive within so many texels; 0: never",
                "texels", params::range(0.0f, 64.0f));
        r.field(medium, "medium",
                "Where a medium scatters: its light has photons of its own, of which four become "
                "one where both ends of their paths are seen within so many of the eye's pixels; "
                "0: those of the map",
                "px", params::range(0.0f, 64.0f));
        r.field(finest, "finest", "Finest cells along a side of a light's view; a power of two", "",
                params::range(8, 1 << transport::kMostCellLevel));
        r.field(start, "start", "Cells along a side to begin with; a power of two", "",
                params::range(2, 1024));
        r.field(check, "check",
                "Cells along a side from which on the metric is asked; a power of two", "",
                params::range(2, 65536));
        r.choice(
            mask, "mask",
            "on: a cell is dropped where nothing specular is seen in all of it; off: where its "
            "four photons miss, as published",
            {"on", "off"});
        r.choice(signature, "signature",
                 "on: four photons whose paths meet different things, or part, stay apart",
                 {"on", "off"});
        r.field(memoryMebibytes, "memory",
                "Most memory of cells and photons; what needs more is done in batches, depth first",
                "MiB", params::range(1, 65536));
    }
};

struct SpecularParams {
    int bounces = 8;
    template <class R>
    void reflect(R& r) {
        r.field(bounces, "bounces",
                "Most specular interactions along a photon's path, where one can hit a surface "
                "again; at still water it cannot",
                "", params::range(1, 32));
    }
};

// How a tracer decides that a ray hits a layer.
enum class HitTest : int { crossing, epsilon, inOut };

struct TraceParams {
    HitTest test = HitTest::crossing;
    float epsilonMeters = 0.01f;
    template <class R>
    void reflect(R& r) {
        r.choice(test, "test",
                 "crossing: the ray crosses the tangent plane of a layer within the pixel's "
                 "footprint, whatever the scene's scale; epsilon: the paper's absolute distance; "
                 "in_out: that, or the ray is between a solid's front and its back",
                 {"crossing", "epsilon", "in_out"});
        r.field(epsilonMeters, "epsilon",
                "Largest difference of depth between ray and layer that counts as a hit, for the "
                "epsilon and in_out tests",
                "m", params::range(1e-6f, 1e6f));
    }
};

// Where light is stored.
enum class StoreSpace : int { screen, light, cube };
// What a light's map covers.
enum class MapCover : int { seen, scene };

struct ReconstructParams {
    StoreSpace space = StoreSpace::screen;
    int mapSize = 1024;
    MapCover covers = MapCover::seen;
    int cascades = 1;
    int memoryMebibytes = 4096;
    template <class R>
    void reflect(R& r) {
        r.choice(space, "space",
                 "screen: by the eye's pixels; light: in a caustic map of each light, as it sees "
                 "the receivers; cube: on six faces around each caustic generator",
                 {"screen", "light", "cube"});
        r.field(mapSize, "map_size",
                "Side of a light's caustic map; half of it where six are needed, around a light or "
                "a generator",
                "texels", params::range(16, 8192));
        r.choice(covers, "map_covers",
                 "seen: of a light's, the receivers within what the eye looks at; scene: all of "
                 "them",
                 {"seen", "scene"});
        r.field(
            cascades, "map_cascades",
            "Maps of each light: one of all that map_covers says, and further ones, of the same "
            "size, of what the eye sees nearer and nearer by, where it looks more closely",
            "", params::range(1, 1 + static_cast<int>(transport::kMostViews)));
        r.field(memoryMebibytes, "map_memory",
                "Most memory of all caustic maps together and of what the lights see there; larger "
                "ones are halved until they fit, and the report says so",
                "MiB", params::range(1, 1048576));
    }
};

struct ViewParams {
    int samples = 1;
    template <class R>
    void reflect(R& r) {
        r.field(samples, "samples",
                "Rays of the eye a pixel, evenly spread over it, whose mean is shown where one of "
                "them sees a specular surface; 1: through its middle. For each beside the middle "
                "the scene's first surfaces are drawn once more",
                "", params::range(1, 64));
    }
};

}  // namespace kaustik
