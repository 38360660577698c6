// SPDX-License-Identifier: MIT
#include "framework/params/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/core/number_text.h"
#include "framework/core/overloaded.h"

namespace kaustik::params {
namespace {

template <class T>
std::optional<T> parseNumber(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<Extent> parseExtent(std::string_view text) {
    const auto cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const auto width = parseNumber<int>(text.substr(0, cross));
    const auto height = parseNumber<int>(text.substr(cross + 1));
    if (!width || !height) return std::nullopt;
    return Extent{*width, *height};
}

std::optional<bool> parseBool(std::string_view text) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
    return std::nullopt;
}

[[noreturn]] void refuse(std::string_view where, std::string_view fullName, std::string_view text,
                         const std::string& expected) {
    throw ConfigError(
        fmt::format("{}: {} cannot be '{}'; it takes {}.", where, fullName, text, expected));
}

bool takes(const Field& field, int value) {
    if (field.values.empty()) return value >= field.minimum && value <= field.maximum;
    return std::find(field.values.begin(), field.values.end(), value) != field.values.end();
}

}  // namespace

std::string Field::typeName() const {
    return std::visit(Overloaded{[](bool*) { return "bool"; }, [](int*) { return "int"; },
                                 [](float*) { return "float"; }, [](Extent*) { return "WxH"; },
                                 [](ChoiceRef) { return "choice"; }},
                      target);
}

std::string Field::rangeText() const {
    return std::visit(
        Overloaded{[](bool*) { return std::string("true | false"); },
                   [&](ChoiceRef) { return fmt::format("{}", fmt::join(choices, " | ")); },
                   [&](Extent*) {
                       return fmt::format("{0:.0f}x{0:.0f} to {1:.0f}x{1:.0f}", minimum, maximum);
                   },
                   [&](auto*) {
                       if (!values.empty()) return fmt::format("{}", fmt::join(values, " | "));
                       return numberText(minimum) + " to " + numberText(maximum);
                   }},
        target);
}

std::string Field::text() const {
    return std::visit(
        Overloaded{[](const bool* v) { return std::string(*v ? "true" : "false"); },
                   [](const Extent* v) { return fmt::format("{}x{}", v->width, v->height); },
                   [&](ChoiceRef v) { return choices[static_cast<std::size_t>(*v.index)]; },
                   [](const auto* v) { return fmt::format("{}", *v); }},
        target);
}

nlohmann::json Field::json() const {
    return std::visit(Overloaded{[](const bool* v) { return nlohmann::json(*v); },
                                 [](const int* v) { return nlohmann::json(*v); },
                                 // The shortest decimal that reads back as the same float.
                                 [&](const float*) { return nlohmann::json::parse(text()); },
                                 [&](const Extent*) { return nlohmann::json(text()); },
                                 [&](ChoiceRef) { return nlohmann::json(text()); }},
                      target);
}

Field& Field::when(Condition whyNoEffect) {
    conditions.push_back(std::move(whyNoEffect));
    return *this;
}

Field& Field::when(bool hasEffect, const std::string& otherwise) {
    if (!hasEffect && obstacle.empty()) obstacle = otherwise;
    return *this;
}

Field& Field::only(std::vector<int> theseValues) {
    assert(std::holds_alternative<int*>(target) && "only a whole number can be one of a list");
    values = std::move(theseValues);
    assert(std::is_sorted(values.begin(), values.end()) && values.front() >= minimum &&
           values.back() <= maximum && "a list is ascending and within the range");
    assert(std::find(values.begin(), values.end(), *std::get<int*>(target)) != values.end() &&
           "the default is of the list");
    return *this;
}

void Field::set(std::string_view text, std::string_view fullName, std::string_view where) const {
    const std::string limits = numberText(minimum) + " to " + numberText(maximum);
    const std::string number =
        fmt::format("number from {}{}{}", limits, unit.empty() ? "" : " ", unit);
    std::visit(
        Overloaded{[&](bool* v) {
                       const auto parsed = parseBool(text);
                       if (!parsed) refuse(where, fullName, text, "true or false");
                       *v = *parsed;
                   },
                   [&](int* v) {
                       const auto parsed = parseNumber<int>(text);
                       if (!parsed || !takes(*this, *parsed)) {
                           refuse(where, fullName, text,
                                  values.empty() ? "a whole " + number
                                                 : fmt::format("{}", fmt::join(values, ", ")));
                       }
                       *v = *parsed;
                   },
                   [&](float* v) {
                       const auto parsed = parseNumber<float>(text);
                       // Compared as floats, since the limits were declared as floats.
                       const bool inside = parsed && std::isfinite(*parsed) &&
                                           *parsed >= static_cast<float>(minimum) &&
                                           *parsed <= static_cast<float>(maximum);
                       if (!inside) refuse(where, fullName, text, "a " + number);
                       *v = *parsed;
                   },
                   [&](Extent* v) {
                       const auto parsed = parseExtent(text);
                       const auto inside = [&](int side) {
                           return side >= minimum && side <= maximum;
                       };
                       if (!parsed || !inside(parsed->width) || !inside(parsed->height)) {
                           refuse(where, fullName, text, "WIDTHxHEIGHT, each from " + limits);
                       }
                       *v = *parsed;
                   },
                   [&](ChoiceRef v) {
                       for (std::size_t i = 0; i < choices.size(); ++i) {
                           if (choices[i] == text) {
                               *v.index = static_cast<int>(i);
                               return;
                           }
                       }
                       throw ConfigError(fmt::format("{}: {} cannot be '{}'{}; it takes {}.", where,
                                                     fullName, text, didYouMean(text, choices),
                                                     fmt::join(choices, ", ")));
                   }},
        target);
}

Field& FieldList::field(float& value, std::string name, std::string sentence, std::string unit,
                        Range<float> allowed) {
    return fields_.emplace_back(Field{std::move(name),
                                      std::move(sentence),
                                      std::move(unit),
                                      &value,
                                      allowed.minimum,
                                      allowed.maximum,
                                      {}});
}

Field& FieldList::field(int& value, std::string name, std::string sentence, std::string unit,
                        Range<int> allowed) {
    return fields_.emplace_back(Field{std::move(name),
                                      std::move(sentence),
                                      std::move(unit),
                                      &value,
                                      static_cast<double>(allowed.minimum),
                                      static_cast<double>(allowed.maximum),
                                      {}});
}

Field& FieldList::field(bool& value, std::string name, std::string sentence) {
    return fields_.emplace_back(
        Field{std::move(name), std::move(sentence), "", &value, 0.0, 1.0, {}});
}

Field& FieldList::field(Extent& value, std::string name, std::string sentence, std::string unit,
                        Range<int> allowedSide) {
    return fields_.emplace_back(Field{std::move(name),
                                      std::move(sentence),
                                      std::move(unit),
                                      &value,
                                      static_cast<double>(allowedSide.minimum),
                                      static_cast<double>(allowedSide.maximum),
                                      {}});
}

void FieldList::renamed(std::string_view formerName, std::string_view name) {
    const auto found = std::find_if(fields_.begin(), fields_.end(),
                                    [&](const Field& field) { return field.name == name; });
    assert(found != fields_.end() && "the parameter is declared before its former name");
    found->formerName = formerName;
}

Field& FieldList::addChoice(int& index, std::string name, std::string sentence,
                            std::vector<std::string> names) {
    if (index < 0 || static_cast<std::size_t>(index) >= names.size()) {
        throw ConfigError(
            fmt::format("The default of the choice '{}' is number {} of its {} names.", name, index,
                        names.size()));
    }
    return fields_.emplace_back(Field{std::move(name), std::move(sentence), "", ChoiceRef{&index},
                                      0.0, 0.0, std::move(names)});
}

}  // namespace kaustik::params
