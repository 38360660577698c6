// SPDX-License-Identifier: MIT
// What both readers of foreign scenes share: numbers out of text, colours out of spectra and
// indices of refraction, matrices, and how an error names its place. A place is "file:line".
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/scene/foreign/foreign_scene.h"

namespace kaustik::scene {

// Throws ConfigError "place: what".
[[noreturn]] void failAt(const std::string& place, const std::string& what);

// Numbers that blanks or commas part. Throws ConfigError for anything else, and for what is not
// finite or beyond 1e9, which no scene file takes.
[[nodiscard]] std::vector<double> parseNumbers(std::string_view text, const std::string& place);
// Exactly one of them.
[[nodiscard]] double parseOneNumber(std::string_view text, const std::string& place);

// Fails for a transform that numbers no longer hold.
void requireFinite(const glm::dmat4& matrix, const std::string& place);

// Linear Rec.709 of a colour that is coded as sRGB.
[[nodiscard]] glm::dvec3 decodeSrgb(const glm::dvec3& encoded);
// The same of "#rrggbb"; nothing where that is not what it is.
[[nodiscard]] std::optional<glm::dvec3> parseHexColor(std::string_view text);
// Linear Rec.709 of values (ascending wavelengths in nm, linear in between): seen by the CIE 1931
// observer under an even light, so that an even spectrum is grey. Not negative.
[[nodiscard]] glm::dvec3 colorOfSpectrum(const std::vector<std::pair<double, double>>& values);
// The colour of a black body with a largest channel of 1.
[[nodiscard]] glm::dvec3 colorOfBlackbody(double kelvin);

// Of a named substance (bk7, water, air, …), in small letters; nothing for others.
[[nodiscard]] std::optional<double> namedIor(std::string name);
[[nodiscard]] std::vector<std::string> iorNames();
// Reflectance of a named metal at normal incidence; "none" is a perfect mirror.
[[nodiscard]] std::optional<glm::dvec3> namedMetal(std::string name);
// Reflectance at normal incidence of n + i k against a substance of index 1.
[[nodiscard]] glm::dvec3 metalReflectance(const glm::dvec3& eta, const glm::dvec3& k);
[[nodiscard]] double dielectricReflectance(double ior);

// The Phong exponent of a lobe about as wide as a microfacet's of this roughness, in the range of
// `exponent`.
[[nodiscard]] double exponentOfRoughness(double alpha);
// Reflects less than it receives; a material's albedo is then in range.
[[nodiscard]] glm::vec3 reflectanceOf(const glm::dvec3& color);

// A colour of a surface, with what varies it.
struct ForeignColor {
    glm::dvec3 color{0.0};
    std::optional<ForeignImage> image = {};
    Pattern pattern = Pattern::none;
    glm::dvec3 second{0.0};
    glm::dvec2 uvScale{1.0};
    bool turnsTexture = false;  // ForeignMaterial
};
// Makes a material a Lambertian one of that colour.
void setColor(ForeignMaterial& foreign, const ForeignColor& color);

// How deep BSDFs may lie in one another.
inline constexpr int kMaxNesting = 16;
// Rougher metals are receivers with a lobe; light goes on from smoother ones.
inline constexpr double kSmoothAlpha = 0.1;
// A glossy material whose parts add up to at most 1.
void setGlossy(Material& material, const glm::dvec3& diffuse, const glm::dvec3& specular,
               double exponent);

// Vertical field of view of one across another extent of the picture.
[[nodiscard]] double verticalFov(double degrees, double extentOverHeight);
// How far about +y a picture is turned whose middle lies in `direction`.
[[nodiscard]] double environmentTurn(const glm::dvec3& direction);
// Sets position, target and up of a camera that looks along `forward`; fails where these give none.
void aimCamera(Camera& camera, const glm::dvec3& position, const glm::dvec3& forward,
               const glm::dvec3& up, const std::string& place);

// Adds a note; `place` loses `folder`, so that no note tells where the scene lies on this machine.
class ForeignNotes {
  public:
    ForeignNotes(std::vector<ForeignNote>& notes, const std::filesystem::path& folder);
    void leftOut(const std::string& subject, const std::string& place, const std::string& reason);
    void changed(const std::string& subject, const std::string& place, const std::string& reason);

  private:
    void add(NoteKind kind, const std::string& subject, const std::string& place,
             const std::string& reason);
    std::vector<ForeignNote>& notes_;
    std::string prefix_;
};

}  // namespace kaustik::scene
