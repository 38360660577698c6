// SPDX-License-Identifier: MIT
#include "framework/importers/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <system_error>

#include "framework/core/error.h"
#include "framework/scene/dispersion.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

// A metal up to this roughness is a mirror. Roughness 0.1 is a microfacet slope of 0.01: a cone of
// about half a degree, the size of the sun.
constexpr double kSmoothRoughness = 0.1;

// An extension of a material, whose fields were checked before.
class Extension {
  public:
    Extension(const tinygltf::Material& material, const char* name) {
        const auto found = material.extensions.find(name);
        if (found != material.extensions.end()) value_ = &found->second;
    }
    [[nodiscard]] bool present() const { return value_ != nullptr; }
    [[nodiscard]] bool has(const char* field) const { return present() && value_->Has(field); }
    [[nodiscard]] double number(const char* field, double fallback) const {
        return has(field) ? value_->Get(field).GetNumberAsDouble() : fallback;
    }
    [[nodiscard]] glm::dvec3 color(const char* field, const glm::dvec3& fallback) const {
        if (!has(field)) return fallback;
        const tinygltf::Value& list = value_->Get(field);
        return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble(),
                list.Get(2).GetNumberAsDouble()};
    }

  private:
    const tinygltf::Value* value_ = nullptr;
};

class MaterialImporter {
  public:
    MaterialImporter(const tinygltf::Model& model, const fs::path& path, Scene& scene)
        : model_(model), path_(path), scene_(scene) {}

    void run() {
        for (index_ = 0; index_ < model_.materials.size(); ++index_) {
            scene_.materials.push_back(convert(model_.materials[index_]));
        }
        Material fallback;
        fallback.name = "none";
        fallback.albedo = glm::vec3(1.0f);
        scene_.materials.push_back(fallback);
    }

  private:
    std::string field(const std::string& name) const {
        return fmt::format("{}: materials[{}].{}", path_.string(), index_, name);
    }
    void warn(const std::string& name, const std::string& what) {
        scene_.warnings.push_back(fmt::format("{} {}.", field(name), what));
    }

    Material convert(const tinygltf::Material& source) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        Material material;
        material.name = source.name.empty() ? fmt::format("material {}", index_) : source.name;
        material.albedo = glm::vec3(
            glm::dvec3(pbr.baseColorFactor[0], pbr.baseColorFactor[1], pbr.baseColorFactor[2]));
        if (isTransmissive(source)) {
            convertDielectric(source, material);
        } else {
            convertOpaque(source, material);
        }
        if (source.emissiveFactor != std::vector<double>{0.0, 0.0, 0.0}) {
            convertEmission(source, material);
        }
        if (source.alphaMode != "OPAQUE") {
            warn("alphaMode",
                 fmt::format("{} is left out: the surface is whole", source.alphaMode));
        }
        if (source.normalTexture.index >= 0) convertNormals(source.normalTexture, material);
        return material;
    }

    void convertNormals(const tinygltf::NormalTextureInfo& source, Material& material) {
        if (isReceiver(material.kind)) {
            warn("normalTexture", "is left out: receivers are as flat as their triangles");
            return;
        }
        if (source.extensions.contains("KHR_texture_transform"))
            warn("normalTexture.extensions.KHR_texture_transform", "is left out");
        material.normalMap = importImage(static_cast<std::size_t>(source.index), true);
        material.normalScale = static_cast<float>(source.scale);
    }

    // In candela a square metre. A texture is no even lamp: most of it is black.
    void convertEmission(const tinygltf::Material& source, Material& material) {
        if (source.emissiveTexture.index >= 0) {
            warn("emissiveTexture", "is left out, and with it emissiveFactor: lamps shine evenly");
        } else if (!isReceiver(material.kind)) {
            warn("emissiveFactor", "is left out: glass and mirrors give no light here");
        } else {
            const glm::dvec3 factor(source.emissiveFactor[0], source.emissiveFactor[1],
                                    source.emissiveFactor[2]);
            const double strength = Extension(source, "KHR_materials_emissive_strength")
                                        .number("emissiveStrength", 1.0);
            material.emission = glm::vec3(factor * strength / kLumensPerWatt);
        }
    }

    bool isTransmissive(const tinygltf::Material& source) {
        const Extension transmission(source, "KHR_materials_transmission");
        const double factor = transmission.number("transmissionFactor", 0.0);
        const bool transmissive = factor >= 0.5;
        if (transmission.has("transmissionTexture")) {
            warn("extensions.KHR_materials_transmission.transmissionTexture", "is left out");
        }
        if (factor > 0.0 && factor < 1.0) {
            warn("extensions.KHR_materials_transmission.transmissionFactor",
                 fmt::format("is {}; a surface transmits all or nothing here, and this one {}",
                             factor, transmissive ? "all" : "nothing"));
        }
        return transmissive;
    }

    void convertDielectric(const tinygltf::Material& source, Material& material) {
        material.kind = MaterialKind::dielectric;
        material.ior =
            static_cast<float>(Extension(source, "KHR_materials_ior").number("ior", 1.5));
        // 20 over the Abbe number.
        const double strength =
            Extension(source, "KHR_materials_dispersion").number("dispersion", 0.0);
        if (strength > 0.0) {
            const Dispersion dispersion =
                byAbbeNumber(static_cast<double>(material.ior), 20.0 / strength);
            if (isPossible(dispersion)) {
                material.dispersion = glm::vec4(dispersion.polynomial);
            } else {
                warn("extensions.KHR_materials_dispersion.dispersion",
                     "is left out: the index of refraction would be less than 1");
            }
        }
        const Extension volume(source, "KHR_materials_volume");
        if (volume.number("thicknessFactor", 0.0) > 0.0) {
            material.absorptionPerMeter = absorptionFromAttenuation(
                volume.color("attenuationColor", glm::dvec3(1.0)),
                volume.number("attenuationDistance", std::numeric_limits<double>::infinity()));
        } else {
            // To the extension this is a sheet without an inside, which bends and absorbs nothing.
            warn("extensions.KHR_materials_volume.thicknessFactor",
                 "is 0 or missing; the object is rendered as solid, without absorption");
        }
        if (material.albedo != glm::vec3(1.0f) ||
            source.pbrMetallicRoughness.baseColorTexture.index >= 0) {
            warn("pbrMetallicRoughness.baseColor",
                 "is left out: only attenuationColor tints what is transmitted");
            material.albedo = glm::vec3(1.0f);
        }
        if (source.pbrMetallicRoughness.roughnessFactor > kSmoothRoughness) {
            warn("pbrMetallicRoughness.roughnessFactor",
                 "is left out: a transmitting surface is smooth here");
        }
    }

    void convertOpaque(const tinygltf::Material& source, Material& material) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        const bool metal = pbr.metallicFactor == 1.0;
        material.kind = metal && pbr.roughnessFactor <= kSmoothRoughness ? MaterialKind::mirror
                                                                         : MaterialKind::lambertian;
        if (metal && material.kind == MaterialKind::lambertian && pbr.roughnessFactor < 1.0) {
            warn("pbrMetallicRoughness.roughnessFactor",
                 fmt::format("is {}; a metal that rough is rendered as diffuse",
                             pbr.roughnessFactor));
        }
        if (pbr.metallicRoughnessTexture.index >= 0) {
            warn("pbrMetallicRoughness.metallicRoughnessTexture", "is left out");
        }
        if (pbr.baseColorTexture.index >= 0) {
            material.image = importImage(static_cast<std::size_t>(pbr.baseColorTexture.index));
            if (pbr.baseColorTexture.extensions.contains("KHR_texture_transform")) {
                warn("pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform",
                     "is left out");
            }
        }
    }

    // The place of the texture's image in the scene, appended at its first use; -1 for none.
    int importImage(std::size_t textureIndex, bool isNormalMap = false) {
        const int source = model_.textures[textureIndex].source;
        if (source < 0) {
            scene_.warnings.push_back(
                fmt::format("{}: textures[{}] has no source that can be read and was left out.",
                            path_.string(), textureIndex));
            return -1;
        }
        const auto [entry, isNew] =
            imported_.try_emplace({source, isNormalMap}, scene_.images.size());
        if (isNew) {
            scene_.images.push_back(encodedImage(static_cast<std::size_t>(source)));
            scene_.images.back().srgb = !isNormalMap;
            scene_.images.back().isNormalMap = isNormalMap;
        }
        return static_cast<int>(entry->second);
    }

    TextureImage encodedImage(std::size_t imageIndex) const {
        const tinygltf::Image& source = model_.images[imageIndex];
        TextureImage image;
        image.name = fmt::format("{}: images[{}]", path_.string(), imageIndex);
        if (source.bufferView >= 0) {
            // The range was checked against the buffer before it was loaded.
            const tinygltf::BufferView& view =
                model_.bufferViews[static_cast<std::size_t>(source.bufferView)];
            const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
            image.bytes.assign(reinterpret_cast<const char*>(data.data()) + view.byteOffset,
                               view.byteLength);
        } else if (!source.image.empty()) {
            image.bytes.assign(reinterpret_cast<const char*>(source.image.data()),
                               source.image.size());
        } else {
            image.file = gltfUriToFile(path_, source.uri);
            std::error_code error;
            if (!fs::is_regular_file(image.file, error)) {
                throw IoError(
                    fmt::format("{}.uri names {}, which is no file. Put it beside the "
                                "scene.",
                                image.name, image.file.string()));
            }
        }
        return image;
    }

    const tinygltf::Model& model_;
    const fs::path& path_;
    Scene& scene_;
    std::size_t index_ = 0;
    std::map<std::pair<int, bool>, std::size_t> imported_;  // by source, and as a normal map
};

}  // namespace

glm::vec3 absorptionFromAttenuation(const glm::dvec3& color, double distanceMeters) {
    glm::vec3 absorption(0.0f);
    for (glm::length_t c = 0; c < 3; ++c) {
        // A white component or an infinite distance gives 0, a black one infinity.
        const double coefficient = -std::log(color[c]) / distanceMeters;
        const double largest = kOpaquePerMeter;
        // Not std::clamp: black at an infinite distance is not a number, and means no absorption.
        if (coefficient > 0.0) absorption[c] = static_cast<float>(std::min(coefficient, largest));
    }
    return absorption;
}

void importGltfMaterials(const tinygltf::Model& model, const fs::path& path, Scene& scene) {
    MaterialImporter(model, path, scene).run();
}

int gltfUvSet(const tinygltf::Model& model, int materialIndex) {
    if (materialIndex < 0) return 0;
    const auto& material = model.materials[static_cast<std::size_t>(materialIndex)];
    // Of glass and mirrors no colour is taken from a texture.
    if (material.pbrMetallicRoughness.baseColorTexture.index < 0 &&
        material.normalTexture.index >= 0)
        return material.normalTexture.texCoord;
    return material.pbrMetallicRoughness.baseColorTexture.texCoord;
}

}  // namespace kaustik::scene
