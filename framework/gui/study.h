// SPDX-License-Identifier: MIT
// What is to be varied from the settings at hand: a study as a value, with its runs and what they
// will take, before any of them is started. Knows no window.
#pragma once

#include <string>
#include <vector>

#include "framework/gui/document.h"
#include "framework/gui/settled_points.h"

namespace kaustik::gui {

// The setting of a study that is no parameter.
inline constexpr const char* kTechniqueKey = "technique";
// Frames of each run before those that are timed.
inline constexpr int kStudyWarmup = 1;
// In a window; larger ones are for `kaustik experiment` and its shards.
inline constexpr std::size_t kMaxStudyRuns = 1000;

struct StudyAxis {
    std::string key;                  // kTechniqueKey, or a parameter by its full name
    std::vector<std::string> values;  // as texts that the parameter takes, each once
    friend bool operator==(const StudyAxis&, const StudyAxis&) = default;
};

struct Study {
    Document document;  // its own settings as A; those that vary are any of their values there
    std::vector<StudyAxis> axes;
};

struct TypedAxis {
    StudyAxis axis;
    std::string problem;    // why it cannot be; "" where it can
    bool hasEffect = true;  // with the settings at hand, where that is known
};
// The values that were typed, apart by blanks or semicolons (a comma may end one), as the parameter
// itself writes them, in their order. What repeats another one is left out.
[[nodiscard]] TypedAxis typedAxis(const std::string& key, const std::string& text,
                                  const Variant& variant, const Registry& registry);

// How many combinations there are of one value from each axis; kMaxStudyRuns + 1 for more.
[[nodiscard]] std::size_t runCount(const std::vector<StudyAxis>& axes);
// Every combination, the last axis varying fastest.
[[nodiscard]] std::vector<Variant> variantsOf(const Study& study);
// What is varied in one of them: "layers.count=4, trace=march".
[[nodiscard]] std::string variedText(const Study& study, const Variant& variant);

// What is known before a study of how long its runs take.
struct KnownTimes {
    double startSeconds = 0.0;  // of a program, its scene and its shaders
    double frameMs = 0.0;       // of the settings at hand
    bool isPrecise = false;     // how frames will be timed
};
// Of all runs one after the other: each starts the program and renders its frames and one for the
// ledger. A combination that the session has timed is expected to take its own time, any other the
// time of the settings at hand.
[[nodiscard]] double expectedSeconds(const Study& study, int frames, const KnownTimes& known,
                                     const std::vector<SettledPoint>& points);
// "40 s", "3 min", "2 h 10 min".
[[nodiscard]] std::string durationText(double seconds);

}  // namespace kaustik::gui
