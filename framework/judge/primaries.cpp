// SPDX-License-Identifier: MIT
#include "framework/judge/primaries.h"

#include <cmath>

namespace kaustik::judge {
namespace {

struct Chromaticities {
    glm::dvec2 red;
    glm::dvec2 green;
    glm::dvec2 blue;
    glm::dvec2 white;
};

// White of Rec. ITU-R BT.709, and of ACES (SMPTE ST 2065-1:2012), which is near D60.
constexpr glm::dvec2 kD65(0.3127, 0.3290);
constexpr glm::dvec2 kAcesWhite(0.32168, 0.33767);

Chromaticities chromaticitiesOf(Primaries primaries) {
    switch (primaries) {
        case Primaries::rec2020:  // Rec. ITU-R BT.2020-2, table 3
            return {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65};
        case Primaries::p3:  // SMPTE EG 432-1:2010, with the white of displays
            return {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65};
        case Primaries::acescg:  // AP1: Academy S-2014-004
            return {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, kAcesWhite};
        case Primaries::aces2065:  // AP0: SMPTE ST 2065-1:2012
            return {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, kAcesWhite};
        default:  // Rec. ITU-R BT.709-6, table 1
            return {{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, kD65};
    }
}

// Tristimulus values of a luminance of 1.
glm::dvec3 xyzOf(const glm::dvec2& chromaticity) {
    return {chromaticity.x / chromaticity.y, 1.0,
            (1.0 - chromaticity.x - chromaticity.y) / chromaticity.y};
}

// SMPTE RP 177-1993, section 3.3: the primaries' amounts are those that make white of (1, 1, 1).
// Each is given by its x, y and z, since that of AP0's blue has next to no luminance.
glm::dmat3 toXyz(const Chromaticities& of) {
    const auto sums = [](const glm::dvec2& c) { return glm::dvec3(c, 1.0 - c.x - c.y); };
    const glm::dmat3 primaries(sums(of.red), sums(of.green), sums(of.blue));
    const glm::dvec3 amounts = glm::inverse(primaries) * xyzOf(of.white);
    return {amounts.r * primaries[0], amounts.g * primaries[1], amounts.b * primaries[2]};
}

// Bradford's cone responses (Lam 1985), as ICC.1:2010, annex E, scales them from white to white.
glm::dmat3 adaptation(const glm::dvec2& from, const glm::dvec2& to) {
    if (from == to) return glm::dmat3(1.0);
    const glm::dmat3 cones = glm::transpose(
        glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 factors = (cones * xyzOf(to)) / (cones * xyzOf(from));
    const glm::dmat3 scaled(glm::dvec3(factors.x, 0.0, 0.0), glm::dvec3(0.0, factors.y, 0.0),
                            glm::dvec3(0.0, 0.0, factors.z));
    return glm::inverse(cones) * scaled * cones;
}

}  // namespace

glm::dmat3 toRec709(Primaries primaries) {
    if (primaries == Primaries::rec709 || primaries == Primaries::automatic) return glm::dmat3(1.0);
    const Chromaticities ours = chromaticitiesOf(Primaries::rec709);
    const Chromaticities theirs = chromaticitiesOf(primaries);
    return glm::inverse(toXyz(ours)) * adaptation(theirs.white, ours.white) * toXyz(theirs);
}

Image transformed(const Image& image, const glm::dmat3& matrix) {
    if (matrix == glm::dmat3(1.0)) return image;
    Image result = image;
    for (std::size_t i = 0; i + 2 < image.values.size(); i += 3) {
        const glm::dvec3 pixel(image.values[i], image.values[i + 1], image.values[i + 2]);
        const glm::dvec3 of = matrix * pixel;
        for (glm::length_t c = 0; c < 3; ++c)
            result.values[i + static_cast<std::size_t>(c)] = static_cast<float>(of[c]);
    }
    return result;
}

Image transformedError(const Image& error, const glm::dmat3& matrix) {
    if (matrix == glm::dmat3(1.0)) return error;
    Image variance = error;
    for (float& value : variance.values)
        value *= value;
    Image result = transformed(variance, glm::matrixCompMult(matrix, matrix));
    for (float& value : result.values)
        value = std::sqrt(value);
    return result;
}

std::string titleOf(Primaries primaries) {
    switch (primaries) {
        case Primaries::rec2020:
            return "Rec. 2020";
        case Primaries::p3:
            return "P3 (D65)";
        case Primaries::acescg:
            return "ACEScg (AP1)";
        case Primaries::aces2065:
            return "ACES 2065-1 (AP0)";
        default:
            return "Rec. 709";
    }
}

}  // namespace kaustik::judge
