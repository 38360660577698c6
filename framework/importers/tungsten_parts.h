// SPDX-License-Identifier: MIT
// The parts of a Tungsten scene, each read by one function out of its JSON into a ForeignScene.
// Whatever such a function does not ask for is told as left out once all are done
// (tungsten_scene.cpp).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "framework/importers/foreign_values.h"
#include "framework/importers/json_tree.h"

namespace kaustik::scene {

struct TungstenImport {
    const JsonTree& root;
    std::filesystem::path folder;
    ForeignScene& scene;
    ForeignNotes notes;
    std::map<std::tuple<const JsonTree*, const JsonTree*>, std::uint32_t> materials;
    std::map<std::string, int> unnamed;  // by type

    // "primitive 'lamp'"; of one without a name its type.
    [[nodiscard]] std::string subject(const char* kind, const JsonTree& node) const;
    // The node's name, or its type and a number.
    [[nodiscard]] std::string nameOf(const JsonTree& node);
    void leaveOut(const char* kind, const JsonTree& node, const std::string& reason);
    void change(const char* kind, const JsonTree& node, const std::string& how);
};

// Values of keys, each with what it is where the key is absent. All fail at the line of what is of
// another type.
[[nodiscard]] double jsonNumber(const JsonTree& node, const char* key, double otherwise);
[[nodiscard]] bool jsonFlag(const JsonTree& node, const char* key, bool otherwise);
[[nodiscard]] std::string jsonText(const JsonTree& node, const char* key,
                                   const std::string& otherwise = "");
[[nodiscard]] glm::dvec3 jsonVector(const JsonTree& node, const char* key,
                                    const glm::dvec3& otherwise);
// By position, scale and rotation, by look_at and up, or as 16 numbers row by row.
[[nodiscard]] glm::dmat4 jsonTransform(const JsonTree& node);

// An even colour, times a picture, or two in a pattern.
[[nodiscard]] ForeignColor surfaceColor(TungstenImport& importer, const JsonTree& node,
                                        const char* key, const glm::dvec3& otherwise);
// The same where only an even colour will do.
[[nodiscard]] glm::dvec3 evenColor(TungstenImport& importer, const JsonTree& node, const char* key,
                                   const glm::dvec3& otherwise);

// The index of the material of a primitive, made at its first use; nothing where its surface is to
// be left out, for `whyNot`.
[[nodiscard]] std::optional<std::uint32_t> materialOf(TungstenImport& importer,
                                                      const JsonTree& primitive,
                                                      std::string& whyNot);
// The medium that a key names; null where there is no such key.
[[nodiscard]] const JsonTree* mediumNode(const TungstenImport& importer, const JsonTree& node,
                                         const char* key);
[[nodiscard]] std::optional<Medium> mediumOf(TungstenImport& importer, const JsonTree& node);
// The one of a list with a name; fails where there is none.
[[nodiscard]] const JsonTree& namedNode(const JsonTree& root, const char* list,
                                        const JsonTree& name);

void readTungstenPrimitive(TungstenImport& importer, const JsonTree& primitive);
void readTungstenCamera(TungstenImport& importer, const JsonTree& camera);

}  // namespace kaustik::scene
