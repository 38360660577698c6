// SPDX-License-Identifier: MIT
// The parts of a Mitsuba scene, each read by one function out of its element into a ForeignScene.
// Whatever such a function does not ask for is told as left out once all are done
// (mitsuba_scene.cpp).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "framework/importers/mitsuba_document.h"

namespace kaustik::scene {

struct MitsubaImport {
    const MitsubaDocument& document;
    ForeignScene& scene;
    ForeignNotes notes;
    // Materials that are made, by bsdf and the medium inside.
    std::map<std::tuple<const MitsubaElement*, const MitsubaElement*>, std::uint32_t> materials;
    std::map<std::string, int> unnamed;  // elements without an id, by type

    // The element's id, or its type and a number.
    [[nodiscard]] std::string nameOf(const MitsubaElement& element);
    // Tells it with all that is in it.
    void leaveOut(const MitsubaElement& element, const std::string& reason);
    void change(const MitsubaElement& element, const std::string& how);
};

// What a colour property of a surface may be: an even colour, times a picture, or two in a pattern.
[[nodiscard]] ForeignColor surfaceColor(MitsubaImport& importer, const MitsubaElement& parent,
                                        const char* name, const glm::dvec3& otherwise);
// The same where only an even colour will do; a texture becomes its mean, or white, with a note.
[[nodiscard]] glm::dvec3 evenColor(MitsubaImport& importer, const MitsubaElement& parent,
                                   const char* name, const glm::dvec3& otherwise);
// Of an element that is a colour without a texture; nothing for other elements.
[[nodiscard]] std::optional<glm::dvec3> constantColor(const MitsubaImport& importer,
                                                      const MitsubaElement& element);

// The index of a material, made at its first use; nothing where its surface is to be left out, for
// `whyNot`. `medium` is what is inside, or null.
[[nodiscard]] std::optional<std::uint32_t> materialOf(MitsubaImport& importer,
                                                      const MitsubaElement& bsdf,
                                                      const MitsubaElement* medium,
                                                      std::string& whyNot);
// The one of shapes that name none.
[[nodiscard]] std::uint32_t defaultMaterial(MitsubaImport& importer);

// Nothing for a medium that is not the same everywhere.
[[nodiscard]] std::optional<Medium> mediumOf(MitsubaImport& importer,
                                             const MitsubaElement& element);

void readMitsubaSensor(MitsubaImport& importer, const MitsubaElement& element);
void readMitsubaShape(MitsubaImport& importer, const MitsubaElement& element);
// One that stands in no shape.
void readMitsubaEmitter(MitsubaImport& importer, const MitsubaElement& element);

}  // namespace kaustik::scene
