// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/core/json_text.h"
#include "framework/core/names.h"

namespace kaustik::scene {
namespace {

// Below this a number is what rounding has left of 0; micrometres are above it.
constexpr double kSmallestNumber = 1e-9;
constexpr int kFewDigits = 6;    // what a number of 32 bits surely has
constexpr int kPlaceDigits = 8;  // far from the origin a place needs more

std::string withDigits(double number, int digits) {
    return std::abs(number) < kSmallestNumber ? "0" : fmt::format("{:.{}g}", number, digits);
}

}  // namespace

std::string oneLine(const std::string& text) {
    // As JSON it is valid UTF-8, and read back it is the same text.
    auto valid = nlohmann::json::parse(jsonText(nlohmann::json(text))).get<std::string>();
    std::replace_if(
        valid.begin(), valid.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    return valid;
}

std::string takeName(const std::string& name, std::set<std::string>& taken) {
    const std::string wanted = oneLine(name.empty() ? "unnamed" : name);
    std::string free = wanted;
    for (int i = 2; !taken.insert(free).second; ++i)
        free = fmt::format("{}-{}", wanted, i);
    return free;
}

std::string fewDigits(double number) {
    return withDigits(number, kFewDigits);
}

void TomlLines::comment(const std::string& text) {
    text_ += "# " + oneLine(text) + "\n";
}

void TomlLines::table(std::string_view head) {
    text_ += fmt::format("\n{}\n", head);
}

void TomlLines::line(std::string_view key, const std::string& value) {
    text_ += fmt::format("{} = {}\n", key, value);
}

void TomlLines::set(std::string_view key, const std::string& value) {
    line(key, tomlString(oneLine(value)));
}

void TomlLines::set(std::string_view key, double value) {
    line(key, fewDigits(value));
}

void TomlLines::set(std::string_view key, bool value) {
    line(key, value ? "true" : "false");
}

void TomlLines::set(std::string_view key, const glm::dvec2& value) {
    line(key, fmt::format("[{}, {}]", fewDigits(value.x), fewDigits(value.y)));
}

void TomlLines::set(std::string_view key, const glm::dvec3& value) {
    setThree(key, value, kPlaceDigits);
}

void TomlLines::setColor(std::string_view key, const glm::dvec3& value) {
    const std::string red = fewDigits(value.r);
    if (red == fewDigits(value.g) && red == fewDigits(value.b)) return set(key, value.r);
    setThree(key, value, kFewDigits);
}

void TomlLines::setThree(std::string_view key, const glm::dvec3& value, int digits) {
    line(key, fmt::format("[{}, {}, {}]", withDigits(value.x, digits), withDigits(value.y, digits),
                          withDigits(value.z, digits)));
}

void TomlLines::setUnless(const glm::dvec3& otherwise, std::string_view key,
                          const glm::dvec3& value) {
    const glm::dvec3 difference = glm::abs(value - otherwise);
    if (std::max({difference.x, difference.y, difference.z}) >= kSmallestNumber) set(key, value);
}

}  // namespace kaustik::scene
