// SPDX-License-Identifier: MIT
// What is wrong with someone else's picture of a scene whose light is known: their picture is taken
// apart into the light that there is, class of paths by class, and into what known mistakes would
// add to it. Knows neither scenes nor Embree; all pictures have the reference's size but theirs.
//
//     theirs ≈ exposure · (direct + Σ c_k class_k + Σ a_j cause_j)
//
// by least squares weighted by the noise of both, c_k ≥ 0. The errors of coefficients are those of
// sums over blocks of pixels, so that noise that neighbours share is in them.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "framework/judge/registration.h"

namespace kaustik::judge {

// Radiance towards the eye, W/m²/sr, and its standard error (empty: none).
struct Light {
    std::string name;  // "TRT"
    Image radiance;
    Image error;
};

enum class CauseKind {
    amount,  // of something: an index's error, a light's turn; other amounts lie between pictures
    whole,   // it was made, or not
};

// What a mistake adds to the picture. One that has an amount is there several times by the same
// name, with pictures for several amounts of either sign.
struct Cause {
    CauseKind kind = CauseKind::amount;
    std::string name;      // "index of 'glass'"
    std::string sentence;  // of a whole: "the faces of 'ball' are turned inside out"
    std::string unit;      // of an amount: "", "degrees"
    double amount = 0.0;   // that the picture is of
    double least = 0.0;    // amounts below it are not worth a word
    Image radiance;
    Image error;
};

struct NamedIndex {
    std::string material;
    double index = 1.0;
};

enum class DirectLight { automatic, with, without };
enum class Glass { automatic, seen, hidden };
enum class Encoding { automatic, linear, srgb, gamma22 };
// Of linear light, with their white (primaries.h).
enum class Primaries { automatic, rec709, rec2020, p3, acescg, aces2065 };

struct JudgeOptions {
    DirectLight direct = DirectLight::automatic;
    Glass glass = Glass::automatic;  // whether their eye sees dielectrics, or straight through
    Encoding encoding = Encoding::automatic;
    Primaries primaries = Primaries::automatic;
    std::optional<double> exposure;  // of theirs, where it is known
};

// The same in the words of a command line or of Python.
struct NamedOptions {
    std::string direct = "auto";     // or with, without
    std::string glass = "auto";      // or seen, hidden
    std::string encoding = "auto";   // or linear, srgb, gamma2.2
    std::string primaries = "auto";  // or rec709, rec2020, p3, acescg, aces2065
    std::optional<double> exposure;
};
using Spelling = std::function<std::string(const std::string& name)>;
// Throws ConfigError for a word that there is not; `spelled` is how whoever asks writes a name.
[[nodiscard]] JudgeOptions optionsOf(const NamedOptions& names, const Spelling& spelled);

struct Subject {
    std::string scene;       // for sentences
    std::string theirsName;  // their file
    Image theirs;            // as it is stored; 1, 3 or 4 channels
    Image theirsError;       // its standard error, of the same size; empty: it is estimated
    Image direct;            // radiance by direct light
    std::vector<Light> classes;
    Image fill;  // radiance of receivers per W/m² of an even fill light on them
    std::vector<Cause> causes;
    Image mask;      // 0 where nothing can be said: mirrors, edges, the open
    Image hasGlass;  // 1 where the eye's straight ray passes a dielectric
    double verticalFovDegrees = 45.0;
    std::vector<NamedIndex> indices;  // of dielectrics
};

struct ClassVerdict {
    std::string name;
    std::string title;       // "light that is reflected once inside"
    double fluxShare = 0.0;  // of all caustic light that the picture has
    double coefficient = 0.0;
    double error = 0.0;
    std::string verdict;  // there, missing, too bright, too dark, cannot be told
};

struct Finding {
    std::string name;  // for programs: "shift", "missing:TRT"
    double value = 0.0;
    double error = 0.0;
    std::string sentence;
    std::vector<std::string> also;  // sentences of causes that explain the same nearly as well
};

// Shares of the picture's pixels that are not counted.
struct LeftOut {
    double notDiffuse = 0.0;  // a mirror, something glossy, a lamp, an edge, or nothing is there
    double glass = 0.0;       // their eye sees a dielectric there
    double outside = 0.0;     // their picture does not reach
};

struct Verdict {
    std::string scene;
    std::string theirs;
    Registration registration;
    Encoding encoding = Encoding::linear;
    Primaries primaries = Primaries::rec709;
    // That the colours of the picture do not tell from these; none where these were asked for.
    std::vector<Primaries> otherPrimaries;
    bool hasDirect = true;
    bool glassIsHidden = false;
    double exposure = 1.0;
    double exposureError = 0.0;
    std::string exposureBy;   // what it was taken from
    double blurPixels = 0.0;  // standard deviation of the Gaussian that the reference needed
    std::vector<ClassVerdict> classes;
    std::vector<Finding> findings;
    std::size_t pixels = 0;  // counted
    LeftOut leftOut;
    double unexplainedShare = 0.0;  // mean of |residual| over that of the light
    // Of what varies in the picture beyond an even light and noise; nothing where nothing does.
    std::optional<double> explainedShare;
    double criticalZ = 0.0;  // of one pixel, so that all of them exceed it by chance in 1 %
    double largestZ = 0.0;
    std::size_t significantPixels = 0;
    Image residual;  // theirs / exposure less the fit, W/m²/sr; 0 where it is not counted
    Image z;         // one channel, with the sign of the residual
};

// Throws ConfigError in one sentence: a picture that holds no numbers, was made for a display, or
// shows another scene; a view without a caustic.
[[nodiscard]] Verdict judge(const Subject& subject, const JudgeOptions& options);

[[nodiscard]] nlohmann::json toJson(const Verdict& verdict);
// A report in sentences, as the command prints it.
[[nodiscard]] std::string toText(const Verdict& verdict);
// Where it differs: blue where theirs is darker, red where it is brighter, at full colour from
// twice the critical z; grey where pixels are not counted. For a display.
[[nodiscard]] Image whereOf(const Verdict& verdict);

[[nodiscard]] const char* nameOf(Encoding encoding);
[[nodiscard]] const char* nameOf(Primaries primaries);
// "light that is refracted twice" of "TT".
[[nodiscard]] std::string titleOf(const std::string& className);

}  // namespace kaustik::judge
