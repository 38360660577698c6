// SPDX-License-Identifier: MIT
// A Mitsuba scene as a whole: hands each element to what reads it, and tells at the end what
// nothing has asked for.
#include <fmt/format.h>

#include "framework/importers/foreign_file.h"
#include "framework/importers/mitsuba_parts.h"

namespace kaustik::scene {
namespace {

void markUsed(const MitsubaElement& element) {
    element.isUsed = true;
    for (const MitsubaElement& child : element.children)
        markUsed(child);
}

void tellUnused(MitsubaImport& importer, const MitsubaElement& parent) {
    for (const MitsubaElement& element : parent.children) {
        if (element.isUsed) {
            tellUnused(importer, element);
            continue;
        }
        const bool isNamed = !element.attribute("id").empty() && element.tag != "integrator";
        const std::string where =
            parent.tag == "scene" ? "" : fmt::format(" of {}", parent.subject());
        importer.notes.leftOut(element.subject() + where, element.place,
                               isNamed ? "nothing uses it" : "there is no counterpart");
    }
}

}  // namespace

std::string MitsubaImport::nameOf(const MitsubaElement& element) {
    if (!element.attribute("id").empty()) return element.attribute("id");
    const std::string type = element.type().empty() ? element.tag : element.type();
    return fmt::format("{}-{}", type, ++unnamed[type]);
}

void MitsubaImport::leaveOut(const MitsubaElement& element, const std::string& reason) {
    notes.leftOut(element.subject(), element.place, reason);
    markUsed(element);
}

void MitsubaImport::change(const MitsubaElement& element, const std::string& how) {
    notes.changed(element.subject(), element.place, how);
}

ForeignScene readMitsuba(const std::filesystem::path& file) {
    MitsubaDocument document;
    readMitsubaDocument(file, document);
    ForeignScene scene;
    scene.format = "Mitsuba";
    MitsubaImport importer{document, scene, ForeignNotes(scene.notes, document.folder), {}, {}};
    for (const MitsubaElement& child : document.root.children) {
        const MitsubaElement& element = child.tag == "ref" ? document.resolve(child) : child;
        if (element.tag == "sensor") {
            readMitsubaSensor(importer, element);
        } else if (element.tag == "shape") {
            readMitsubaShape(importer, element);
        } else if (element.tag == "emitter") {
            readMitsubaEmitter(importer, element);
        } else {
            continue;  // used by what refers to it
        }
        element.isUsed = true;
    }
    tellUnused(importer, document.root);
    return scene;
}

}  // namespace kaustik::scene
