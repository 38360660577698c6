// SPDX-License-Identifier: MIT
// What cannot be judged is refused, by ConfigErrors of one sentence.
#pragma once

#include <string>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// Of a picture of three channels: values that are no numbers, black, and negative light.
void requireNumbers(const Image& theirs, const std::string& name);
// Of the caustics of a subject, at least a part in the mask.
void requireCaustic(const Subject& subject, const Image& mask);
// Values that all are the same where the reference's (`model`) are not: a display's white. Needs
// the registration.
void requireNotCutOff(const Comparison& comparison, const Image& model);

// What is next to nothing in the picture cannot be told apart in it: such classes become one,
// "other", the last.
void joinFaintClasses(Subject& subject);

}  // namespace kaustik::judge
