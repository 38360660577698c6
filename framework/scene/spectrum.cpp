// SPDX-License-Identifier: MIT
#include "framework/scene/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "framework/scene/pixel_size.h"

namespace kaustik::scene {
namespace {

struct Row {
    double nanometers;
    glm::dvec3 observer;   // x, y and z of the standard observer (CIE 018:2019)
    double daylight;       // D65 (ISO/CIE 11664-2)
    glm::dvec3 primaries;  // of Rec.709, by experiments/spectral_primaries.py
};
constexpr std::array kRows = std::to_array<Row>({
#include "framework/scene/spectrum.inc"
});
constexpr double kStep = 5.0;  // nm
constexpr double kMinBands = 8.0;
constexpr double kMaxBands = 32.0;
constexpr double kPhotonsOfABand = 64.0 * 64.0;
constexpr double kPixelsApart = 2.0;

Row rowAt(double nanometers) {
    const double at = std::clamp((nanometers - kShortestNanometers) / kStep, 0.0,
                                 static_cast<double>(kRows.size() - 1));
    const auto low = std::min(static_cast<std::size_t>(at), kRows.size() - 2);
    const double f = at - static_cast<double>(low);
    const Row& a = kRows[low];
    const Row& b = kRows[low + 1];
    return {nanometers, glm::mix(a.observer, b.observer, f), std::lerp(a.daylight, b.daylight, f),
            glm::mix(a.primaries, b.primaries, f)};
}

// What daylight of the wavelength makes of each of the observer's functions, a nanometre, times
// each primary: a column.
glm::dmat3 responseOf(const Row& row) {
    return row.daylight * glm::outerProduct(row.observer, row.primaries);
}
double weightOf(const Row& row) {
    return row.daylight * (row.observer.x + row.observer.y + row.observer.z);
}

// The spectrum in pieces of a twentieth of a nanometre, as sums up to each piece's end.
struct Sums {
    static constexpr std::size_t kPieces = 6400;
    std::vector<double> weights;
    std::vector<glm::dmat3> responses;
    std::vector<double> places;  // weighted
};
const Sums& sums() {
    static const Sums all = [] {
        Sums s;
        double weight = 0.0;
        double place = 0.0;
        glm::dmat3 response(0.0);
        const double piece = (kLongestNanometers - kShortestNanometers) / Sums::kPieces;
        for (std::size_t i = 0; i < Sums::kPieces; ++i) {
            const Row row = rowAt(kShortestNanometers + piece * (static_cast<double>(i) + 0.5));
            weight += piece * weightOf(row);
            place += piece * weightOf(row) * dispersionPlace(row.nanometers);
            response += piece * responseOf(row);
            s.weights.push_back(weight);
            s.places.push_back(place);
            s.responses.push_back(response);
        }
        return s;
    }();
    return all;
}

// Y of white, in the unit of the sums.
double luminance() {
    const glm::dmat3& all = sums().responses.back();
    return all[0].y + all[1].y + all[2].y;
}
// Columns: each primary's X, Y and Z, of which the white point is that of the table.
const glm::dmat3& xyzFromRec709() {
    static const glm::dmat3 matrix = sums().responses.back() / luminance();
    return matrix;
}
// What each of X, Y and Z counts in the sum of Rec.709's channels.
glm::dvec3 channelWeights() {
    return glm::inverse(glm::transpose(xyzFromRec709())) * glm::dvec3(1.0);
}
glm::dmat3 diagonal(const glm::dvec3& v) {
    return {{v.x, 0.0, 0.0}, {0.0, v.y, 0.0}, {0.0, 0.0, v.z}};
}

}  // namespace

double dispersionPlace(double nanometers) {
    const auto inverseSquare = [](double nm) { return 1e6 / (nm * nm); };
    return inverseSquare(nanometers) - inverseSquare(kHeliumNanometers);
}

double indexAt(const Material& material, double place) {
    const glm::dvec4 c(material.dispersion);
    return static_cast<double>(material.ior) +
           place * (c.x + place * (c.y + place * (c.z + place * c.w)));
}

const glm::dmat3& fluxFromRec709() {
    static const glm::dmat3 matrix = diagonal(channelWeights()) * xyzFromRec709();
    return matrix;
}
const glm::dmat3& rec709FromFlux() {
    static const glm::dmat3 matrix = glm::inverse(fluxFromRec709());
    return matrix;
}

glm::dvec3 primariesAt(double nanometers) {
    return rowAt(nanometers).primaries;
}

DrawnWavelength drawWavelength(double random) {
    static const glm::dmat3 rec709FromXyz = glm::inverse(xyzFromRec709());
    const Sums& s = sums();
    const double wanted = random * s.weights.back();
    const auto found = static_cast<std::size_t>(
        std::upper_bound(s.weights.begin(), s.weights.end(), wanted) - s.weights.begin());
    const std::size_t piece = std::min(found, Sums::kPieces - 1);
    const double before = piece == 0 ? 0.0 : s.weights[piece - 1];
    const double within = (wanted - before) / (s.weights[piece] - before);
    DrawnWavelength drawn;
    drawn.nanometers = kShortestNanometers + (kLongestNanometers - kShortestNanometers) *
                                                 (static_cast<double>(piece) + within) /
                                                 static_cast<double>(Sums::kPieces);
    const Row row = rowAt(drawn.nanometers);
    drawn.tint = row.primaries;
    drawn.ofLight =
        rec709FromXyz * responseOf(row) * (s.weights.back() / (weightOf(row) * luminance()));
    return drawn;
}

std::vector<Band> spectralBands(int count) {
    const Sums& s = sums();
    std::vector<Band> bands;
    std::size_t first = 0;
    for (int i = 0; i < count; ++i) {
        const double end = s.weights.back() * (i + 1) / count;
        std::size_t last = first;
        while (last + 1 < Sums::kPieces && s.weights[last] < end)
            ++last;
        const auto part = [&](const auto& cumulated) {
            return first == 0 ? cumulated[last] : cumulated[last] - cumulated[first - 1];
        };
        const glm::dmat3 response = part(s.responses);
        Band band;
        band.place = part(s.places) / part(s.weights);
        band.ofLight = glm::mat3(diagonal(channelWeights()) * response / luminance());
        // Each primary's share of white.
        const glm::dvec3 byPrimary(response[0].x + response[0].y + response[0].z,
                                   response[1].x + response[1].y + response[1].z,
                                   response[2].x + response[2].y + response[2].z);
        band.tint = glm::vec3(byPrimary / (byPrimary.x + byPrimary.y + byPrimary.z));
        bands.push_back(band);
        first = last + 1;
    }
    return bands;
}

bool disperses(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        const Material& material = scene.materials[object.material];
        return material.kind == MaterialKind::dielectric && material.dispersion != glm::vec4(0.0f);
    });
}

BandCount bandsOf(const Scene& scene, int wanted, int rows, double photons) {
    BandCount count;
    if (!disperses(scene) || rows < 1) return count;
    double spread = 0.0;
    for (const Material& material : scene.materials) {
        spread = std::max(spread, std::abs(indexAt(material, dispersionPlace(400.0)) -
                                           indexAt(material, dispersionPlace(700.0))));
    }
    // A prism of a radian turns light by its index less 1.
    count.partingMeters = spread * diagonalOf(sceneBounds(scene));
    count.pixelMeters = pixelMeters(scene, rows);
    const double apart = count.partingMeters / (kPixelsApart * count.pixelMeters);
    const double most = std::clamp(photons / kPhotonsOfABand, kMinBands, kMaxBands);
    count.bands =
        wanted > 0 ? wanted : static_cast<int>(std::lround(std::clamp(apart, kMinBands, most)));
    return count;
}

void forgetBands(Scene& scene) {
    std::erase_if(scene.lights, [](const Light& light) { return light.band > 0; });
    scene.bands.clear();
}

void placeBands(Scene& scene, int wanted, int rows, double photons) {
    forgetBands(scene);
    const int count = bandsOf(scene, wanted, rows, photons).bands;
    if (count < 2) return;
    scene.bands = spectralBands(count);
    const std::vector<Light> lights = scene.lights;
    for (int band = 1; band < count; ++band) {
        for (Light light : lights) {
            light.band = band;
            scene.lights.push_back(std::move(light));
        }
    }
}

}  // namespace kaustik::scene
