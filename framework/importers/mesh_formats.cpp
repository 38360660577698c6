// SPDX-License-Identifier: MIT
#include "framework/importers/mesh_formats.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "framework/importers/polygon.h"

namespace kaustik::scene {

void MeshFileContents::addVertex(const glm::vec3& position, const glm::vec3& normal,
                                 const glm::vec2& uv) {
    soup.positions.emplace_back(position);
    soup.normals.push_back(normal);
    soup.uvs.push_back(uv);
}

void MeshFileContents::addPolygon(const std::vector<std::uint32_t>& corners) {
    if (corners.size() == 3) {
        soup.triangles.emplace_back(corners[0], corners[1], corners[2]);
        return;
    }
    std::vector<glm::dvec3> positions;
    for (const std::uint32_t corner : corners)
        positions.push_back(soup.positions[corner]);
    const CutPolygon cut = cutPolygon(positions);
    if (!cut.isSimple) ++crossingPolygons;
    for (const glm::uvec3& triangle : cut.triangles)
        soup.triangles.emplace_back(corners[triangle.x], corners[triangle.y], corners[triangle.z]);
}

std::string_view nextWord(std::string_view& text) {
    constexpr const char* kBlanks = " \t\r\v\f";
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

bool parseNumber(std::string_view word, double& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem == std::errc::result_out_of_range) value = std::nan("");
    return problem != std::errc::invalid_argument && end == word.data() + word.size();
}

bool parseFloat(std::string_view word, float& value) {
    double mantissa = 0.0;
    double power = 0.0;
    if (!parseNumber(word, mantissa)) return false;
    const std::size_t e = word.find_first_of("eE");
    if (e != std::string_view::npos) {
        static_cast<void>(parseNumber(word.substr(0, e), mantissa));
        static_cast<void>(parseNumber(word.substr(e + 1), power));
    }
    const double whole = std::trunc(mantissa);
    value = static_cast<float>(whole) + static_cast<float>(mantissa - whole);
    if (e != std::string_view::npos) value *= std::pow(10.0f, static_cast<float>(power));
    return true;
}

}  // namespace kaustik::scene
