// SPDX-License-Identifier: MIT
// A Mitsuba scene file as a tree of elements: includes are in their place, `$name` is what its
// <default> says, and names are spelled as version 2 and 3 have them (to_world for toWorld). Each
// element knows its line, and whether anything has asked for it: what nothing has asked for at the
// end is what has no counterpart.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/importers/foreign_values.h"

namespace kaustik::scene {

struct MitsubaElement {
    std::string tag;  // in small letters
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<MitsubaElement> children;
    std::string place;  // file:line
    mutable bool isUsed = false;

    // "" where there is none.
    [[nodiscard]] const std::string& attribute(const char* name) const;
    [[nodiscard]] bool has(const char* name) const;
    // Fails where there is none.
    [[nodiscard]] const std::string& required(const char* name) const;
    [[nodiscard]] const std::string& type() const { return attribute("type"); }
    // "bsdf 'glass'", for notes.
    [[nodiscard]] std::string subject() const;
    // The child with this name, which counts as used; null where there is none.
    [[nodiscard]] const MitsubaElement* child(const char* name) const;

    // Properties, each with what it is where it is not given. All fail at the line of what is no
    // number, flag or transform.
    [[nodiscard]] double number(const char* name, double otherwise) const;
    [[nodiscard]] bool flag(const char* name, bool otherwise) const;
    [[nodiscard]] std::string text(const char* name, const std::string& otherwise = "") const;
    [[nodiscard]] glm::dvec3 point(const char* name, const glm::dvec3& otherwise) const;
    // In the order of its parts (mitsuba_transform.cpp).
    [[nodiscard]] glm::dmat4 transform(const char* name) const;
};

struct MitsubaDocument {
    MitsubaElement root;  // <scene>
    std::filesystem::path folder;
    std::map<std::string, const MitsubaElement*> ids;

    // What a <ref> means, which counts as used, and any other element itself. Fails where nothing
    // has the id.
    [[nodiscard]] const MitsubaElement& resolve(const MitsubaElement& element) const;
    // A file that an element names, which need not be there.
    [[nodiscard]] std::filesystem::path file(const std::string& name) const;
};

// Throws ConfigError "file:line: …" for what is no XML, has a DOCTYPE, an unknown entity or a name
// without a default, and for an include that leaves the folder of `file` or has no end; IoError for
// a file that cannot be read.
void readMitsubaDocument(const std::filesystem::path& file, MitsubaDocument& document);

}  // namespace kaustik::scene
