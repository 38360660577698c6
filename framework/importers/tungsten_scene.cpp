// SPDX-License-Identifier: MIT
// A Tungsten scene as a whole: its camera and primitives, and at the end what nothing has asked
// for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/names.h"
#include "framework/importers/foreign_file.h"
#include "framework/importers/tungsten_parts.h"

namespace kaustik::scene {
namespace {

constexpr double kDefaultWidth = 1000.0;
constexpr double kDefaultHeight = 563.0;

void tellUnused(TungstenImport& importer, const JsonTree& node, const std::string& path) {
    const auto tell = [&](const JsonTree& child, const std::string& childPath) {
        if (child.isUsed) return tellUnused(importer, child, childPath);
        const JsonTree* const name = child.find("name");
        const auto* const text = name != nullptr ? name->as<std::string>() : nullptr;
        importer.notes.leftOut(
            text != nullptr ? fmt::format("{} '{}'", childPath, *text) : childPath, child.place,
            text != nullptr ? "nothing uses it" : "there is no counterpart");
    };
    if (const auto* const object = node.as<JsonTree::Object>()) {
        for (const auto& [key, child] : *object) {
            if (key != "name" && key != "type")
                tell(child, path.empty() ? key : fmt::format("{}.{}", path, key));
        }
    }
    if (const auto* const list = node.as<JsonTree::List>()) {
        for (std::size_t i = 0; i < list->size(); ++i) {
            if ((*list)[i].as<JsonTree::Object>() != nullptr)
                tell((*list)[i], fmt::format("{}[{}]", path, i));
        }
    }
}

void readResolution(TungstenImport& importer, const JsonTree& camera) {
    glm::dvec2 size(kDefaultWidth, kDefaultHeight);
    if (const JsonTree* const found = camera.find("resolution")) {
        found->markUsed();
        const auto* const list = found->as<JsonTree::List>();
        const auto side = [&](std::size_t i) {
            const auto* const number =
                list != nullptr ? (*list)[i].as<double>() : found->as<double>();
            if (number == nullptr || !(*number >= 1.0 && *number <= 1e5))
                failAt(found->place, "a picture has from 1 to 100000 pixels a side.");
            return *number;
        };
        if (list != nullptr && list->size() != 2)
            failAt(found->place, "a resolution is a width and a height.");
        size = {side(0), side(list != nullptr ? 1 : 0)};
    }
    importer.scene.width = static_cast<std::uint32_t>(size.x);
    importer.scene.height = static_cast<std::uint32_t>(size.y);
}

// A scene has a camera or primitives; a file of something else has neither.
void requireScene(const JsonTree& root, const std::string& file) {
    if (root.as<JsonTree::Object>() == nullptr)
        failAt(root.place.empty() ? file : root.place,
               "a scene of Tungsten is an object, {…}, and this is none.");
    if (root.find("primitives") == nullptr && root.find("camera") == nullptr)
        failAt(root.place,
               "this has neither 'primitives' nor a 'camera', so that it is no scene of "
               "Tungsten.");
}

}  // namespace

std::string TungstenImport::subject(const char* kind, const JsonTree& node) const {
    const std::string name = jsonText(node, "name");
    return fmt::format("{} '{}'", kind, name.empty() ? jsonText(node, "type") : name);
}

std::string TungstenImport::nameOf(const JsonTree& node) {
    const std::string name = jsonText(node, "name");
    if (!name.empty()) return name;
    const std::string type = jsonText(node, "type", "thing");
    return fmt::format("{}-{}", type, ++unnamed[type]);
}

void TungstenImport::leaveOut(const char* kind, const JsonTree& node, const std::string& reason) {
    notes.leftOut(subject(kind, node), node.place, reason);
    node.markUsed();
}

void TungstenImport::change(const char* kind, const JsonTree& node, const std::string& how) {
    notes.changed(subject(kind, node), node.place, how);
}

void readTungstenCamera(TungstenImport& importer, const JsonTree& node) {
    readResolution(importer, node);
    const std::string type = jsonText(node, "type", "pinhole");
    if (type == "thinlens") {
        importer.change("camera", node, "it has a pinhole, so that all is sharp");
    } else if (type != "pinhole") {
        return importer.leaveOut("camera", node, "only pinhole and thinlens have a counterpart");
    }
    const double degrees = jsonNumber(node, "fov", 60.0);
    if (!(degrees > 0.0 && degrees < 180.0))
        failAt(node.place, fmt::format("a field of view is between 0 and 180, not {}.", degrees));
    const glm::dmat4 matrix = jsonTransform(node);
    Camera camera;
    camera.verticalFovDegrees =
        verticalFov(degrees, double(importer.scene.width) / std::max(importer.scene.height, 1u));
    aimCamera(camera, glm::dvec3(matrix[3]), glm::dvec3(matrix[2]), glm::dvec3(matrix[1]),
              node.place);
    importer.scene.camera = camera;
    if (const JsonTree* const medium = mediumNode(importer, node, "medium"))
        importer.scene.medium = mediumOf(importer, *medium);
}

ForeignScene readTungsten(const std::filesystem::path& file) {
    const JsonTree root = readJsonTree(file);
    requireScene(root, file.string());
    ForeignScene scene;
    scene.format = "Tungsten";
    const std::filesystem::path folder = file.parent_path();
    TungstenImport importer{root, folder, scene, ForeignNotes(scene.notes, folder), {}, {}};
    if (const JsonTree* const camera = root.find("camera")) readTungstenCamera(importer, *camera);
    if (const JsonTree* const primitives = root.find("primitives")) {
        const auto* const list = primitives->as<JsonTree::List>();
        if (list == nullptr) failAt(primitives->place, "'primitives' is a list.");
        for (const JsonTree& primitive : *list) {
            if (primitive.as<JsonTree::Object>() == nullptr)
                failAt(primitive.place, "a primitive is an object, {…}.");
            primitive.isUsed = true;
            readTungstenPrimitive(importer, primitive);
        }
    }
    // Both are lists of what is used by its name.
    static_cast<void>(root.find("bsdfs"));
    static_cast<void>(root.find("media"));
    tellUnused(importer, root, "");
    return scene;
}

}  // namespace kaustik::scene
