// SPDX-License-Identifier: MIT
#include "framework/importers/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>
#include <tuple>

#include "framework/core/error.h"
#include "framework/importers/gltf_document.h"
#include "framework/importers/gltf_materials.h"
#include "framework/importers/gltf_meshes.h"

namespace kaustik::scene {
namespace {

class Importer {
  public:
    Importer(const tinygltf::Model& model, const std::filesystem::path& path, GltfUse use)
        : model_(model), path_(path), file_(path.string()), use_(use) {}

    Scene run() {
        scene_.name = path_.stem().string();
        scene_.file = path_;
        warnAboutExtensions();
        importGltfMaterials(model_, path_, scene_);
        walkNodes();
        if (!hasCamera_ && use_ == GltfUse::scene) frameBounds();
        if (scene_.lights.empty() && use_ == GltfUse::scene) {
            warn("the file has no light (KHR_lights_punctual), so that nothing is lit");
        }
        if (scene_.objects.empty()) warn("the file's scene has no triangles");
        if (!model_.animations.empty()) warn("animations were left out");
        return std::move(scene_);
    }

  private:
    void warn(const std::string& what) {
        scene_.warnings.push_back(fmt::format("{}: {}.", file_, what));
    }

    void warnAboutExtensions() {
        for (const std::string& extension : model_.extensionsUsed) {
            if (extension == "KHR_lights_punctual" || extension == "KHR_materials_transmission" ||
                extension == "KHR_materials_ior" || extension == "KHR_materials_volume" ||
                extension == "KHR_materials_emissive_strength") {
                continue;
            }
            warn(fmt::format("the extension {} is not read", extension));
        }
    }

    std::vector<int> rootNodes() {
        if (!model_.scenes.empty()) {
            return model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))].nodes;
        }
        std::vector<bool> isChild(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children)
                isChild[static_cast<std::size_t>(child)] = true;
        }
        std::vector<int> roots;
        for (std::size_t i = 0; i < isChild.size(); ++i) {
            if (!isChild[i]) roots.push_back(static_cast<int>(i));
        }
        return roots;
    }

    // Depth first and without recursion, since a chain of nodes may be as long as the file.
    void walkNodes() {
        struct Visit {
            std::size_t node;
            glm::dmat4 parentToWorld;
        };
        std::vector<Visit> stack;
        const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& parentToWorld) {
            for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
                stack.push_back({static_cast<std::size_t>(*node), parentToWorld});
            }
        };
        std::vector<bool> visited(model_.nodes.size(), false);
        push(rootNodes(), glm::dmat4(1.0));
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (visited[visit.node]) {
                throw IoError(
                    fmt::format("{}: nodes[{}] has two parents or is its own ancestor. "
                                "Export the file again.",
                                file_, visit.node));
            }
            visited[visit.node] = true;
            const glm::dmat4 toWorld = visit.parentToWorld * localTransform(visit.node);
            for (glm::length_t column = 0; column < 4; ++column) {
                if (std::isfinite(glm::dot(toWorld[column], glm::dvec4(1.0)))) continue;
                fail(visit.node, "", "has a transform beyond all numbers");
            }
            importNode(visit.node, toWorld);
            push(model_.nodes[visit.node].children, toWorld);
        }
    }

    [[noreturn]] void fail(std::size_t node, const std::string& field,
                           const std::string& problem) const {
        throw ConfigError(fmt::format("{}: nodes[{}]{} {}.", file_, node, field, problem));
    }

    glm::dmat4 localTransform(std::size_t index) const {
        const tinygltf::Node& node = model_.nodes[index];
        if (!node.matrix.empty()) {
            glm::dmat4 matrix(1.0);
            for (glm::length_t i = 0; i < 16; ++i) {  // by columns, as glm
                matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
            }
            constexpr double kRounding = 1e-6;
            const glm::dvec4 last = glm::row(matrix, 3);
            if (!(glm::distance(last, glm::dvec4(0.0, 0.0, 0.0, 1.0)) <= kRounding)) {
                fail(index, ".matrix", "has a last row that is not 0 0 0 1");
            }
            return glm::row(matrix, 3, glm::dvec4(0.0, 0.0, 0.0, 1.0));
        }
        glm::dmat4 transform(1.0);
        if (!node.translation.empty())
            transform = glm::translate(transform, vector(node.translation));
        if (!node.rotation.empty()) {
            const std::vector<double>& r = node.rotation;  // x, y, z, w
            const glm::dquat rotation(r[3], r[0], r[1], r[2]);
            if (glm::length(rotation) < 0.5) fail(index, ".rotation", "is no unit quaternion");
            transform *= glm::mat4_cast(glm::normalize(rotation));
        }
        if (!node.scale.empty()) transform = glm::scale(transform, vector(node.scale));
        return transform;
    }

    static glm::dvec3 vector(const std::vector<double>& values) {
        return {values[0], values[1], values[2]};
    }

    void importNode(std::size_t index, const glm::dmat4& toWorld) {
        const tinygltf::Node& node = model_.nodes[index];
        if (node.mesh >= 0) importObjects(index, toWorld);
        if (node.camera >= 0) importCamera(index, toWorld);
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end() && light->second.Has("light")) {
            const int lightIndex = light->second.Get("light").GetNumberAsInt();
            importLight(static_cast<std::size_t>(lightIndex), index, toWorld);
        }
    }

    void importObjects(std::size_t nodeIndex, const glm::dmat4& toWorld) {
        const tinygltf::Node& node = model_.nodes[nodeIndex];
        const auto meshIndex = static_cast<std::size_t>(node.mesh);
        const tinygltf::Mesh& mesh = model_.meshes[meshIndex];
        const double determinant = glm::determinant(glm::dmat3(toWorld));
        if (determinant == 0.0) {
            warn(fmt::format("nodes[{}] is scaled to nothing and was left out", nodeIndex));
            return;
        }
        if (node.skin >= 0) {
            warn(fmt::format("nodes[{}].skin is left out: the mesh stays as it is", nodeIndex));
        }
        const bool mirrored = determinant < 0.0;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const int imported = importPrimitive(meshIndex, i, mirrored);
            if (imported < 0) continue;
            const int material = mesh.primitives[i].material;
            Object object;
            object.name = node.name.empty() ? fmt::format("node {}", nodeIndex) : node.name;
            if (mesh.primitives.size() > 1) object.name += fmt::format(" ({})", i);
            object.mesh = static_cast<std::uint32_t>(imported);
            object.material = static_cast<std::uint32_t>(
                material >= 0 ? static_cast<std::size_t>(material) : scene_.materials.size() - 1);
            object.toWorld = mirrored ? glm::scale(toWorld, glm::dvec3(-1.0, 1.0, 1.0)) : toWorld;
            scene_.objects.push_back(object);
        }
    }

    // The place of the mesh in the scene, shared by all nodes that use it; -1 when it has no
    // triangles.
    int importPrimitive(std::size_t meshIndex, std::size_t primitiveIndex, bool mirrored) {
        const auto key = std::make_tuple(meshIndex, primitiveIndex, mirrored);
        const auto known = imported_.find(key);
        if (known != imported_.end()) return known->second;
        const int uvSet =
            gltfUvSet(model_, model_.meshes[meshIndex].primitives[primitiveIndex].material);
        std::optional<Mesh> mesh = importGltfPrimitive(model_, meshIndex, primitiveIndex, uvSet,
                                                       mirrored, file_, scene_.warnings);
        int place = -1;
        if (mesh) {
            place = static_cast<int>(scene_.meshes.size());
            scene_.meshes.push_back(std::move(*mesh));
        }
        imported_[key] = place;
        return place;
    }

    // Cameras and lights look down their own -Z.
    glm::dvec3 unitAxis(const glm::dmat4& toWorld, glm::length_t axis, std::size_t node) const {
        const double length = glm::length(glm::dvec3(toWorld[axis]));
        if (!(length > 0.0)) fail(node, "", "has a camera or light but is scaled to nothing");
        return glm::dvec3(toWorld[axis]) / length;
    }

    void importCamera(std::size_t nodeIndex, const glm::dmat4& toWorld) {
        const int index = model_.nodes[nodeIndex].camera;
        const tinygltf::Camera& source = model_.cameras[static_cast<std::size_t>(index)];
        if (source.type != "perspective") {
            warn(fmt::format("cameras[{}] is not a perspective camera and was left out", index));
            return;
        }
        if (hasCamera_) return;
        hasCamera_ = true;
        Camera& camera = scene_.camera;
        camera.position = glm::dvec3(toWorld[3]);
        camera.target = camera.position - unitAxis(toWorld, 2, nodeIndex);
        camera.up = unitAxis(toWorld, 1, nodeIndex);
        camera.verticalFovDegrees = source.perspective.yfov * 180.0 / std::numbers::pi;
        camera.nearMeters = source.perspective.znear;
    }

    void importLight(std::size_t index, std::size_t nodeIndex, const glm::dmat4& toWorld) {
        const tinygltf::Light& source = model_.lights[index];
        const std::string field = fmt::format("extensions.KHR_lights_punctual.lights[{}]", index);
        Light light;
        light.name = source.name.empty() ? fmt::format("light {}", index) : source.name;
        if (source.type == "directional") {
            light.kind = LightKind::directional;
        } else if (source.type == "point") {
            light.kind = LightKind::point;
        } else if (source.type == "spot") {
            light.kind = LightKind::spot;
            importCone(source.spot, field, light);
        } else {
            throw ConfigError(
                fmt::format("{}: {}.type is '{}'; it must be directional, point or spot.", file_,
                            field, source.type));
        }
        light.position = glm::dvec3(toWorld[3]);
        light.direction = -unitAxis(toWorld, 2, nodeIndex);
        const glm::dvec3 color = source.color.size() == 3 ? vector(source.color) : glm::dvec3(1.0);
        light.power = glm::vec3(color * source.intensity / kLumensPerWatt);
        // tinygltf has 0 where the file has no range, as Light.
        light.rangeMeters =
            light.kind == LightKind::directional ? 0.0f : static_cast<float>(source.range);
        if (!std::isfinite(glm::dot(light.power, glm::vec3(1.0f))) ||
            !std::isfinite(light.rangeMeters)) {
            throw ConfigError(fmt::format("{}: {} has an intensity or range too large for 32 bits.",
                                          file_, field));
        }
        scene_.lights.push_back(light);
    }

    void importCone(const tinygltf::SpotLight& spot, const std::string& field, Light& light) const {
        if (!(spot.innerConeAngle <= spot.outerConeAngle)) {
            throw ConfigError(fmt::format(
                "{}: {}.spot.innerConeAngle is {}; it must be below outerConeAngle, {}.", file_,
                field, spot.innerConeAngle, spot.outerConeAngle));
        }
        // Exporters of lamps with a sharp edge write the same angle twice, which glTF forbids.
        constexpr double kSharpest = 0.999;
        light.innerConeRadians =
            static_cast<float>(std::min(spot.innerConeAngle, kSharpest * spot.outerConeAngle));
        light.outerConeRadians = static_cast<float>(spot.outerConeAngle);
    }

    // A camera from slightly above that sees the whole scene.
    void frameBounds() {
        const Bounds bounds = sceneBounds(scene_);
        if (bounds.empty) return;
        Camera& camera = scene_.camera;
        const double radius = std::max(0.5 * glm::length(bounds.maximum - bounds.minimum), 1e-6);
        // The sphere around the bounds fills the view from top to bottom.
        const double halfAngle = 0.5 * camera.verticalFovDegrees * std::numbers::pi / 180.0;
        const double distance = radius / std::sin(halfAngle);
        camera.target = 0.5 * (bounds.minimum + bounds.maximum);
        camera.position = camera.target + distance * glm::normalize(glm::dvec3(0.4, 0.5, 1.0));
        camera.nearMeters = 1e-3 * distance;
        warn("the file has no perspective camera; one that sees the whole scene was made");
    }

    const tinygltf::Model& model_;
    const std::filesystem::path& path_;
    std::string file_;
    GltfUse use_;
    Scene scene_;
    bool hasCamera_ = false;
    std::map<std::tuple<std::size_t, std::size_t, bool>, int> imported_;
};

}  // namespace

Scene readGltfFile(const std::filesystem::path& path, GltfUse use) {
    const tinygltf::Model model = loadGltfModel(path);
    return Importer(model, path, use).run();
}

}  // namespace kaustik::scene
