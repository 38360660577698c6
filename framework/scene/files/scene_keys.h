// SPDX-License-Identifier: MIT
// Every key of a scene file (shape_keys.h has those of shapes), said once: TableReader reads a file
// by these functions, and TableSchema describes it by them for `kaustik schema scene`. What a
// struct holds is the default of a key that has one.
#pragma once

#include "framework/scene/environment.h"
#include "framework/scene/files/shape_keys.h"

namespace kaustik::scene {

template <class R>
void reflect(R& r, Camera& camera) {
    r.vector(camera.position, {"position", "Where the eye is", "m"}, kAnyNumber);
    r.vector(camera.target, {"target", "What it looks at", "m"}, kAnyNumber, kHasDefault);
    r.direction(camera.up, {"up", "Where the top of the picture points"}, kHasDefault);
    r.number(camera.verticalFovDegrees, {"vertical_fov_degrees", "Field of view"}, kBelow180Degrees,
             kHasDefault);
    r.number(camera.nearMeters, {"near", "Distance of the near plane", "m"}, kPositive,
             kHasDefault);
}

template <class R>
void reflect(R& r, Medium& medium) {
    r.uniformOrVector(medium.scatteringPerMeter,
                      {"scattering_per_meter", "Scattering coefficient", "1/m"}, kNotNegative,
                      kHasDefault);
    r.uniformOrVector(medium.absorptionPerMeter,
                      {"absorption_per_meter", "Absorption coefficient", "1/m"}, kNotNegative,
                      kHasDefault);
    r.number(medium.anisotropy, {"anisotropy", "Henyey-Greenstein g"}, {-1.0, 1.0, true, true},
             kHasDefault);
}

struct EnvironmentKeys {
    double turnDegrees = 0.0;
    std::optional<std::string> image;
    std::optional<EnvironmentPattern> pattern;
    bool lights = false;
};
template <class R>
void reflect(R& r, EnvironmentKeys& environment) {
    r.number(environment.turnDegrees, {"turn_degrees", "About +y, counter-clockwise from above"},
             kAnyNumber, kHasDefault);
    r.text(environment.image, {"image", "A latitude-longitude picture beside the scene file"});
    r.choice(environment.pattern, {"pattern", "A picture that needs no file"},
             {{"sky", EnvironmentPattern::sky}, {"grid", EnvironmentPattern::grid}});
    r.flag(environment.lights,
           {"lights", "Whether it shines into the scene, and is not only seen"});
    r.rule({{"image", "pattern"},
            false,
            "image",
            "environment has either an image or a pattern, not both"});
}

struct LightKeys {
    std::string name;
    LightKind kind = LightKind::directional;
    glm::dvec3 color{1.0};
    glm::dvec3 direction{0.0};
    glm::dvec3 position{0.0};
    double innerConeDegrees = 0.0;
    double outerConeDegrees = 45.0;
    std::optional<std::string> texture;
    std::optional<glm::dvec3> up;
    double irradiance = 0.0;
    double angularDiameterDegrees = 0.0;
    float rangeMeters = 0.0f;
    std::optional<double> intensity;
    std::optional<double> powerWatts;
};
template <class R>
void reflect(R& r, LightKeys& light) {
    r.name(light.name);
    r.kind(light.kind, {"type", "What kind of light it is"},
           {{"directional", LightKind::directional},
            {"point", LightKind::point},
            {"spot", LightKind::spot}});
    r.uniformOrVector(light.color, {"color", "Multiplies the power, by channel"}, kNotNegative,
                      kHasDefault);
    if (light.kind != LightKind::point)
        r.direction(light.direction, {"direction", "Where its light goes"});
    if (light.kind == LightKind::spot) {
        r.number(light.innerConeDegrees, {"inner_cone_degrees", "Half-angle of full light"},
                 {0.0, 90.0, false, false}, kHasDefault);
        r.number(light.outerConeDegrees,
                 {"outer_cone_degrees", "Half-angle where light ends; at most 89 with a texture"},
                 {0.0, 90.0, true, false}, kHasDefault);
        r.text(light.texture,
               {"texture", "An image beside the scene file, which multiplies the intensity"});
        if (r.onlyWith("up", "texture"))
            r.direction(light.up, {"up", "Where the top of the texture points"});
    }
    if (light.kind == LightKind::directional) {
        r.number(light.irradiance, {"irradiance", "On a surface that faces the light", "W/m²"},
                 kNotNegative);
        r.number(light.angularDiameterDegrees,
                 {"angular_diameter_degrees",
                  "That its disc takes of the sky, the sun's 0.53; 0: its rays are parallel"},
                 {0.0, 90.0, false, false}, kHasDefault);
        return;
    }
    r.vector(light.position, {"position", "Where it is", "m"}, kAnyNumber);
    r.number(light.rangeMeters, {"range", "How far it shines; 0 is unlimited", "m"}, kNotNegative,
             kHasDefault);
    r.number(light.intensity, {"intensity", "Radiant intensity on the axis", "W/sr"}, kNotNegative);
    r.number(light.powerWatts,
             {"power_watts", "Flux of the whole light, in place of its intensity", "W"},
             kNotNegative);
    r.rule({{"intensity", "power_watts"},
            true,
            "power_watts",
            "either intensity or power_watts is given, not both",
            "intensity"});
}

struct SellmeierKeys {
    glm::dvec3 b{0.0};
    glm::dvec3 c{0.0};
};
template <class R>
void reflect(R& r, SellmeierKeys& keys) {
    r.vector(keys.b, {"b", "The numerators of the three terms"}, kAnyNumber);
    r.vector(keys.c, {"c", "Their poles", "µm²"}, kAnyNumber);
}

// How a dielectric's index changes with the wavelength: one of these, or nothing.
struct DispersionKeys {
    std::optional<double> ior;
    std::optional<double> abbeNumber;
    std::optional<glm::dvec3> cauchy;
    std::optional<SellmeierKeys> sellmeier;
    std::optional<std::string> glass;
};
template <class R>
void reflect(R& r, DispersionKeys& keys) {
    r.number(keys.ior, {"ior", "Index of refraction, on the d line (587.6 nm) where it disperses"},
             {1.0, 10.0, false, false});
    if (r.onlyWith("abbe_number", "ior"))
        r.number(keys.abbeNumber,
                 {"abbe_number", "Takes colors apart: (n_d - 1) / (n_F - n_C), of glass 20 to 90"},
                 {1.0, 1e6, false, false});
    r.vector(keys.cauchy, {"cauchy", "In place of ior: A, B and C of n = A + B/λ² + C/λ⁴, λ in µm"},
             kAnyNumber);
    r.table(keys.sellmeier, {"sellmeier", "In place of ior: n² = 1 + Σ b λ²/(λ² - c), λ in µm"});
    r.text(keys.glass,
           {"glass", "In place of ior: a material by its name, such as N-BK7 or water"});
    r.rule({{"ior", "cauchy", "sellmeier", "glass"},
            true,
            "",
            "one of ior, cauchy, sellmeier and glass is given",
            "ior"});
}

struct MaterialKeys {
    Material material;
    DispersionKeys dispersion;
    std::optional<std::string> texture;
    std::optional<std::string> normalMap;
};
template <class R>
void reflectNormalMap(R& r, MaterialKeys& keys) {
    r.text(keys.normalMap,
           {"normal_map",
            "An image next to the scene file with tangent-space normals: x along u, y along "
            "v, z out of the surface, each as (1 + x) / 2"});
    if (r.onlyWith("normal_scale", "normal_map"))
        r.number(keys.material.normalScale, {"normal_scale", "Of the normal map's x and y"},
                 {-100.0, 100.0, false, false}, kHasDefault);
    if (r.onlyWith("uv_scale", "normal_map"))
        r.uniformOrVector(keys.material.uvScale,
                          {"uv_scale", "Repeats of the normal map a unit of uv"}, kPositive,
                          kHasDefault);
}
template <class R>
void reflect(R& r, MaterialKeys& keys) {
    Material& material = keys.material;
    r.name(material.name);
    r.kind(material.kind, {"type", "What kind of material it is"},
           {{"lambertian", MaterialKind::lambertian},
            {"dielectric", MaterialKind::dielectric},
            {"mirror", MaterialKind::mirror},
            {"glossy", MaterialKind::glossy}});
    if (material.kind == MaterialKind::dielectric) {
        material.albedo = glm::vec3(0.0f);
        reflect(r, keys.dispersion);
        r.uniformOrVector(material.absorptionPerMeter,
                          {"absorption_per_meter", "Absorption inside", "1/m"}, kNotNegative,
                          kHasDefault);
        reflectNormalMap(r, keys);
        return;
    }
    if (material.kind == MaterialKind::mirror) {
        material.albedo = glm::vec3(1.0f);
        r.uniformOrVector(material.albedo, {"reflectance", "Share of light that is reflected"},
                          kUnitInterval, kHasDefault);
        reflectNormalMap(r, keys);
        return;
    }
    r.uniformOrVector(material.albedo,
                      {"albedo", "Share of light that is reflected in all directions"},
                      kUnitInterval);
    r.choice(material.pattern, {"pattern", "What is mixed with a second albedo"},
             {{"none", Pattern::none}, {"checker", Pattern::checker}, {"tiles", Pattern::tiles}},
             kHasDefault);
    r.uniformOrVector(material.patternAlbedo, {"pattern_albedo", "The second albedo"},
                      kUnitInterval, kHasDefault);
    r.uniformOrVector(material.uvScale, {"uv_scale", "Repeats of pattern and texture a unit of uv"},
                      kPositive, kHasDefault);
    r.text(keys.texture,
           {"texture", "An image beside the scene file, which multiplies the albedo"});
    r.uniformOrVector(material.emission,
                      {"emission", "Radiance of its front, which makes it a lamp", "W/m²/sr"},
                      kNotNegative, kHasDefault);
    if (material.kind == MaterialKind::lambertian) return;
    // Narrower lobes, below a degree, are beyond what 32 bits tell apart on the device.
    r.uniformOrVector(material.specular,
                      {"specular", "Share of light in the lobe; with an albedo at most 1"},
                      kUnitInterval);
    r.number(material.exponent, {"exponent", "Of the lobe's cosine"}, {1.0, 10000.0, false, false},
             kHasDefault);
}

struct FitKeys {
    std::optional<double> height;
    std::optional<double> size;
};
template <class R>
void reflect(R& r, FitKeys& fit) {
    r.number(fit.height, {"height", "Along y", "m"}, kPositive);
    r.number(fit.size, {"size", "The longest side", "m"}, kPositive);
    r.rule({{"height", "size"}, true, "", "fit must be {height = …} or {size = …}"});
}

struct ObjectKeys {
    std::string name;
    std::string material;
    bool isMesh = false;
    glm::dvec3 position{0.0};
    glm::dvec3 rotationDegrees{0.0};
    glm::dvec3 scale{1.0};
    std::string mesh;
    std::optional<double> restOn;
    std::optional<FitKeys> fit;
    Shape shape;
};
template <class R>
void reflect(R& r, ObjectKeys& object) {
    r.name(object.name);
    r.text(object.material, {"material", "The name of a [[material]]"});
    r.kind(object.isMesh, "mesh");
    r.rule({{"mesh", "shape"}, false, "shape", "either mesh or shape is given, not both"});
    r.vector(object.position, {"position", "Where its origin is", "m"}, kAnyNumber, kHasDefault);
    r.vector(object.rotationDegrees, {"rotation_degrees", "About the fixed axes x, then y, then z"},
             kAnyNumber, kHasDefault);
    r.uniformOrVector(object.scale, {"scale", "Of its size, along its own axes"}, kPositive,
                      kHasDefault);
    if (object.isMesh) {
        r.text(
            object.mesh,
            {"mesh",
             "A file .obj, .ply, .ply.gz, .stl, .3ds, .gltf or .glb, next to the scene file or in "
             "meshes/"});
        r.number(object.restOn, {"rest_on", "The height that its lowest point stands at", "m"},
                 kAnyNumber);
        r.rule({{"fit", "scale"}, false, "fit", "either fit or scale is given, not both"});
        r.table(object.fit, {"fit", "Scales it to a height or to its longest side"});
        return;
    }
    r.kind(object.shape, {"shape", "What it is instead of a mesh"},
           Choices<Shape>{{"plane", PlaneShape()},
                          {"disc", DiscShape()},
                          {"box", BoxShape()},
                          {"sphere", SphereShape()},
                          {"cylinder", CylinderShape()},
                          {"ring", RingShape()},
                          {"torus", TorusShape()},
                          {"tree", TreeShape()},
                          {"lens", LensShape()},
                          {"prism", PrismShape()},
                          {"paraboloid", ParaboloidShape()},
                          {"water", HeightField()}});
    std::visit([&](auto& shape) { reflect(r, shape); }, object.shape);
}

struct SceneKeys {
    std::optional<std::string> name;
    std::string description;
    glm::vec3 backgroundRadiance{0.0f};
    glm::vec3 ambientIrradiance{0.0f};
    double timeSeconds = 0.0;
    TableOf<Camera> camera;
    TableOf<Medium> medium;
    TableOf<EnvironmentKeys> environment;
    TablesOf<LightKeys> lights;
    TablesOf<MaterialKeys> materials;
    TablesOf<ObjectKeys> objects;
};
template <class R>
void reflect(R& r, SceneKeys& scene) {
    r.text(scene.name, {"name", "That of the file if not given"});
    r.text(scene.description, {"description", "A sentence for lists"}, kHasDefault);
    r.uniformOrVector(scene.backgroundRadiance,
                      {"background_radiance", "From wherever no surface is", "W/m²/sr"},
                      kNotNegative, kHasDefault);
    r.uniformOrVector(scene.ambientIrradiance,
                      {"ambient_irradiance", "On every surface, for the picture only", "W/m²"},
                      kNotNegative, kHasDefault);
    r.number(scene.timeSeconds, {"time", "Of the animation", "s"}, kAnyNumber, kHasDefault);
    r.table(scene.camera, {"camera", "Where it is seen from"});
    r.table(scene.medium, {"medium", "What fills the scene"});
    r.table(scene.environment, {"environment", "What surrounds the scene"});
    r.tables(scene.lights, {"light", "What shines"});
    r.tables(scene.materials, {"material", "What objects are made of"});
    r.tables(scene.objects, {"object", "Meshes and shapes"});
}

// The keys of a file that says what is changed of another scene (scene_edits.h).
struct LightEditKeys {
    std::string name;
    std::optional<glm::dvec3> direction;
    std::optional<glm::dvec3> position;
    std::optional<double> angularDiameterDegrees;
    std::optional<float> powerFactor;
};
template <class R>
void reflect(R& r, LightEditKeys& light) {
    r.name(light.name);
    r.direction(light.direction, {"direction", "Where its light goes"});
    r.vector(light.position, {"position", "Where it is", "m"}, kAnyNumber);
    r.number(light.angularDiameterDegrees,
             {"angular_diameter_degrees", "That a directional light's disc takes of the sky"},
             {0.0, 90.0, false, false});
    r.number(light.powerFactor, {"power_factor", "Multiplies its power"}, kNotNegative);
}

struct WaterEditKeys {
    std::string object;
    std::vector<Wave> waves;
};
template <class R>
void reflect(R& r, WaterEditKeys& water) {
    r.text(water.object, {"object", "The water that is changed"});
    reflectWaves(r, water.waves);
}

struct EditKeys {
    std::optional<double> timeSeconds;
    TableOf<Camera> camera;
    TableOf<Medium> medium;
    TablesOf<LightEditKeys> lights;
    TablesOf<WaterEditKeys> waters;
};
template <class R>
void reflect(R& r, EditKeys& edits) {
    r.number(edits.timeSeconds, {"time", "Of the animation", "s"}, kAnyNumber);
    r.table(edits.camera, {"camera", "Where it is seen from"});
    r.table(edits.medium, {"medium", "What fills the scene"});
    r.tables(edits.lights, {"light", "Changes to lights"});
    r.tables(edits.waters, {"water", "Changes to waters"});
}

struct ExtensionKeys {
    std::string extends;
    std::optional<std::string> name;
    std::string description;
    EditKeys edits;
};
template <class R>
void reflect(R& r, ExtensionKeys& extension) {
    r.text(extension.extends, {"extends", "Another scene: a name, or a path seen from this file"});
    r.text(extension.name, {"name", "That of the file if not given"});
    r.text(extension.description, {"description", "A sentence for lists"}, kHasDefault);
    reflect(r, extension.edits);
}

}  // namespace kaustik::scene
