// SPDX-License-Identifier: MIT
#include "framework/importers/foreign_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/importers/mesh_formats.h"

namespace kaustik::scene {
namespace {

constexpr double kLargestNumber = 1e9;  // no scene file takes a larger one

}  // namespace

void failAt(const std::string& place, const std::string& what) {
    throw ConfigError(fmt::format("{}: {}", place, what));
}

std::vector<double> parseNumbers(std::string_view text, const std::string& place) {
    std::string blanks(text);
    std::replace_if(
        blanks.begin(), blanks.end(), [](char c) { return c == ',' || c == '\n'; }, ' ');
    std::string_view rest = blanks;
    std::vector<double> numbers;
    for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) {
        double number = 0.0;
        // Not `>`: what is no number is beyond every limit.
        if (!parseNumber(word, number) || !(std::abs(number) <= kLargestNumber))
            failAt(place, fmt::format("'{}' is not a number.", word));
        numbers.push_back(number);
    }
    return numbers;
}

double parseOneNumber(std::string_view text, const std::string& place) {
    const std::vector<double> numbers = parseNumbers(text, place);
    if (numbers.size() != 1) failAt(place, fmt::format("'{}' is not a number.", text));
    return numbers[0];
}

void requireFinite(const glm::dmat4& matrix, const std::string& place) {
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            if (!(std::abs(matrix[i][j]) <= kLargestNumber))
                failAt(place, "this transform has numbers that are too large.");
        }
    }
}

double exponentOfRoughness(double alpha) {
    return std::clamp(2.0 / std::max(alpha * alpha, 1e-9) - 2.0, 1.0, 10000.0);
}

glm::vec3 reflectanceOf(const glm::dvec3& color) {
    return glm::vec3(glm::clamp(color, 0.0, 1.0));
}

void setGlossy(Material& material, const glm::dvec3& diffuse, const glm::dvec3& specular,
               double exponent) {
    material.kind = MaterialKind::glossy;
    const glm::dvec3 lobe(reflectanceOf(specular));
    // A little below, so that rounding in the file does not lift the sum above 1.
    material.specular = glm::vec3(lobe * 0.9999);
    material.albedo =
        glm::vec3(glm::min(glm::dvec3(reflectanceOf(diffuse)), 0.9999 * (1.0 - lobe)));
    material.exponent = static_cast<float>(std::clamp(exponent, 1.0, 10000.0));
}

double verticalFov(double degrees, double extentOverHeight) {
    const double half = std::tan(glm::radians(0.5 * degrees));
    return glm::degrees(2.0 * std::atan(half / std::max(extentOverHeight, 1e-6)));
}

double environmentTurn(const glm::dvec3& direction) {
    const double degrees = glm::degrees(std::atan2(-direction.x, -direction.z));
    return degrees == 0.0 ? 0.0 : degrees;  // no -0
}

void aimCamera(Camera& camera, const glm::dvec3& position, const glm::dvec3& forward,
               const glm::dvec3& up, const std::string& place) {
    const double forwardLength = glm::length(forward);
    const double upLength = glm::length(up);
    if (!(forwardLength > 1e-12) || !(upLength > 1e-12) ||
        glm::length(glm::cross(forward, up)) < 1e-5 * forwardLength * upLength)
        failAt(place, "the camera's transform gives no direction to look in.");
    camera.position = position;
    camera.target = position + forward / forwardLength;
    camera.up = up / upLength;
}

ForeignNotes::ForeignNotes(std::vector<ForeignNote>& notes, const std::filesystem::path& folder)
    : notes_(notes), prefix_(folder.empty() ? "" : (folder / "").string()) {}

void ForeignNotes::leftOut(const std::string& subject, const std::string& place,
                           const std::string& reason) {
    add(NoteKind::leftOut, subject, place, reason);
}

void ForeignNotes::changed(const std::string& subject, const std::string& place,
                           const std::string& reason) {
    add(NoteKind::changed, subject, place, reason);
}

void ForeignNotes::add(NoteKind kind, const std::string& subject, const std::string& place,
                       const std::string& reason) {
    const bool isWithin = !prefix_.empty() && place.starts_with(prefix_);
    notes_.push_back({kind, subject, isWithin ? place.substr(prefix_.size()) : place, reason});
}

void setColor(ForeignMaterial& foreign, const ForeignColor& color) {
    Material& material = foreign.material;
    material.kind = MaterialKind::lambertian;
    material.albedo = reflectanceOf(color.color);
    material.pattern = color.pattern;
    material.patternAlbedo = reflectanceOf(color.second);
    material.uvScale = glm::vec2(color.uvScale);
    foreign.image = color.image;
    foreign.turnsTexture = color.turnsTexture;
}

}  // namespace kaustik::scene
