// SPDX-License-Identifier: MIT
// Points, vectors and transforms of a Mitsuba scene. A transform is a list of steps, each applied
// after those before it.
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "framework/importers/mitsuba_document.h"

namespace kaustik::scene {
namespace {

// x, y and z in attributes of their own, or all three in `value`.
glm::dvec3 vectorOf(const MitsubaElement& element, double otherwise) {
    if (!element.has("value")) {
        const auto part = [&](const char* name) {
            return element.has(name) ? parseOneNumber(element.attribute(name), element.place)
                                     : otherwise;
        };
        return {part("x"), part("y"), part("z")};
    }
    const std::vector<double> numbers = parseNumbers(element.attribute("value"), element.place);
    if (numbers.size() == 1) return glm::dvec3(numbers[0]);
    if (numbers.size() != 3) failAt(element.place, "three numbers are needed here.");
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dvec3 threeNumbers(const MitsubaElement& element, const char* name) {
    const std::vector<double> numbers = parseNumbers(element.required(name), element.place);
    if (numbers.size() != 3) failAt(element.place, fmt::format("'{}' needs three numbers.", name));
    return {numbers[0], numbers[1], numbers[2]};
}

// Its z looks at the target, its x points to the left of that.
glm::dmat4 lookAt(const MitsubaElement& element) {
    const glm::dvec3 origin = threeNumbers(element, "origin");
    const glm::dvec3 forward = threeNumbers(element, "target") - origin;
    const glm::dvec3 up = element.has("up") ? threeNumbers(element, "up") : glm::dvec3(0, 1, 0);
    const glm::dvec3 left = glm::cross(up, forward);
    const double size = glm::length(up) * glm::length(forward);
    if (!(glm::length(left) > 1e-9 * size) || !(size > 0.0))
        failAt(element.place, "this looks nowhere: up and the way to the target are parallel.");
    const glm::dvec3 z = glm::normalize(forward);
    const glm::dvec3 x = glm::normalize(left);
    return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
            glm::dvec4(origin, 1.0)};
}

// Row by row.
glm::dmat4 matrixOf(const MitsubaElement& element) {
    const std::vector<double> numbers = parseNumbers(element.required("value"), element.place);
    if (numbers.size() != 16 && numbers.size() != 9)
        failAt(element.place, "a matrix has 16 numbers, or 9.");
    const int side = numbers.size() == 16 ? 4 : 3;
    glm::dmat4 matrix(1.0);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column)
            matrix[column][row] = numbers[static_cast<std::size_t>(row * side + column)];
    }
    if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0)
        failAt(element.place, "the last row of a matrix is 0 0 0 1.");
    return matrix;
}

glm::dmat4 stepOf(const MitsubaElement& element) {
    const glm::dmat4 one(1.0);
    if (element.tag == "translate") return glm::translate(one, vectorOf(element, 0.0));
    if (element.tag == "scale") return glm::scale(one, vectorOf(element, 1.0));
    if (element.tag == "lookat") return lookAt(element);
    if (element.tag == "matrix") return matrixOf(element);
    if (element.tag != "rotate")
        failAt(element.place, fmt::format("<{}> is no part of a transform.", element.tag));
    const glm::dvec3 axis = vectorOf(element, 0.0);
    if (!(glm::length(axis) > 1e-12)) failAt(element.place, "a rotation needs an axis.");
    const double degrees = parseOneNumber(element.required("angle"), element.place);
    return glm::rotate(one, glm::radians(degrees), glm::normalize(axis));
}

}  // namespace

glm::dvec3 MitsubaElement::point(const char* name, const glm::dvec3& otherwise) const {
    const MitsubaElement* const found = child(name);
    return found != nullptr ? vectorOf(*found, 0.0) : otherwise;
}

glm::dmat4 MitsubaElement::transform(const char* name) const {
    const MitsubaElement* const found = child(name);
    glm::dmat4 matrix(1.0);
    if (found == nullptr) return matrix;
    for (const MitsubaElement& element : found->children) {
        element.isUsed = true;
        matrix = stepOf(element) * matrix;
    }
    requireFinite(matrix, found->place);
    return matrix;
}

}  // namespace kaustik::scene
