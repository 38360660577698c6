// SPDX-License-Identifier: MIT
// Balls of glass above a floor, as scene text, and how far directions lie apart.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/numerics/cases/scene_text.h"

namespace kaustik::test {

inline std::string floorBelow(double height = -2.0) {
    return numerics::floorPlane("floor", "grey", 16.0, {0, height, 0});
}
inline std::string ballAt(const std::string& name, const glm::dvec3& center, double radius) {
    return numerics::object(name, "sphere", "glass", center,
                            fmt::format("radius = {}\nsegments = 640", numerics::number(radius)));
}

inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}
inline double medianOf(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace kaustik::test
