// SPDX-License-Identifier: MIT
// Colours out of spectra, indices of refraction and reflectances of metals. The observer is the
// multi-lobe fit of Wyman, Sloan and Shirley 2013 (JCGT 2.2), good to about a percent. The
// indices are those at the sodium line, as tables of physics have them; n and k of metals are those
// at 650, 550 and 450 nm.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "framework/importers/foreign_values.h"

namespace kaustik::scene {
namespace {

constexpr double kFirstNanometer = 380.0;
constexpr double kLastNanometer = 730.0;

struct NamedIor {
    const char* name;
    double ior;
};
constexpr std::array kIors{NamedIor{"vacuum", 1.0},
                           NamedIor{"helium", 1.000036},
                           NamedIor{"hydrogen", 1.000132},
                           NamedIor{"air", 1.000277},
                           NamedIor{"carbon dioxide", 1.00045},
                           NamedIor{"water", 1.333},
                           NamedIor{"acetone", 1.36},
                           NamedIor{"ethanol", 1.361},
                           NamedIor{"carbon tetrachloride", 1.461},
                           NamedIor{"glycerol", 1.4729},
                           NamedIor{"benzene", 1.501},
                           NamedIor{"silicone oil", 1.52045},
                           NamedIor{"bromine", 1.661},
                           NamedIor{"water ice", 1.31},
                           NamedIor{"fused quartz", 1.458},
                           NamedIor{"pyrex", 1.47},
                           NamedIor{"acrylic glass", 1.49},
                           NamedIor{"polypropylene", 1.49},
                           NamedIor{"bk7", 1.5168},
                           NamedIor{"sodium chloride", 1.544},
                           NamedIor{"amber", 1.55},
                           NamedIor{"pet", 1.575},
                           NamedIor{"sapphire", 1.77},
                           NamedIor{"diamond", 2.417}};

struct NamedMetal {
    const char* name;
    glm::dvec3 eta;
    glm::dvec3 k;
};
const std::array kMetals{
    NamedMetal{"au", {0.166, 0.422, 1.449}, {3.15, 2.35, 1.88}},
    NamedMetal{"ag", {0.140, 0.125, 0.151}, {4.15, 3.34, 2.47}},
    NamedMetal{"cu", {0.214, 1.030, 1.171}, {3.67, 2.59, 2.40}},
    NamedMetal{"al", {1.470, 0.958, 0.618}, {7.79, 6.69, 5.47}},
    NamedMetal{"cr", {3.110, 3.180, 2.190}, {3.33, 3.33, 3.29}},
};

void toLower(std::string& text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
}

// A bell with a width of its own on either side of its top.
double bell(double x, double top, double below, double above) {
    const double t = (x - top) / (x < top ? below : above);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 observer(double nm) {
    return {1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) -
                0.065 * bell(nm, 501.1, 20.4, 26.2),
            0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1),
            1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8)};
}

// IEC 61966-2-1.
glm::dvec3 rec709OfXyz(const glm::dvec3& xyz) {
    return {3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
            -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
            0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
}

// As the observer sees it, relative to an even spectrum.
template <class Spectrum>
glm::dvec3 colorOf(const Spectrum& spectrum) {
    glm::dvec3 seen(0.0);
    glm::dvec3 even(0.0);
    for (double nm = kFirstNanometer; nm <= kLastNanometer; nm += 5.0) {
        seen += spectrum(nm) * observer(nm);
        even += observer(nm);
    }
    const double scale = 1.0 / even.y;
    const glm::dvec3 white = rec709OfXyz(scale * even);
    return glm::max(rec709OfXyz(scale * seen) / white, 0.0);
}

}  // namespace

glm::dvec3 decodeSrgb(const glm::dvec3& encoded) {
    const auto decode = [](double c) {
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return {decode(encoded.r), decode(encoded.g), decode(encoded.b)};
}

std::optional<glm::dvec3> parseHexColor(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    glm::dvec3 encoded(0.0);
    for (int i = 0; i < 6; ++i) {
        const char c = static_cast<char>(
            std::tolower(static_cast<unsigned char>(text[static_cast<std::size_t>(i) + 1])));
        const bool isDigit = c >= '0' && c <= '9';
        if (!isDigit && (c < 'a' || c > 'f')) return std::nullopt;
        encoded[i / 2] = encoded[i / 2] * 16.0 + (isDigit ? c - '0' : c - 'a' + 10);
    }
    return decodeSrgb(encoded / 255.0);
}

glm::dvec3 colorOfSpectrum(const std::vector<std::pair<double, double>>& values) {
    if (values.empty()) return glm::dvec3(0.0);
    return colorOf([&](double nm) {
        const auto next =
            std::lower_bound(values.begin(), values.end(), nm,
                             [](const auto& value, double wanted) { return value.first < wanted; });
        if (next == values.begin()) return next->second;
        if (next == values.end()) return values.back().second;
        const auto before = next - 1;
        const double width = next->first - before->first;
        const double part = width > 0.0 ? (nm - before->first) / width : 0.0;
        return before->second + part * (next->second - before->second);
    });
}

glm::dvec3 colorOfBlackbody(double kelvin) {
    const double temperature = std::clamp(kelvin, 500.0, 1e5);
    const glm::dvec3 color = colorOf([&](double nm) {
        // Planck's law relative to 560 nm, with its second constant in nm K.
        const double exponent = 1.438777e7 / temperature;
        return std::pow(560.0 / nm, 5.0) * std::expm1(exponent / 560.0) / std::expm1(exponent / nm);
    });
    return color / std::max({color.r, color.g, color.b, 1e-9});
}

std::optional<double> namedIor(std::string name) {
    toLower(name);
    for (const NamedIor& known : kIors) {
        if (name == known.name) return known.ior;
    }
    return std::nullopt;
}

std::vector<std::string> iorNames() {
    std::vector<std::string> names;
    for (const NamedIor& known : kIors)
        names.emplace_back(known.name);
    return names;
}

std::optional<glm::dvec3> namedMetal(std::string name) {
    toLower(name);
    if (name == "none") return glm::dvec3(1.0);
    for (const NamedMetal& metal : kMetals) {
        if (name == metal.name) return metalReflectance(metal.eta, metal.k);
    }
    return std::nullopt;
}

glm::dvec3 metalReflectance(const glm::dvec3& eta, const glm::dvec3& k) {
    const glm::dvec3 above = (eta - 1.0) * (eta - 1.0) + k * k;
    const glm::dvec3 below = (eta + 1.0) * (eta + 1.0) + k * k;
    return glm::clamp(above / glm::max(below, 1e-12), 0.0, 1.0);
}

double dielectricReflectance(double ior) {
    const double ratio = (ior - 1.0) / std::max(ior + 1.0, 1e-12);
    return ratio * ratio;
}

}  // namespace kaustik::scene
