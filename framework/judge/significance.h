// SPDX-License-Identifier: MIT
// What chance alone would give: the tests by which the judge decides.
#pragma once

#include <cstddef>

namespace kaustik::judge {

// The chance, each, at which any of `count` independent tests errs with `chance` (Šidák).
[[nodiscard]] double chanceOfEach(double chance, double count);
// The z that a normal variate exceeds on either side with this chance.
[[nodiscard]] double criticalZ(double chance);
// The chance that chi squared of so many degrees of freedom, 1 at least, exceeds `value`.
[[nodiscard]] double chiSquaredTail(double value, std::size_t degrees);
// What it exceeds with this chance.
[[nodiscard]] double criticalChiSquared(double chance, std::size_t degrees);

}  // namespace kaustik::judge
