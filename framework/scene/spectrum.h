// SPDX-License-Identifier: MIT
// Light by wavelength, for scenes with a dielectric that disperses. White is CIE's illuminant D65,
// and eyes are its standard observer of 1931, both from 380 to 700 nm. A colour in linear Rec.709
// stands for a spectrum of three primaries that are nowhere negative and add up to 1 at every
// wavelength (Mallett and Yuksel 2019, "Spectral Primary Decomposition for Rendering with sRGB
// Reflectance"), so that grey is the same at all of them and a colour is itself again.
//
// Light of one wavelength is negative in a channel of Rec.709, and sums of flux on the device take
// nothing negative. There it has the three channels of `fluxFromRec709`: X, Y and Z, each
// multiplied by what makes the sum of the three that of Rec.709's, so that a ledger's watts are the
// same in both.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

inline constexpr double kShortestNanometers = 380.0;
inline constexpr double kLongestNanometers = 700.0;
inline constexpr double kHeliumNanometers = 587.5618;  // the d line, to which an `ior` belongs

// 1/λ² less that of the d line, 1/µm²: what Material::dispersion is a polynomial of. 0 stands for
// light that is not taken apart, too.
[[nodiscard]] double dispersionPlace(double nanometers);
// Of a dielectric's `ior`; at most 2e-5 from the formula that the scene file has.
[[nodiscard]] double indexAt(const Material& material, double place);

[[nodiscard]] const glm::dmat3& fluxFromRec709();
[[nodiscard]] const glm::dmat3& rec709FromFlux();

// What share of light a colour lets through at a wavelength: the dot product with this.
[[nodiscard]] glm::dvec3 primariesAt(double nanometers);

// One wavelength, for who draws them at random.
struct DrawnWavelength {
    double nanometers = 0.0;
    glm::dvec3 tint{0.0};     // primariesAt
    glm::dmat3 ofLight{0.0};  // times a light's linear Rec.709: the sample's; its mean is the unit
};
// `random`: in [0, 1). As often as the eye responds to it, all three functions together.
[[nodiscard]] DrawnWavelength drawWavelength(double random);

// Parts of the spectrum, from its short end, to each of which the eye responds as much.
[[nodiscard]] std::vector<Band> spectralBands(int count);

// Whether some dielectric of the scene has another index for another wavelength.
[[nodiscard]] bool disperses(const Scene& scene);

// How many bands, and why.
struct BandCount {
    int bands = 1;
    // By how much the scene's colours part on the way through the scene, at most, and what a pixel
    // sees there, m.
    double partingMeters = 0.0;
    double pixelMeters = 0.0;
};
// `wanted`: 0 says that it is to be found out: as many, from 8 to 32, as leave neighbours two
// pixels apart in a picture of so many rows, and a light's `photons`, which they share out, no
// fewer than 64 x 64 for each (results/dispersion.md).
[[nodiscard]] BandCount bandsOf(const Scene& scene, int wanted, int rows, double photons);
// Gives the scene its bands, and each of them the lights; one that does not disperse has none.
void placeBands(Scene& scene, int wanted, int rows, double photons);
// Takes them away again.
void forgetBands(Scene& scene);

}  // namespace kaustik::scene
