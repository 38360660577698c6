// SPDX-License-Identifier: MIT
// Parameters that all nodes of a stage share (`stage.param`).
#pragma once

#include <fmt/format.h>

#include "framework/pipeline/effect.h"
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
        const auto whyRefined = [](const FrameFacts& facts) -> std::string {
            if (!facts.traits<DriverStage>().refines) return "";
            return facts.withChosen<DriverStage>() + "; refine.finest and refine.memory have";
        };
        r.field(photons, "photons", "Photons along each side of a light's grid", "",
                params::range(1, 16384))
            .when([](const FrameFacts& facts) -> std::string {
                const std::string& takes = facts.traits<EmitStage>().takes;
                if (takes.empty()) return "";
                return fmt::format("emit={} {}", facts.settings.choice(EmitStage::name), takes);
            })
            .when(whyRefined);
        r.field(
             batch, "batch",
             "Most photons that are emitted at once, which bounds the memory of lists, 112 bytes "
             "a photon and list, 160 with beams, or twice that with both branches; more follow "
             "in batches of whole rows",
             "", params::range(1, 268435456))
            .when(whyRefined);
    }
};

struct SpecularParams {
    int bounces = 8;
    template <class R>
    void reflect(R& r) {
        r.field(bounces, "bounces",
                "Most specular interactions along a photon's path, where one can hit a surface "
                "again; at still water it cannot",
                "", params::range(1, 32))
            .when([](const FrameFacts& facts) -> std::string {
                if (facts.traits<SpecularStage>().throughBodies)
                    return facts.withChosen<SpecularStage>();
                const bool isKnown = facts.needs != nullptr;
                if (!isKnown || facts.needs->repeatedHits.reflected ||
                    facts.needs->repeatedHits.transmitted)
                    return "";
                return "no photon can hit a specular surface again";
            });
    }
};

// How a tracer decides that a ray hits a layer.
enum class HitTest : int { crossing, epsilon, inOut };

struct TraceParams {
    HitTest test = HitTest::crossing;
    float epsilonMeters = 0.01f;
    template <class R>
    void reflect(R& r) {
        const auto whyUntested = [](const FrameFacts& facts) -> std::string {
            const TracerReach reach = facts.traits<TraceStage>().reach;
            if (reach == TracerReach::eyeLayers || reach == TracerReach::around ||
                facts.isRead("trace.test"))
                return "";
            return facts.withChosen<TraceStage>();
        };
        r.choice(test, "test",
                 "crossing: the ray crosses the tangent plane of a layer within the pixel's "
                 "footprint, whatever the scene's scale; epsilon: the paper's absolute distance; "
                 "in_out: that, or the ray is between a solid's front and its back",
                 {"crossing", "epsilon", "in_out"})
            .when(whyUntested);
        r.field(epsilonMeters, "epsilon",
                "Largest difference of depth between ray and layer that counts as a hit, for the "
                "epsilon and in_out tests",
                "m", params::range(1e-6f, 1e6f))
            .when(test != HitTest::crossing, "with trace.test=crossing")
            .when(whyUntested);
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
             "size, of what the eye sees nearer and nearer by, where it looks more closely",
             "", params::range(1, 1 + static_cast<int>(transport::kMaxViews)))
            .when(unlessRead("reconstruct.map_cascades", notOfLights));
        r.field(memoryMebibytes, "map_memory",
                "Most memory of all caustic maps together and of what the lights see there; larger "
                "ones are halved until they fit, and the report says so",
                "MiB", params::range(1, 1048576))
            .when(unlessRead("reconstruct.map_memory", onScreen));
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
