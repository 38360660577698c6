// SPDX-License-Identifier: MIT
// Parameters that all nodes of a stage share (`stage.param`).
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "framework/core/error.h"
#include "framework/pipeline/effect.h"

namespace kaustik {

struct EyeParams {
    int samples = 1;
    template <class R>
    void reflect(R& r) {
        r.field(samples, "samples",
                "What the picture's pixels are the mean of: so many samples, squares of pixels of "
                "a frame that is rendered with so many times as many: all edges are anti-aliased, "
                "and whatever works on the screen works on a finer one. Lengths in pixels are of "
                "the samples",
                "", params::range(1, 64))
            .only({1, 4, 9, 16, 25, 36, 49, 64});
    }
    [[nodiscard]] int perSide() const {
        return static_cast<int>(std::lround(std::sqrt(static_cast<double>(samples))));
    }
};

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
    int lightPoints = 0;
    int wavelengths = 0;
    int batch = 4194304;
    template <class R>
    void reflect(R& r) {
        const auto whyRefined = [](const FrameFacts& facts) -> std::string {
            if (!facts.traits<DriverStage>().refines) return "";
            return fmt::format("{}; {} have", facts.withChosen<DriverStage>(),
                               facts.traits<DriverStage>().parameters);
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
             lightPoints, "light_points",
             "Points that stand for a light that has a size, each with a grid of its own, and for "
             "its soft shadows; they share out its photons. 0: 16 or fewer, down to 1 where its "
             "size would hardly be seen; 64 of an environment",
             "", params::range(0, 1024))
            .when([](const FrameFacts& facts) -> std::string {
                return facts.needs == nullptr || facts.needs->emitters > 0
                           ? ""
                           : "no light of the scene has a size";
            });
        r.field(wavelengths, "wavelengths",
                "Parts that white light is taken into where a dielectric disperses it, each with a "
                "grid of its own; they share out a light's photons. 0: from 8 to 32, by how far it "
                "parts colors and by what it leaves of photons to each; 1: none, all of it goes as "
                "the d line",
                "", params::range(0, 64))
            .when([](const FrameFacts& facts) -> std::string {
                return facts.needs == nullptr || facts.needs->disperses
                           ? ""
                           : "no dielectric of the scene disperses";
            });
        r.field(
             batch, "batch",
             "Most photons that a list has room for, 112 bytes each, 160 with beams. So many are "
             "emitted at once, or as many fewer as each may become by specular.split.levels; more "
             "follow in batches of whole rows",
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
    int blockers = 512;
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
        r.field(blockers, "blockers",
                "Side of each light's view of the specular surfaces in which a tracer that finds "
                "receivers alone looks for what stops light that is on its way to one; 0: light "
                "goes straight through whatever is there, as published",
                "texels", params::range(0, 8192))
            .when([](const FrameFacts& facts) -> std::string {
                if (!facts.traits<TraceStage>().onlyReceivers)
                    return facts.withChosen<TraceStage>();
                if (facts.needs == nullptr) return "";
                const scene::RepeatedHits& again = facts.needs->repeatedHits;
                const bool isPossible = again.outside && (again.transmitted || again.reflected);
                return isPossible ? "" : "no photon can hit a specular surface again";
            });
    }
};

}  // namespace kaustik
