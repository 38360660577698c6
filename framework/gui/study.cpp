// SPDX-License-Identifier: MIT
#include "framework/gui/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik::gui {
namespace {

// Of a value, for who says what is wrong with it.
constexpr std::string_view kPlace = "the study";

std::vector<std::string> wordsOf(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    const auto end = [&] {
        // "1, 2" is two values; within a number a comma is for the parameter to refuse.
        if (word.ends_with(',')) word.pop_back();
        if (!word.empty()) words.push_back(word);
        word.clear();
    };
    for (const char c : text) {
        if (c == ' ' || c == '\t' || c == ';') {
            end();
        } else {
            word += c;
        }
    }
    end();
    return words;
}

// The value as the parameter writes it.
std::string parameterText(const std::string& key, const std::string& word,
                          params::ParamSet& params) {
    params.set(key, word, kPlace);
    return params.find(key).text();
}

std::string valueOf(const Variant& variant, const std::string& key) {
    if (key == kTechniqueKey) return variant.technique;
    const auto found = variant.assignments.find(key);
    return found != variant.assignments.end() ? found->second : std::string();
}

}  // namespace

TypedAxis typedAxis(const std::string& key, const std::string& text, const Variant& variant,
                    const Registry& registry) {
    TypedAxis typed{{key, {}}, ""};
    try {
        params::ParamSet params = settingsOf(variant, {1, 1}, registry).params;
        for (const std::string& word : wordsOf(text)) {
            const std::string value = key == kTechniqueKey
                                          ? registry.findTechnique(word, variant.isAsPublished).name
                                          : parameterText(key, word, params);
            std::vector<std::string>& values = typed.axis.values;
            if (std::find(values.begin(), values.end(), value) == values.end())
                values.push_back(value);
        }
        if (typed.axis.values.empty()) typed.problem = fmt::format("{} has no value yet.", key);
    } catch (const Error& error) {
        // Without the place, which is above the sentence.
        typed.problem = error.what();
        if (typed.problem.starts_with(kPlace)) typed.problem.erase(0, kPlace.size() + 2);
    }
    return typed;
}

std::size_t runCount(const std::vector<StudyAxis>& axes) {
    std::size_t count = 1;
    for (const StudyAxis& axis : axes) {
        count *= axis.values.size();
        if (count > kMaxStudyRuns) return kMaxStudyRuns + 1;
    }
    return count;
}

std::vector<Variant> variantsOf(const Study& study) {
    std::vector<Variant> variants = {study.document.variant};
    for (const StudyAxis& axis : study.axes) {
        std::vector<Variant> more;
        for (const Variant& variant : variants) {
            for (const std::string& value : axis.values) {
                more.push_back(variant);
                if (axis.key == kTechniqueKey) {
                    more.back().technique = value;
                } else {
                    more.back().assignments[axis.key] = value;
                }
            }
        }
        variants = std::move(more);
    }
    return variants;
}

std::string variedText(const Study& study, const Variant& variant) {
    std::string text;
    for (const StudyAxis& axis : study.axes) {
        const std::string value = valueOf(variant, axis.key);
        text += text.empty() ? "" : ", ";
        // A technique's name says itself what it is.
        text += axis.key == kTechniqueKey ? value : axis.key + "=" + value;
    }
    return text;
}

double expectedSeconds(const Study& study, int frames, const KnownTimes& known,
                       const std::vector<SettledPoint>& points) {
    double seconds = 0.0;
    const int all = frames + kStudyWarmup + 1;
    for (const Variant& variant : variantsOf(study)) {
        Document document = study.document;
        document.variant = variant;
        const auto point = std::find_if(points.begin(), points.end(), [&](const SettledPoint& p) {
            return p.document == document && p.isPrecise == known.isPrecise;
        });
        const double frameMs = point != points.end() ? point->frameMs : known.frameMs;
        seconds += known.startSeconds + 1e-3 * frameMs * all;
    }
    return seconds;
}

std::string durationText(double seconds) {
    if (!(seconds < 90.0)) {
        const auto minutes = static_cast<long long>(std::ceil(seconds / 60.0));
        if (minutes < 90) return fmt::format("{} min", minutes);
        return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
    }
    return fmt::format("{} s", std::max(1LL, std::llround(std::ceil(seconds))));
}

}  // namespace kaustik::gui
