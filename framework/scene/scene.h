// SPDX-License-Identifier: MIT
// The scene as plain data on the CPU: what a scene file or a glTF file says, validated, in SI
// units. Right-handed, +Y up; linear Rec.709. World coordinates are doubles, so that a scene 1e5 m
// from the origin loses nothing: meshes hold 32-bit positions relative to an origin of their own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kaustik::scene {

struct Camera {
    glm::dvec3 position{0.0, 1.0, 5.0};
    glm::dvec3 target{0.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double verticalFovDegrees = 45.0;  // (0, 180)
    double nearMeters = 0.01;          // > 0; there is no far plane
    friend bool operator==(const Camera&, const Camera&) = default;
};

// `surface`: a point of one that shines, whose intensity falls with the cosine to its normal, and
// which is dark behind. Scene files have no such light; it stands for a part of an emitter.
enum class LightKind { directional, point, spot, surface };

struct Light {
    std::string name;
    LightKind kind = LightKind::directional;
    glm::dvec3 position{0.0};              // not of a directional one
    glm::dvec3 direction{0.0, -1.0, 0.0};  // unit, from the light outwards: not of a point
    // Directional: irradiance on a surface that faces the light, W/m². Point, spot and surface:
    // radiant intensity inside the inner cone or along the normal, W/sr.
    glm::vec3 power{1.0f};
    float innerConeRadians = 0.0f;        // spot: full intensity inside this half-angle
    float outerConeRadians = 0.7853982f;  // spot: none outside; smooth between
    float rangeMeters = 0.0f;             // 0: unlimited (KHR_lights_punctual)
    // Spot: index into Scene::images, whose linear RGB multiplies the intensity; -1: none. The
    // image lies in the tangent plane, its middle on the axis and the middles of its sides at the
    // outer half-angle (`spotImagePosition`).
    int image = -1;
    glm::dvec3 up{0.0, 0.0, -1.0};  // unit, at right angles to `direction`: the image's top
    // Directional: the angle that its disc takes of the sky; 0: a point of it.
    float angularDiameterRadians = 0.0f;
    int emitter = -1;  // that it is a point of (Scene::emitters); -1: a light of its own
    // Of a point of an emitter: the radius of the disc that is as large as the part that it stands
    // for, rad (directional) or m (surface); 0: none.
    float radius = 0.0f;
    // What it sends of its photons, of Scene::bands where there are any. Those after the first are
    // copies of lights, for photons alone.
    int band = 0;
};

// A part of the visible spectrum (scene/spectrum.h), with light of one wavelength in its place.
struct Band {
    double place = 0.0;       // of the wavelength: dispersionPlace
    glm::vec3 tint{0.0f};     // times a colour: the share of its light that this lets through
    glm::mat3 ofLight{0.0f};  // times a light's linear Rec.709: its flux, as fluxFromRec709 has it
};

class EmittingEnvironment;

// A light that has a size (scene/emitters.h): the disc of a directional light, an object of a
// material that emits, or what is all around.
struct Emitter {
    Light light;                          // of a disc
    std::optional<std::uint32_t> object;  // of a surface
    std::shared_ptr<const EmittingEnvironment> environment = {};
    [[nodiscard]] bool isDisc() const { return !object && !environment; }
};

enum class MaterialKind : std::uint32_t { lambertian = 0, dielectric = 1, mirror = 2, glossy = 3 };

// Light ends on a receiver; it goes on from every other surface.
[[nodiscard]] inline bool isReceiver(MaterialKind kind) {
    return kind == MaterialKind::lambertian || kind == MaterialKind::glossy;
}

// Patterns are computed in the shader from the surface's uv, so that no image file is needed.
enum class Pattern : std::uint32_t { none = 0, checker = 1, tiles = 2 };

struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::lambertian;
    glm::vec3 albedo{0.5f};  // [0,1]; for a mirror: its reflectance; glossy: of the diffuse part
    Pattern pattern = Pattern::none;
    glm::vec3 patternAlbedo{0.25f};  // the second colour of the pattern (tiles: the joints)
    glm::vec2 uvScale{1.0f};
    int image = -1;                      // index into Scene::images, multiplies albedo; -1: none
    float ior = 1.5f;                    // dielectric, relative to vacuum, >= 1
    glm::vec3 absorptionPerMeter{0.0f};  // dielectric: Beer-Lambert coefficient inside, 1/m, >= 0
    // Dielectric: what is added to its index at other wavelengths than the d line, as a polynomial
    // of dispersionPlace (scene/spectrum.h) without a constant, from the first power on; 0:
    // nothing.
    glm::vec4 dispersion{0.0f};
    // Glossy: the lobe of transport/brdf.h; albedo + specular <= 1.
    glm::vec3 specular{0.0f};  // its reflectance at normal incidence, [0,1]
    float exponent = 50.0f;    // of the cosine to the mirror direction, >= 1
    // Radiance of its front, the same in all directions, W/m²/sr; of receivers alone.
    glm::vec3 emission{0.0f};
    // Dielectrics and mirrors: the vectors of transport/normal_map.h, an index into Scene::images;
    // -1: none.
    int normalMap = -1;
    float normalScale = 1.0f;  // of their x and y
};

// An image used as a texture: an encoded file in memory or on disk, decoded later through image/.
struct TextureImage {
    std::string name;            // for messages
    std::filesystem::path file;  // empty when `bytes` is used
    std::string bytes;           // encoded image (embedded glTF)
    bool srgb = true;
    bool isNormalMap = false;  // decoded to vectors
};

// One wave of a height field: amplitude * cos(k·x - omega t + phase), k = 2π/wavelength ·
// direction.
struct Wave {
    float amplitudeMeters = 0.01f;
    float wavelengthMeters = 0.5f;  // > 0
    float directionDegrees = 0.0f;  // in the xz-plane, from +x towards +z
    float phaseRadians = 0.0f;
    // Angular frequency in rad/s; < 0: the deep-water dispersion sqrt(g k).
    float omegaRadiansPerSecond = -1.0f;
    friend bool operator==(const Wave&, const Wave&) = default;
};

// A rectangular height field, y = sum of waves over (x, z), centred on its object's origin; its
// normals are exact derivatives. The vertices are made on the GPU each frame, and by
// `evaluateHeightField` on the CPU for the reference.
struct HeightField {
    glm::vec2 sizeMeters{1.0f};  // extent along x and z
    glm::uvec2 cells{128, 128};  // grid cells along x and z, >= 1
    std::vector<Wave> waves;
};

// An indexed triangle mesh. Positions are relative to `origin`; all arrays are validated: finite,
// indices in range, one normal and one uv a position.
struct Mesh {
    std::string name;
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // unit; made from the faces where the file has none
    std::vector<glm::vec2> uvs;      // (0, 0) is an image's lower left; 0 where the file has none
    std::vector<glm::uvec3> triangles;
    bool closed = false;  // every edge is shared by two triangles: bounds a volume
    // That is closed, or has an inside for all its seams and holes (meshes/winding_number.h).
    bool hasInside = false;
    std::optional<HeightField> heightField;  // present: positions are those at Scene::timeSeconds
};

// A mesh placed in the world: p_world = toWorld * (mesh.origin + position).
struct Object {
    std::string name;
    std::uint32_t mesh = 0;
    std::uint32_t material = 0;
    glm::dmat4 toWorld{1.0};
};

// A homogeneous participating medium that fills the scene.
struct Medium {
    glm::vec3 scatteringPerMeter{0.0f};
    glm::vec3 absorptionPerMeter{0.0f};
    float anisotropy = 0.0f;  // Henyey-Greenstein g in (-1, 1)
    friend bool operator==(const Medium&, const Medium&) = default;
};

struct Scene {
    std::string name;
    std::string description;
    std::filesystem::path file;
    std::vector<std::filesystem::path> extendedFiles;  // that `file` builds on, nearest first
    Camera camera;
    std::vector<Light> lights;      // and, with an emitter, the points that stand for those
    std::vector<Band> bands;        // that their light is taken apart into; none where it is not
    std::vector<Emitter> emitters;  // lights that have a size
    std::vector<Material> materials;
    std::vector<TextureImage> images;
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
    std::optional<Medium> medium;
    glm::vec3 backgroundRadiance{0.0f};  // W/m²/sr, from every direction that leaves the scene
    // Index into Scene::images of a latitude-longitude picture of the environment, whose
    // linear RGB multiplies the background radiance; -1: none. Its middle lies towards -Z, its top
    // towards +Y; it turns by `environmentTurnDegrees` about +Y, counter-clockwise from above.
    int environmentImage = -1;
    double environmentTurnDegrees = 0.0;
    bool environmentLights = false;  // it is a light, too, and not only seen
    glm::vec3 ambientIrradiance{
        0.0f};  // W/m², a constant fill light for the picture; not in errors
    double timeSeconds = 0.0;
    std::vector<std::string> warnings;  // what was imported with a change, for the report
};

struct Bounds {
    glm::dvec3 minimum{0.0};
    glm::dvec3 maximum{0.0};
    bool empty = true;
    void include(const glm::dvec3& point);
};

// World-space bounds of one object, or of all. Height fields count with the sum of their
// amplitudes, so that the bounds hold at every time.
[[nodiscard]] Bounds objectBounds(const Scene& scene, const Object& object);
// Whether they share more than a border.
[[nodiscard]] bool overlap(const Bounds& a, const Bounds& b);
[[nodiscard]] Bounds sceneBounds(const Scene& scene);
// Of all that is no receiver.
[[nodiscard]] Bounds specularBounds(const Scene& scene);
[[nodiscard]] std::size_t triangleCount(const Scene& scene);
[[nodiscard]] bool hasNormalMaps(const Scene& scene);

// The top of the image of a light that shines in `direction` (unit), as near to `wanted` as the
// image's plane allows; nothing where that is along the direction.
[[nodiscard]] std::optional<glm::dvec3> topOfImage(const glm::dvec3& direction,
                                                   const glm::dvec3& wanted);
// The direction to the image's top where none is given: +Y, and -Z for a vertical light.
[[nodiscard]] glm::dvec3 defaultTopOfImage(const glm::dvec3& direction);

// The share of a spot's intensity that it sends at `cosine` from its direction: 1 inside the inner
// cone, 0 outside the outer one, between them the squared linear ramp in the cosine that
// KHR_lights_punctual recommends. Its flux is I 2π ((1 - cos inner) + (cos inner - cos outer)/3).
[[nodiscard]] double spotFalloff(const Light& light, double cosine);

// The place in its image that a spot shines in `direction` (unit, from the light, less than 90
// degrees from its own): (0, 0) is the lower left, (1, 1) the upper right as someone sees the lit
// wall who stands behind the light.
[[nodiscard]] glm::dvec2 spotImagePosition(const Light& light, const glm::dvec3& direction);

}  // namespace kaustik::scene
