// SPDX-License-Identifier: MIT
// The keys of a `shape = …` object of a scene file; see scene_keys.h.
#pragma once

#include <variant>

#include "framework/scene/files/table_reader.h"
#include "framework/scene/scene.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {

inline constexpr NumberRange kBelow180Degrees{0.0, 180.0, true, true};

template <class R>
void reflect(R& r, Wave& wave) {
    r.number(wave.amplitudeMeters, {"amplitude", "Half of its height", "m"}, kNotNegative);
    r.number(wave.wavelengthMeters, {"wavelength", "From crest to crest", "m"}, kPositive);
    r.number(wave.directionDegrees, {"direction_degrees", "Of its travel, from +x towards +z"},
             kAnyNumber, kHasDefault);
    r.number(wave.phaseRadians, {"phase", "Where in its period it begins", "rad"}, kAnyNumber,
             kHasDefault);
    r.number(wave.omegaRadiansPerSecond,
             {"omega", "Angular frequency; that of gravity waves if not given", "rad/s"},
             kNotNegative, kOptional);
}
// They may be listed in one key or as tables.
template <class R>
void reflectWaves(R& r, std::vector<Wave>& waves) {
    r.rule({{"wave", "waves"},
            false,
            "wave",
            "the waves are listed in waves or as [[object.wave]], not both"});
    r.tables(waves, {"waves", "Waves that add up"});
    r.tables(waves, {"wave", "The same, as [[….wave]]"});
}

constexpr const char* kAround = "Straight pieces around the axis";

template <class R>
void reflect(R& r, PlaneShape& shape) {
    r.vector(shape.size, {"size", "Along x and z", "m"}, kPositive);
    r.counts(shape.cells, {"cells", "Squares along x and z"}, 1, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, DiscShape& shape) {
    r.number(shape.radius, {"radius", "Around the axis y", "m"}, kPositive);
    r.count(shape.segments, {"segments", kAround}, 3, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, BoxShape& shape) {
    r.vector(shape.size, {"size", "Along x, y and z", "m"}, kPositive);
    r.flag(shape.inward, {"inward", "Whether its faces look inwards"});
    r.subset(shape.open, {"open", "Sides that are left out"},
             std::array{"-x", "+x", "-y", "+y", "-z", "+z"});
}

template <class R>
void reflect(R& r, SphereShape& shape) {
    r.number(shape.radius, {"radius", "Of the ball", "m"}, kPositive);
    r.count(shape.segments, {"segments", kAround}, 4, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, CylinderShape& shape) {
    r.number(shape.radius, {"radius", "Around the axis y", "m"}, kPositive);
    r.number(shape.height, {"height", "Along the axis", "m"}, kPositive);
    r.flag(shape.open, {"open", "Without its ends"});
    r.flag(shape.inward, {"inward", "Whether its faces look inwards"});
    r.count(shape.segments, {"segments", kAround}, 3, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, RingShape& shape) {
    r.number(shape.innerRadius, {"inner_radius", "Of the hole", "m"}, kPositive);
    r.number(shape.outerRadius, {"outer_radius", "Of the whole", "m"}, kPositive);
    r.number(shape.height, {"height", "Along the axis", "m"}, kPositive);
    r.count(shape.segments, {"segments", kAround}, 3, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, TorusShape& shape) {
    r.number(shape.radius, {"radius", "From the axis to the tube's middle", "m"}, kPositive);
    r.number(shape.tubeRadius, {"tube_radius", "Of the tube", "m"}, kPositive);
    r.count(shape.segments, {"segments", kAround}, 3, kMaximumCells, kHasDefault);
    r.count(shape.tubeSegments, {"tube_segments", "Straight pieces around the tube"}, 3,
            kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, TreeShape& shape) {
    r.number(shape.height, {"height", "About how high it is", "m"}, kPositive);
    r.number(shape.trunkRadius, {"trunk_radius", "Of the trunk at its foot", "m"}, kPositive);
    r.count(shape.levels, {"levels", "How often branches branch"}, 1, kMaximumCells, kHasDefault);
    r.count(shape.children, {"children", "Branches of a branch"}, 1, kMaximumCells, kHasDefault);
    r.count(shape.sides, {"sides", "Of a branch"}, 3, kMaximumCells, kHasDefault);
    r.number(shape.spreadDegrees, {"spread_degrees", "How far branches lean"}, kPositive,
             kHasDefault);
    r.count(shape.seed, {"seed", "Of everything random about it"}, 1, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, LensShape& shape) {
    r.number(shape.topRadius, {"top_radius", "Of the upper face; negative is concave, 0 flat", "m"},
             kAnyNumber);
    r.number(shape.bottomRadius,
             {"bottom_radius", "Of the lower face; negative is concave, 0 flat", "m"}, kAnyNumber);
    r.number(shape.diameter, {"diameter", "Across the axis", "m"}, kPositive);
    r.number(shape.centerThickness, {"center_thickness", "On the axis; or edge_thickness", "m"},
             kPositive, kOptional);
    r.number(shape.edgeThickness, {"edge_thickness", "At the rim; or center_thickness", "m"},
             kPositive, kOptional);
    r.rule({{"center_thickness", "edge_thickness"},
            true,
            "shape",
            "Exactly one of center_thickness and edge_thickness must be given"});
    r.count(shape.segments, {"segments", kAround}, 3, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, PrismShape& shape) {
    r.number(shape.apexDegrees, {"apex_degrees", "Of the upper edge"}, kBelow180Degrees);
    r.number(shape.height, {"height", "From the base to the upper edge", "m"}, kPositive);
    r.number(shape.length, {"length", "Along the upper edge", "m"}, kPositive);
}

template <class R>
void reflect(R& r, ParaboloidShape& shape) {
    r.number(shape.focalLength, {"focal_length", "From its vertex to its focus", "m"}, kPositive);
    r.number(shape.diameter, {"diameter", "Across the axis", "m"}, kPositive);
    r.count(shape.segments, {"segments", kAround}, 3, kMaximumCells, kHasDefault);
}

template <class R>
void reflect(R& r, HeightField& water) {
    r.vector(water.sizeMeters, {"size", "Along x and z", "m"}, kPositive);
    r.counts(water.cells, {"cells", "Squares along x and z"}, 1, kMaximumCells, kHasDefault);
    reflectWaves(r, water.waves);
}

using Shape =
    std::variant<PlaneShape, DiscShape, BoxShape, SphereShape, CylinderShape, RingShape, TorusShape,
                 TreeShape, LensShape, PrismShape, ParaboloidShape, HeightField>;

}  // namespace kaustik::scene
