// SPDX-License-Identifier: MIT
// Colours and textures of a Mitsuba scene: numbers, rgb, srgb and spectra become linear Rec.709.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/importers/mitsuba_parts.h"

namespace kaustik::scene {
namespace {

glm::dvec3 threeOrOne(const std::vector<double>& numbers, const std::string& place) {
    if (numbers.size() == 1) return glm::dvec3(numbers[0]);
    if (numbers.size() != 3) failAt(place, "a colour has three numbers, or one.");
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dvec3 rgbOf(const MitsubaElement& element) {
    const std::string& value = element.required("value");
    if (const auto color = parseHexColor(value)) return *color;
    const glm::dvec3 color = threeOrOne(parseNumbers(value, element.place), element.place);
    return element.tag == "srgb" ? decodeSrgb(color) : color;
}

using SpectrumValues = std::vector<std::pair<double, double>>;

void requireAscending(const SpectrumValues& values, const std::string& place) {
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (values[i].first <= values[i - 1].first)
            failAt(place, "the wavelengths of a spectrum must ascend.");
    }
}

// "400:0.1, 500:0.2"
glm::dvec3 colorOfPairs(std::string text, const std::string& place) {
    std::replace(text.begin(), text.end(), ':', ' ');
    const std::vector<double> numbers = parseNumbers(text, place);
    SpectrumValues values;
    if (numbers.size() % 2 != 0) failAt(place, "a wavelength of this spectrum has no value.");
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
        values.emplace_back(numbers[i], numbers[i + 1]);
    requireAscending(values, place);
    return colorOfSpectrum(values);
}

// A line of the file has a wavelength and a value.
glm::dvec3 colorOfFile(const MitsubaDocument& document, const MitsubaElement& element) {
    const std::filesystem::path file = document.file(element.attribute("filename"));
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        throw IoError(
            fmt::format("{}: the spectrum {} was not found.", element.place, file.string()));
    }
    const std::string text = readFile(file);
    std::string numbers;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        numbers += line.substr(0, line.find_first_of("#\r")) + " ";
        begin = end + 1;
    }
    return colorOfPairs(numbers, element.place);
}

// <spectrum type="regular"> and "irregular".
glm::dvec3 colorOfList(const MitsubaElement& element) {
    const std::vector<double> heights = parseNumbers(element.text("values"), element.place);
    std::vector<double> nanometers;
    if (element.type() == "irregular") {
        nanometers = parseNumbers(element.text("wavelengths"), element.place);
    } else {
        const double first = element.number("wavelength_min", 360.0);
        const double last = element.number("wavelength_max", 830.0);
        const double steps = std::max<double>(static_cast<double>(heights.size()) - 1.0, 1.0);
        for (std::size_t i = 0; i < heights.size(); ++i)
            nanometers.push_back(first + (last - first) * static_cast<double>(i) / steps);
    }
    if (nanometers.size() != heights.size() || heights.empty())
        failAt(element.place, "this spectrum needs as many wavelengths as values.");
    SpectrumValues values;
    for (std::size_t i = 0; i < heights.size(); ++i)
        values.emplace_back(nanometers[i], heights[i]);
    requireAscending(values, element.place);
    return colorOfSpectrum(values);
}

glm::dvec3 colorOfTypedSpectrum(const MitsubaImport& importer, const MitsubaElement& element) {
    const std::string& type = element.type();
    if (type == "regular" || type == "irregular") return colorOfList(element);
    if (type == "blackbody")
        return colorOfBlackbody(element.number("temperature", 5000.0)) *
               element.number("scale", 1.0);
    if (type == "d65") return glm::dvec3(element.number("scale", 1.0));
    if (const MitsubaElement* const inner = element.child("color"))
        return constantColor(importer, *inner).value_or(glm::dvec3(1.0));
    return glm::dvec3(element.number("value", 1.0));
}

void setPicture(MitsubaImport& importer, const MitsubaElement& texture, ForeignColor& color) {
    const MitsubaElement* const name = texture.child("filename");
    if (name == nullptr) failAt(texture.place, "a bitmap needs a 'filename'.");
    color.image = ForeignImage{importer.document.file(name->required("value")), name->place};
    color.color = glm::dvec3(1.0);
    if (texture.flag("raw", false) && texture.attribute("name") != "normalmap")
        importer.change(texture, "its raw values are taken for a picture, coded as sRGB");
}

bool isWhole(double number) {
    return std::abs(number - std::round(number)) < 1e-6;
}

// How often it repeats, and whether it is turned over, which scenes do to have a picture upright.
// What else turns and moves it has no counterpart.
void setScale(MitsubaImport& importer, const MitsubaElement& texture, ForeignColor& color) {
    const glm::dmat4 toUv = texture.transform("to_uv");
    const glm::dvec2 scale(toUv[0][0] * texture.number("uscale", 1.0),
                           toUv[1][1] * texture.number("vscale", 1.0));
    const bool isMoved = !isWhole(toUv[3].x) || !isWhole(toUv[3].y);
    if (isMoved || toUv[0][1] != 0.0 || toUv[1][0] != 0.0 || scale.x <= 0.0)
        importer.change(texture, "it is only scaled, not turned, mirrored or moved");
    color.turnsTexture = scale.y < 0.0;
    color.uvScale = glm::max(glm::abs(scale), 1e-6);
}

}  // namespace

std::optional<glm::dvec3> constantColor(const MitsubaImport& importer,
                                        const MitsubaElement& element) {
    if (element.tag == "rgb" || element.tag == "srgb") return rgbOf(element);
    if (element.tag == "blackbody") {
        std::string kelvin = element.required("temperature");
        if (kelvin.ends_with('K') || kelvin.ends_with('k')) kelvin.pop_back();
        return colorOfBlackbody(parseOneNumber(kelvin, element.place));
    }
    if (element.tag == "float" || element.tag == "integer")
        return glm::dvec3(parseOneNumber(element.required("value"), element.place));
    if (element.tag != "spectrum") return std::nullopt;
    if (element.has("filename")) return colorOfFile(importer.document, element);
    if (!element.has("value")) return colorOfTypedSpectrum(importer, element);
    const std::string& value = element.attribute("value");
    if (value.find(':') != std::string::npos) return colorOfPairs(value, element.place);
    return threeOrOne(parseNumbers(value, element.place), element.place);
}

ForeignColor surfaceColor(MitsubaImport& importer, const MitsubaElement& parent, const char* name,
                          const glm::dvec3& otherwise) {
    ForeignColor result;
    result.color = otherwise;
    const MitsubaElement* const child = parent.child(name);
    if (child == nullptr) return result;
    const MitsubaElement& element = importer.document.resolve(*child);
    if (const auto color = constantColor(importer, element)) {
        result.color = *color;
        return result;
    }
    if (element.tag != "texture")
        failAt(child->place, fmt::format("<{}> is no colour and no texture.", element.tag));
    if (element.type() == "bitmap") {
        setPicture(importer, element, result);
        setScale(importer, element, result);
    } else if (element.type() == "checkerboard") {
        result.pattern = Pattern::checker;
        result.color = evenColor(importer, element, "color0", glm::dvec3(0.4));
        result.second = evenColor(importer, element, "color1", glm::dvec3(0.2));
        setScale(importer, element, result);
        result.uvScale *= 2.0;  // there a repeat is two squares
    } else {
        result.color = glm::dvec3(0.5);
        importer.leaveOut(element, "there is no such texture; it is grey");
    }
    return result;
}

glm::dvec3 evenColor(MitsubaImport& importer, const MitsubaElement& parent, const char* name,
                     const glm::dvec3& otherwise) {
    // A texture of colours that are textures would be followed for ever.
    const MitsubaElement* const child = parent.child(name);
    if (child == nullptr) return otherwise;
    const MitsubaElement& element = importer.document.resolve(*child);
    if (const auto color = constantColor(importer, element)) return *color;
    importer.leaveOut(element, fmt::format("'{}' has no texture here; it is an even {}", name,
                                           otherwise == glm::dvec3(1.0) ? "1" : "grey"));
    return otherwise;
}

}  // namespace kaustik::scene
