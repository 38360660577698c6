// SPDX-License-Identifier: MIT
// The stage `refine`: which cells of a light's view become photons (WN09, section 3.2). Run by
// driver.adaptive.
#pragma once

#include <string>

#include "framework/pipeline/effect.h"
#include "techniques/light_cells/landing_data.h"

namespace kaustik {

// The measure by which a cell of a light's view needs no more photons.
enum class RefineMetric : int { traversal, map, eye };
// Of the finest cells; photons are numbered by their cell, of which a light's have 2 x 19 bits.
constexpr int kMaxCellLevel = 19;
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
    // Whether no cell is ever so fine that the metric would be asked.
    [[nodiscard]] bool isMetricUnasked() const {
        return metric != RefineMetric::traversal && tolerance > 0.0f && check > finest;
    }
    template <class R>
    void reflect(R& r) {
        // Of driver.adaptive: why the map's cells are merged by nothing, for a condition.
        const auto whyNeverMerged = [this](const FrameFacts& facts) -> std::string {
            if (!facts.traits<DriverStage>().refines) return "";
            if (metric == RefineMetric::traversal) return "with refine.metric=traversal";
            if (check > finest) return "no cell is as fine as refine.check";
            return "";
        };
        const auto whyNotMergedAtAll = [this, whyNeverMerged](const FrameFacts& facts) {
            const bool mayScatter = facts.needs == nullptr || facts.needs->scatteringMedium;
            // Cells of the medium's own photons are merged by its own tolerance.
            if (metric != RefineMetric::traversal && mayScatter && medium > 0.0f)
                return std::string();
            return tolerance > 0.0f ? whyNeverMerged(facts) : "with refine.tolerance=0";
        };
        r.choice(metric, "metric",
                 "traversal: split to the finest cells; map: until four photons arrive in one "
                 "texel of what light is stored in; eye: until they do in one of the eye's "
                 "pixels, or where the eye does not see them",
                 {"traversal", "map", "eye"});
        r.field(tolerance, "tolerance",
                "Four photons become one where they arrive within so many texels; 0: never",
                "texels", params::range(0.0f, 64.0f))
            .when(whyNeverMerged);
        r.field(medium, "medium",
                "Where a medium scatters: its light has photons of its own, of which four become "
                "one where both ends of their paths are seen within so many of the eye's pixels; "
                "0: those of the map",
                "px", params::range(0.0f, 64.0f))
            .when([this](const FrameFacts& facts) {
                const bool mayScatter = facts.needs == nullptr || facts.needs->scatteringMedium;
                return mayScatter && metric != RefineMetric::traversal
                           ? ""
                           : "the medium has no photons of its own here";
            });
        r.field(finest, "finest", "Finest cells along a side of a light's view; a power of two", "",
                params::range(8, 1 << kMaxCellLevel));
        r.field(start, "start", "Cells along a side to begin with; a power of two", "",
                params::range(2, 1024));
        r.field(check, "check",
                "Cells along a side from which on the metric is asked; a power of two", "",
                params::range(2, 65536))
            .when(metric != RefineMetric::traversal, "with refine.metric=traversal")
            .when(tolerance > 0.0f, "with refine.tolerance=0");
        r.choice(
            mask, "mask",
            "on: a cell is dropped where nothing specular is seen in all of it; off: where its "
            "four photons miss, as published",
            {"on", "off"});
        r.choice(signature, "signature",
                 "on: four photons whose paths meet different things, or part, stay apart",
                 {"on", "off"})
            .when(whyNotMergedAtAll);
        r.field(memoryMebibytes, "memory",
                "Most memory of cells and photons; what needs more is done in batches, depth first",
                "MiB", params::range(1, 65536));
    }
};

// An adaptive traversal of lights' views between two of its rounds (WN09, section 3.2).
struct CellTraversal {
    graph::Buffer<transport::LightCell> waiting;  // the last ones are the next to be looked at
    LightCells taken;                             // in this round
    LightCells probes;                            // their quarters, four after one another
    LightCells photons;                           // what is to be emitted
    graph::Buffer<transport::CellCounts> counts;
    graph::Buffer<light_cells::Landing> landings;  // by probe and branch; where a metric needs them
    int branches = 1;                              // that a probe may land by
    float tolerance = 1.0f;                        // of the metric, texels of its view
    int checkLevel = 0;                            // of the first probes of which it is asked
    std::string suffix;                            // of its resources
    Hits first;                                    // of the probes, on specular surfaces
    Geometry geometry;
};

// Drops each of the cells that were taken, splits it, or makes photons of it.
struct RefineStage : Stage<CellTraversal(CellTraversal)> {
    static constexpr const char* name = "refine";
    static constexpr const char* question = "Which cells of a light's view are split further?";
    static constexpr const char* takes = "cells that were taken, with their probes";
    static constexpr const char* gives = "cells that are split further, and photons";
    static std::string whyIdle(const FrameFacts& facts) {
        if (facts.traits<DriverStage>().refines) return noCausticReason(facts);
        return facts.withChosen<DriverStage>() + "; take driver=adaptive";
    }
};

}  // namespace kaustik
