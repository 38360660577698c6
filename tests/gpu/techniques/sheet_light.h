// SPDX-License-Identifier: MIT
// What tests of maps in lights' views share. A sheet of index 1 lets light through as it comes, so
// that the irradiance below it is the light's own.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/techniques/caustic_map_frame.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {

inline const numerics::CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, -0.5, 0.0}, 60.0, 0.01};
inline const std::string kAir = "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n";
// Every flux that is summed in 64 bits, of weights in 32.
inline constexpr double kFlux = 1e-5;

inline std::string sheet(double side, const std::string& material = "air", double height = 0.0) {
    return (material == "air" ? kAir : "") +
           numerics::object("sheet", "plane", material, {0, height, 0},
                            fmt::format("size = [{0}, {0}]", numerics::number(side)));
}
inline std::string floorOf(double side) {
    return numerics::floorPlane("floor", "grey", side, {0, -1, 0});
}

// Light of some structure, a part of which falls next to the map of what the eye sees.
inline scene::Scene waves() {
    return numerics::makeScene(kAbove,
                               numerics::sun({0.2, -1.0, 0.1}) + rippledWater() + floorOf(3.0));
}
inline scene::Scene uniform() {
    return numerics::makeScene(kAbove, numerics::sun({0, -1, 0}) + sheet(2.0) + floorOf(4.0));
}

inline Settings with(Settings settings, const Settings& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}
inline const Settings kSmall{{"emit.photons", "96x96"},
                             {"reconstruct.map_size", "96"},
                             {"reconstruct.map_covers", "scene"},
                             {"specular.two_interfaces.size", "256"}};

inline double brightest(const MapTexels& map) {
    double maximum = 0.0;
    for (const glm::dvec3& flux : map.flux)
        maximum = std::max({maximum, flux.r, flux.g, flux.b});
    return maximum;
}
// `inset`: texels along the border that do not count.
inline double largestDifferenceWithin(const MapTexels& a, const MapTexels& b, int inset) {
    double maximum = 0.0;
    for (int y = inset; y < a.height - inset; ++y) {
        for (int x = inset; x < a.width - inset; ++x) {
            const glm::dvec3 off = glm::abs(a.at(x, y) - b.at(x, y));
            maximum = std::max({maximum, off.r, off.g, off.b});
        }
    }
    return maximum;
}
inline double largestDifference(const MapTexels& a, const MapTexels& b) {
    return largestDifferenceWithin(a, b, 0);
}

// Irradiance in the middle of what the sheet lights, of a set of flux.
struct Field {
    double mean = 0.0;
    double worst = 0.0;  // relative
    int texels = 0;
};
inline Field fieldOf(const MapFrame& frame, const MapTexels& map, double expected) {
    const render::RasterView& view = mapViewOf(frame);
    const double side = 2.0 * view.halfExtent.x / view.width;
    Field field;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const glm::dvec3 place = placeBefore(view, {x + 0.5, y + 0.5}, 0.0);
            // Eight texels from the border of the light.
            if (std::max(std::abs(place.x), std::abs(place.z)) > 1.0 - 8.0 * side) continue;
            const double irradiance = map.at(x, y).g / (side * side);
            field.mean += irradiance;
            field.worst = std::max(field.worst, std::abs(irradiance / expected - 1.0));
            ++field.texels;
        }
    }
    field.mean /= field.texels;
    return field;
}

}  // namespace kaustik::test
