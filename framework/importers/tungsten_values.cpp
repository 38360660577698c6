// SPDX-License-Identifier: MIT
// Numbers, texts, transforms and colours of a Tungsten scene.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/core/names.h"
#include "framework/importers/tungsten_parts.h"

namespace kaustik::scene {
namespace {

constexpr double kLargestNumber = 1e9;  // no scene file takes a larger one

double numberOf(const JsonTree& node) {
    const auto* const number = node.as<double>();
    if (number == nullptr || !(std::abs(*number) <= kLargestNumber))
        failAt(node.place, "a number is needed here.");
    return *number;
}

// Three numbers, or one for all.
glm::dvec3 vectorOf(const JsonTree& node) {
    const auto* const list = node.as<JsonTree::List>();
    if (list == nullptr) return glm::dvec3(numberOf(node));
    if (list->size() != 3) failAt(node.place, "three numbers are needed here, or one.");
    node.markUsed();
    return {numberOf((*list)[0]), numberOf((*list)[1]), numberOf((*list)[2])};
}

glm::dmat4 matrixOf(const JsonTree::List& numbers, const std::string& place) {
    if (numbers.size() != 16) failAt(place, "a matrix has 16 numbers.");
    glm::dmat4 matrix(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = numberOf(numbers[static_cast<std::size_t>(row * 4 + column)]);
    }
    return matrix;
}

// About z, then x, then y, the last one clockwise as seen from above.
glm::dmat3 rotationYxz(const glm::dvec3& degrees) {
    const glm::dvec3 angles = glm::radians(degrees);
    glm::dmat4 matrix(1.0);
    matrix = glm::rotate(matrix, -angles.y, glm::dvec3(0.0, 1.0, 0.0));
    matrix = glm::rotate(matrix, angles.x, glm::dvec3(1.0, 0.0, 0.0));
    return glm::dmat3(glm::rotate(matrix, angles.z, glm::dvec3(0.0, 0.0, 1.0)));
}

// At right angles to those before it, as near to `wanted` as that allows.
glm::dvec3 perpendicular(glm::dvec3 wanted, const std::vector<glm::dvec3>& others,
                         const std::string& place) {
    const double length = glm::length(wanted);
    for (const glm::dvec3& other : others)
        wanted -= other * glm::dot(other, wanted);
    if (glm::length(wanted) > 1e-7 * length && length > 0.0) return glm::normalize(wanted);
    if (others.empty()) failAt(place, "this transform looks nowhere.");
    // Whatever is free will do, as nobody has said it or what was said is parallel.
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        glm::dvec3 free = axis;
        for (const glm::dvec3& other : others)
            free -= other * glm::dot(other, free);
        if (glm::length(free) > 0.5) return glm::normalize(free);
    }
    failAt(place, "this transform looks nowhere.");
}

// Right angles between x, y and z, which are kept in this order: what is given, and z, y, x.
glm::dmat3 axesOf(const JsonTree& node, const glm::dvec3& position) {
    std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    std::array<bool, 3> isGiven{};
    const auto take = [&](std::size_t axis, const char* key, const glm::dvec3& from) {
        if (node.find(key) == nullptr) return;
        axes[axis] = jsonVector(node, key, axes[axis]) - from;
        isGiven[axis] = true;
    };
    take(2, "look_at", position);
    take(1, "up", glm::dvec3(0.0));
    take(0, "x_axis", glm::dvec3(0.0));
    take(1, "y_axis", glm::dvec3(0.0));
    take(2, "z_axis", glm::dvec3(0.0));
    std::vector<glm::dvec3> done;
    for (const bool given : {true, false}) {
        for (const std::size_t axis : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
            if (isGiven[axis] != given) continue;
            axes[axis] = perpendicular(axes[axis], done, node.place);
            done.push_back(axes[axis]);
        }
    }
    if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) {
        const std::size_t turned = !isGiven[0] ? 0 : !isGiven[1] ? 1 : 2;
        axes[turned] = -axes[turned];
    }
    return {axes[0], axes[1], axes[2]};
}

ForeignColor textureOf(TungstenImport& importer, const JsonTree& node) {
    ForeignColor result{.color = glm::dvec3(1.0)};
    const std::string type = jsonText(node, "type");
    if (type == "constant") {
        result.color = jsonVector(node, "value", glm::dvec3(1.0));
    } else if (type == "bitmap") {
        const JsonTree* const file = node.find("file");
        if (file == nullptr || file->as<std::string>() == nullptr)
            failAt(node.place, "a bitmap needs a 'file'.");
        result.image = ForeignImage{importer.folder / *file->as<std::string>(), file->place};
    } else if (type == "checker") {
        // Squares are counted across the surface; those at its corner have the second colour.
        result.pattern = Pattern::checker;
        result.color = jsonVector(node, "off_color", glm::dvec3(0.2));
        result.second = jsonVector(node, "on_color", glm::dvec3(0.8));
        result.uvScale = glm::max(
            glm::dvec2(jsonNumber(node, "res_u", 20.0), jsonNumber(node, "res_v", 20.0)), 1e-6);
    } else if (type == "blackbody") {
        result.color = colorOfBlackbody(jsonNumber(node, "temperature", 6500.0));
    } else {
        result.color = glm::dvec3(0.5);
        importer.leaveOut("texture", node, "there is no such texture; it is grey");
    }
    return result;
}

}  // namespace

double jsonNumber(const JsonTree& node, const char* key, double otherwise) {
    const JsonTree* const found = node.find(key);
    return found != nullptr ? numberOf(*found) : otherwise;
}

bool jsonFlag(const JsonTree& node, const char* key, bool otherwise) {
    const JsonTree* const found = node.find(key);
    if (found == nullptr) return otherwise;
    if (found->as<bool>() == nullptr)
        failAt(found->place, fmt::format("'{}' is true or false.", key));
    return *found->as<bool>();
}

std::string jsonText(const JsonTree& node, const char* key, const std::string& otherwise) {
    const JsonTree* const found = node.find(key);
    if (found == nullptr) return otherwise;
    if (found->as<std::string>() == nullptr)
        failAt(found->place, fmt::format("'{}' is a text.", key));
    return *found->as<std::string>();
}

glm::dvec3 jsonVector(const JsonTree& node, const char* key, const glm::dvec3& otherwise) {
    const JsonTree* const found = node.find(key);
    return found != nullptr ? vectorOf(*found) : otherwise;
}

glm::dmat4 jsonTransform(const JsonTree& node) {
    const JsonTree* const found = node.find("transform");
    if (found == nullptr) return glm::dmat4(1.0);
    glm::dmat4 matrix(1.0);
    if (const auto* const list = found->as<JsonTree::List>()) {
        found->markUsed();
        matrix = matrixOf(*list, found->place);
    } else if (found->as<JsonTree::Object>() != nullptr) {
        const glm::dvec3 position = jsonVector(*found, "position", glm::dvec3(0.0));
        glm::dmat3 axes = axesOf(*found, position);
        const glm::dvec3 scale = jsonVector(*found, "scale", glm::dvec3(1.0));
        for (int i = 0; i < 3; ++i)
            axes[i] *= scale[i];
        matrix = glm::dmat4(rotationYxz(jsonVector(*found, "rotation", glm::dvec3(0.0))) * axes);
        matrix[3] = glm::dvec4(position, 1.0);
    } else {
        failAt(found->place, "a transform is an object or 16 numbers.");
    }
    requireFinite(matrix, found->place);
    return matrix;
}

ForeignColor surfaceColor(TungstenImport& importer, const JsonTree& node, const char* key,
                          const glm::dvec3& otherwise) {
    ForeignColor result{.color = glm::dvec3(1.0)};
    result.color = otherwise;
    const JsonTree* const found = node.find(key);
    if (found == nullptr) return result;
    if (found->as<JsonTree::Object>() != nullptr) return textureOf(importer, *found);
    if (const auto* const text = found->as<std::string>()) {
        const auto color = parseHexColor(*text);
        result.color = color.value_or(glm::dvec3(1.0));
        if (!color) result.image = ForeignImage{importer.folder / *text, found->place};
        return result;
    }
    result.color = vectorOf(*found);
    return result;
}

glm::dvec3 evenColor(TungstenImport& importer, const JsonTree& node, const char* key,
                     const glm::dvec3& otherwise) {
    const ForeignColor color = surfaceColor(importer, node, key, otherwise);
    if (!color.image && color.pattern == Pattern::none) return color.color;
    importer.notes.leftOut(fmt::format("texture of '{}'", key), node.place,
                           "there is only an even colour here");
    return otherwise;
}

const JsonTree& namedNode(const JsonTree& root, const char* list, const JsonTree& name) {
    const auto* const wanted = name.as<std::string>();
    if (wanted == nullptr) failAt(name.place, "a name is needed here.");
    const JsonTree* const found = root.find(list);
    const auto* const nodes = found != nullptr ? found->as<JsonTree::List>() : nullptr;
    if (nodes == nullptr)
        failAt(name.place,
               fmt::format("there is no '{}', since the file has no {}.", *wanted, list));
    std::vector<std::string> names;
    for (const JsonTree& node : *nodes) {
        const std::string other = jsonText(node, "name");
        if (other == *wanted) {
            node.isUsed = true;
            return node;
        }
        names.push_back(other);
    }
    const std::string suggestion = didYouMean(*wanted, names);
    failAt(name.place, fmt::format("there is no '{}' in {}{}", *wanted, list,
                                   suggestion.empty() ? "." : suggestion));
}

}  // namespace kaustik::scene
