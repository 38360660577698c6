// SPDX-License-Identifier: MIT
// What the steps of a judgement share: their picture in the reference's pixels, the pictures that
// it is taken for a mixture of, and how much each pixel counts. Each step says in its own header
// what of it it sets.
#pragma once

#include <initializer_list>
#include <vector>

#include "framework/judge/judge.h"
#include "framework/judge/linear_fit.h"

namespace kaustik::judge {

// What a column of the fit is. Of `shiftX`, `shiftY` and `scale`: the whole's derivatives; of
// `warp`, what another camera would change (view.h).
enum class Role { total, direct, lightClass, allClasses, cause, shiftX, shiftY, scale, fill, warp };

struct Column {
    Role role = Role::total;
    std::size_t index = 0;  // of a class, a cause or a warp
    Image image;
    Image error;  // empty: none
};

struct Comparison {
    Subject subject;
    JudgeOptions options;
    Image theirs;   // three channels, as stored
    Image clear;    // 1 where pixels count and their eye sees no glass
    Image counted;  // 1 where pixels count
    bool hasDirect = true;
    bool isGlassDecided = false;
    bool glassIsHidden = false;
    Registration registration;
    Encoding encoding = Encoding::linear;
    Primaries primaries = Primaries::rec709;
    double blurPixels = 0.0;  // standard deviation, of the reference's caustics
    // What the columns are moved by, pixels: half of the part of a pixel that the registration has,
    // and `picture` by the other half, so that interpolation blurs both alike.
    glm::dvec2 columnShift{0.0};
    bool hasCauseColumns = false;

    // Theirs in the reference's pixels, linear, in Rec. 709, over the first exposure.
    Image picture;
    Image theirsError;
    double firstExposure = 1.0;
    std::vector<Column> columns;  // the first is the whole
    Image weight;
    Image plainWeight;  // before what is far off is made less of
    Image deviation;    // standard deviation of each value of `picture`
    NormalEquations equations;
};

// Throws ConfigError where the picture or the view cannot be judged.
[[nodiscard]] Comparison comparisonOf(Subject subject, const JudgeOptions& options);

// Makes the columns, blurred by `blurPixels`.
void makeColumns(Comparison& comparison, bool withCauses);
[[nodiscard]] std::vector<std::size_t> columnsOf(const Comparison& comparison,
                                                 std::initializer_list<Role> roles);
// The column of the class that has most light.
[[nodiscard]] std::size_t brightestColumn(const Comparison& comparison);
// All light of the reference, sharp.
[[nodiscard]] Image modelOf(const Comparison& comparison, bool withDirect);
// Theirs over the reference's, where both show the same field of view.
[[nodiscard]] double usualScale(const Comparison& comparison);

}  // namespace kaustik::judge
