// SPDX-License-Identifier: MIT
#include "framework/judge/colour.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "framework/judge/alignment.h"
#include "framework/judge/fitting.h"
#include "framework/judge/primaries.h"
#include "framework/judge/weights.h"

namespace kaustik::judge {
namespace {

// Another encoding than linear must leave less than this share of what is unexplained.
constexpr double kMaxLossOfEncoding = 0.6;
// As must others than the primaries of Rec. 709, whose picture of little colour differs by less.
constexpr double kMaxLossOfPrimaries = 0.8;
// Primaries are told from others that leave more than this times as much: as many values are in a
// picture, chance has no part in it, and what the fits do not know of the light has.
constexpr double kEqualPrimaries = 1.15;
// What no picture is better than: 0.3 % of the light, squared.
constexpr double kLeastUnexplained = 1e-5;
// Where less than this share of the light is of the caustic direct light says alone which primaries
// they are. Colours of the caustic may be wrong for other reasons: by what a body absorbs.
constexpr float kMaxCausticOfDirect = 0.02f;

constexpr std::initializer_list<Role> kPlacedLight = {Role::direct, Role::lightClass, Role::shiftX,
                                                      Role::shiftY};
constexpr std::initializer_list<Role> kEverything = {Role::direct, Role::lightClass, Role::shiftX,
                                                     Role::shiftY, Role::cause,      Role::fill};

// Mistakes that were made as a whole have noise that is in no error, and that other primaries,
// which mix the channels, make less.
std::vector<std::size_t> columnsToTellBy(const Comparison& comparison) {
    std::vector<std::size_t> columns = columnsOf(comparison, kEverything);
    std::erase_if(columns, [&](std::size_t column) {
        const Column& of = comparison.columns[column];
        return of.role == Role::cause &&
               comparison.subject.causes[of.index].kind == CauseKind::whole;
    });
    return columns;
}

// Gives what `measure` does with the reference's light in other primaries. The picture stays as it
// is, and with it its noise: in another space that has another size. Weights are not changed.
// Nothing is taken off for the noise of the reference: what its channels share, since photons are
// of one colour, is as much in each space, and no error says how much that is.
template <class Measure>
double inSpace(Comparison& comparison, Primaries primaries, const Measure& measure) {
    const glm::dmat3 matrix = glm::inverse(toRec709(primaries));
    std::vector<Column> columns;
    for (const Column& column : comparison.columns)
        columns.push_back({column.role, column.index, transformed(column.image, matrix), {}});
    std::swap(columns, comparison.columns);
    const double result = measure();
    std::swap(columns, comparison.columns);
    return result;
}

double unexplained(Comparison& comparison) {
    makeEquations(comparison);
    return fit(comparison, columnsOf(comparison, kPlacedLight)).chiSquared /
           std::max(comparison.equations.squares, 1e-300);
}

// With coefficients of their own for each channel: a white balance, or a light's colour, is no
// other primaries, and in a picture of one colour it looks the same.
double unexplainedByChannel(Comparison& comparison) {
    const Image weight = comparison.weight;
    double left = 0.0;
    double squares = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < weight.values.size(); ++i)
            comparison.weight.values[i] = i % 3 == channel ? weight.values[i] : 0.0f;
        makeEquations(comparison);
        left += fit(comparison, columnsToTellBy(comparison)).chiSquared;
        squares += comparison.equations.squares;
    }
    comparison.weight = weight;
    return std::max(left, 0.0) / std::max(squares, 1e-300) + kLeastUnexplained;
}

// Whether light that came directly speaks for these primaries as well, where there is such.
bool isBorneOutByDirectLight(Comparison& comparison, Primaries primaries) {
    const std::vector<std::size_t> direct = columnsOf(comparison, {Role::direct});
    if (direct.empty()) return true;
    const Image& light = comparison.columns[direct.front()].image;
    const Image& caustic =
        comparison.columns[columnsOf(comparison, {Role::allClasses}).front()].image;
    const Image weight = comparison.weight;
    for (std::size_t i = 0; i < weight.values.size(); ++i) {
        if (!(caustic.values[i] < kMaxCausticOfDirect * light.values[i]))
            comparison.weight.values[i] = 0.0f;
    }
    const auto score = [&] { return unexplainedByChannel(comparison); };
    const double rule = inSpace(comparison, Primaries::rec709, score);
    const double found = inSpace(comparison, primaries, score);
    comparison.weight = weight;
    return found < kMaxLossOfPrimaries * rule;
}

}  // namespace

std::vector<double> decideEncoding(Comparison& comparison) {
    const bool isAsked = comparison.options.primaries != Primaries::automatic;
    comparison.primaries = isAsked ? comparison.options.primaries : Primaries::rec709;
    if (comparison.options.encoding != Encoding::automatic) {
        comparison.encoding = comparison.options.encoding;
        align(comparison);
        return {};
    }
    std::vector<double> scores;
    double best = 0.0;
    Encoding found = Encoding::linear;
    for (const Encoding encoding : {Encoding::linear, Encoding::srgb, Encoding::gamma22}) {
        comparison.encoding = encoding;
        align(comparison);
        weighByLight(comparison);
        double least = unexplained(comparison);
        for (const Primaries primaries : kAllPrimaries) {
            if (isAsked || primaries == Primaries::rec709) continue;
            least = std::min(
                least, inSpace(comparison, primaries, [&] { return unexplained(comparison); }));
        }
        scores.push_back(least);
        // Linear is the rule; of the others the better one.
        if (encoding == Encoding::linear || least < kMaxLossOfEncoding * best ||
            (found != Encoding::linear && least < best)) {
            best = least;
            found = encoding;
        }
    }
    comparison.encoding = found;
    align(comparison);
    return scores;
}

std::vector<Primaries> decidePrimaries(Comparison& comparison) {
    if (comparison.options.primaries != Primaries::automatic) return {};
    comparison.primaries = Primaries::rec709;
    align(comparison);
    weighByLight(comparison);
    std::vector<double> scores;
    for (const Primaries primaries : kAllPrimaries) {
        scores.push_back(
            inSpace(comparison, primaries, [&] { return unexplainedByChannel(comparison); }));
    }
    const auto best =
        static_cast<std::size_t>(std::min_element(scores.begin(), scores.end()) - scores.begin());
    // Rec. 709 is the rule, and the first.
    const bool isOther = scores[best] < kMaxLossOfPrimaries * scores.front() &&
                         isBorneOutByDirectLight(comparison, kAllPrimaries[best]);
    const std::size_t found = isOther ? best : 0;
    std::vector<Primaries> others;
    for (std::size_t k = 0; k < scores.size(); ++k) {
        if (k != found && scores[k] < kEqualPrimaries * scores[found])
            others.push_back(kAllPrimaries[k]);
    }
    comparison.primaries = kAllPrimaries[found];
    align(comparison);
    return others;
}

}  // namespace kaustik::judge
