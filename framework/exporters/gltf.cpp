// SPDX-License-Identifier: MIT
// A scene as glTF 2.0 with KHR extensions. Lights there are in lux and candela: 683 lm/W, as the
// importer has it. Cameras and lights look along their own -z. A picture's first row is at v = 0.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/core/json_text.h"
#include "framework/exporters/parts.h"

namespace kaustik::exporters {
namespace {

using nlohmann::json;

constexpr double kLumensPerWatt = 683.0;
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;
constexpr int kNearest = 9728;
constexpr int kLinear = 9729;
constexpr int kRepeat = 10497;

json listOf(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

// Column by column.
json matrixOf(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z,
              const glm::dvec3& position) {
    return {x.x, x.y, x.z, 0.0, y.x,        y.y,        y.z,        0.0,
            z.x, z.y, z.z, 0.0, position.x, position.y, position.z, 1.0};
}

class GltfScene {
  public:
    explicit GltfScene(Exporter& exporter) : exporter_(exporter), scene_(exporter.scene) {}

    void run() {
        document_ = {{"asset", {{"version", "2.0"}, {"generator", "kaustik"}}},
                     {"scene", 0},
                     {"nodes", json::array()},
                     {"materials", json::array()},
                     {"meshes", json::array()},
                     {"accessors", json::array()},
                     {"bufferViews", json::array()}};
        addCamera();
        for (const scene::Light& light : exporter_.lights())
            addLight(light);
        for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
            if (exporter_.isUsed(i)) addMaterial(i);
        }
        for (const WorldMesh& mesh : exporter_.meshes())
            addMesh(mesh);
        if (scene_.medium) exporter_.leaveOut("medium", "glTF has none around its objects");
        json nodes = json::array();
        for (std::size_t i = 0; i < document_["nodes"].size(); ++i)
            nodes.push_back(i);
        document_["scenes"] = {{{"nodes", nodes}}};
        document_["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", bytes_.size()}}};
        if (!extensions_.empty()) document_["extensionsUsed"] = extensions_;
        exporter_.write("scene.bin", bytes_);
        exporter_.writeScene("scene.gltf", jsonText(document_, 1) + "\n",
                             "any viewer of glTF 2.0 with its KHR extensions");
    }

  private:
    void addCamera() {
        const Axes eye = exporter_.camera();
        document_["cameras"] = {
            {{"type", "perspective"},
             {"perspective",
              {{"yfov", glm::radians(scene_.camera.verticalFovDegrees)},
               {"aspectRatio", double(exporter_.request.width) / exporter_.request.height},
               {"znear", scene_.camera.nearMeters}}}}};
        document_["nodes"].push_back(
            {{"name", "camera"},
             {"camera", 0},
             {"matrix", matrixOf(eye.right, eye.up, -eye.forward, eye.position)}});
    }

    void addLight(const scene::Light& light) {
        const std::string subject = fmt::format("light '{}'", light.name);
        const glm::dvec3 power(light.power);
        const double most = std::max({power.r, power.g, power.b});
        ++exporter_.result.lightCount;
        json entry = {{"name", light.name},
                      {"color", listOf(most > 0.0 ? power / most : power)},
                      {"intensity", most * kLumensPerWatt}};
        if (light.kind == scene::LightKind::directional) {
            entry["type"] = "directional";
            if (light.angularDiameterRadians > 0.0f) {
                exporter_.change(subject,
                                 fmt::format("its disc of {:.3g} degrees is a point of the sky",
                                             glm::degrees(light.angularDiameterRadians)));
            }
        } else {
            entry["type"] = light.kind == scene::LightKind::point ? "point" : "spot";
            if (light.rangeMeters > 0.0f) entry["range"] = light.rangeMeters;
        }
        if (light.kind == scene::LightKind::spot) {
            entry["spot"] = {{"innerConeAngle", light.innerConeRadians},
                             {"outerConeAngle", light.outerConeRadians}};
            if (light.image >= 0) exporter_.leaveOut(subject, "the picture that it projects");
        }
        extensions_.insert("KHR_lights_punctual");
        json& lights = document_["extensions"]["KHR_lights_punctual"]["lights"];
        const std::size_t index = lights.size();
        lights.push_back(entry);
        const glm::dvec3 back =
            light.kind == scene::LightKind::point ? glm::dvec3(0, 0, 1) : -light.direction;
        const glm::dvec3 up = std::abs(back.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        const glm::dvec3 right = glm::normalize(glm::cross(up, back));
        document_["nodes"].push_back(
            {{"name", light.name},
             {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}},
             {"matrix", matrixOf(right, glm::cross(back, right), back, light.position)}});
    }

    // The index of a texture.
    std::size_t addTexture(const std::string& file, bool isSmooth) {
        const int filter = isSmooth ? kLinear : kNearest;
        document_["samplers"].push_back(
            {{"magFilter", filter}, {"minFilter", filter}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
        document_["images"].push_back({{"uri", file}});
        const std::size_t index = document_["images"].size() - 1;
        document_["textures"].push_back({{"sampler", index}, {"source", index}});
        return index;
    }

    void addMaterial(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        glm::dvec3 color(material.albedo);
        json pbr = {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
        json entry = {{"name", material.name}};
        if (material.kind == scene::MaterialKind::mirror) {
            pbr["metallicFactor"] = 1.0;
            pbr["roughnessFactor"] = 0.0;
        } else if (material.kind == scene::MaterialKind::dielectric) {
            color = glm::dvec3(1.0);
            pbr["roughnessFactor"] = 0.0;
            addGlass(material, entry);
        } else {
            const Picture picture = exporter_.albedoPicture(index, PictureFormat::png, false);
            if (picture.kind == PictureKind::file) {
                color = glm::dvec3(1.0);
                pbr["baseColorTexture"] = {{"index", addTexture(picture.file, picture.isSmooth)}};
                exporter_.change(fmt::format("material '{}'", material.name),
                                 "its albedo is rounded to the 8 bits of a PNG");
            }
            addEmission(material, entry);
        }
        repeats_[index] =
            material.pattern == scene::Pattern::checker && material.image < 0 ? 2.0 : 1.0;
        pbr["baseColorFactor"] = {color.r, color.g, color.b, 1.0};
        entry["pbrMetallicRoughness"] = pbr;
        if (material.normalMap >= 0) {
            entry["normalTexture"] = {
                {"index", addTexture(exporter_.normalMapFile(index, PictureFormat::png), true)}};
            exporter_.change(fmt::format("material '{}'", material.name),
                             "its normal map is rounded to the 8 bits of a PNG");
        }
        places_[index] = document_["materials"].size();
        document_["materials"].push_back(entry);
    }

    void addEmission(const scene::Material& material, json& entry) {
        const glm::dvec3 emission = kLumensPerWatt * glm::dvec3(material.emission);
        const double most = std::max({emission.r, emission.g, emission.b});
        if (!(most > 0.0)) return;
        ++exporter_.result.lightCount;
        entry["emissiveFactor"] = listOf(emission / most);
        addExtension(entry, "KHR_materials_emissive_strength", {{"emissiveStrength", most}});
    }

    void addExtension(json& entry, const char* name, const json& fields) {
        extensions_.insert(name);
        entry["extensions"][name] = fields;
    }

    void addGlass(const scene::Material& material, json& entry) {
        addExtension(entry, "KHR_materials_transmission", {{"transmissionFactor", 1.0}});
        addExtension(entry, "KHR_materials_ior", {{"ior", material.ior}});
        json volume = {{"thicknessFactor", 1.0}};
        const glm::dvec3 absorption(material.absorptionPerMeter);
        const double most = std::max({absorption.r, absorption.g, absorption.b});
        if (most > 0.0) {
            volume["attenuationDistance"] = 1.0 / most;
            volume["attenuationColor"] = listOf(glm::exp(-absorption / most));
        }
        addExtension(entry, "KHR_materials_volume", volume);
        if (const auto abbe = abbeNumberOf(material)) {
            addExtension(entry, "KHR_materials_dispersion", {{"dispersion", 20.0 / *abbe}});
            exporter_.change(fmt::format("material '{}'", material.name),
                             "it disperses by its Abbe number alone");
        }
    }

    template <class T>
    std::size_t addView(const std::vector<T>& values, int target) {
        const std::size_t offset = bytes_.size();
        const std::size_t size = values.size() * sizeof(T);
        bytes_.resize(offset + size);
        if (size > 0) std::memcpy(bytes_.data() + offset, values.data(), size);
        document_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
        return document_["bufferViews"].size() - 1;
    }

    template <class T>
    std::size_t addAccessor(const std::vector<T>& values, int component, const char* type,
                            std::size_t count, int target, const json& more = json::object()) {
        json accessor = {{"bufferView", addView(values, target)},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}};
        accessor.update(more);
        document_["accessors"].push_back(accessor);
        return document_["accessors"].size() - 1;
    }

    void addMesh(const WorldMesh& mesh) {
        // Positions are 32-bit: from the mesh's own middle they lose the least.
        scene::Bounds bounds;
        for (const glm::dvec3& position : mesh.positions)
            bounds.include(position);
        const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
        std::vector<float> positions;
        std::vector<float> normals;
        std::vector<float> uvs;
        glm::vec3 least(bounds.maximum - middle);
        glm::vec3 most(bounds.minimum - middle);
        const double repeat = repeats_[mesh.material];
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 position(mesh.positions[i] - middle);
            least = glm::min(least, position);
            most = glm::max(most, position);
            for (glm::length_t c = 0; c < 3; ++c) {
                positions.push_back(position[c]);
                normals.push_back(static_cast<float>(mesh.normals[i][c]));
            }
            uvs.push_back(static_cast<float>(mesh.uvs[i].x / repeat));
            uvs.push_back(static_cast<float>(1.0 - mesh.uvs[i].y / repeat));
        }
        const std::size_t count = mesh.positions.size();
        json attributes = {{"POSITION", addAccessor(positions, kFloat, "VEC3", count, kVertexBuffer,
                                                    {{"min", {least.x, least.y, least.z}},
                                                     {"max", {most.x, most.y, most.z}}})},
                           {"NORMAL", addAccessor(normals, kFloat, "VEC3", count, kVertexBuffer)},
                           {"TEXCOORD_0", addAccessor(uvs, kFloat, "VEC2", count, kVertexBuffer)}};
        std::vector<std::uint32_t> indices;
        for (const glm::uvec3& triangle : mesh.triangles)
            indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
        document_["meshes"].push_back({{"name", mesh.name},
                                       {"primitives",
                                        {{{"attributes", attributes},
                                          {"indices", addAccessor(indices, kUnsignedInt, "SCALAR",
                                                                  indices.size(), kIndexBuffer)},
                                          {"material", places_.at(mesh.material)}}}}});
        document_["nodes"].push_back({{"name", mesh.name},
                                      {"mesh", document_["meshes"].size() - 1},
                                      {"translation", listOf(middle)}});
    }

    Exporter& exporter_;
    const scene::Scene& scene_;
    json document_;
    std::string bytes_;
    std::set<std::string> extensions_;
    std::map<std::uint32_t, std::size_t> places_;  // of materials in the document
    std::map<std::uint32_t, double> repeats_;      // Picture::repeatUnits
};

}  // namespace

void exportGltf(Exporter& exporter) {
    GltfScene(exporter).run();
}

}  // namespace kaustik::exporters
