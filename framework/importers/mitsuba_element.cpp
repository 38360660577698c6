// SPDX-License-Identifier: MIT
// What an element of a Mitsuba scene says: its attributes, and its children as properties.
#include <fmt/format.h>

#include "framework/importers/mitsuba_document.h"

namespace kaustik::scene {

const std::string& MitsubaElement::attribute(const char* name) const {
    static const std::string none;
    for (const auto& [key, value] : attributes) {
        if (key == name) return value;
    }
    return none;
}

bool MitsubaElement::has(const char* name) const {
    for (const auto& [key, value] : attributes) {
        if (key == name) return true;
    }
    return false;
}

const std::string& MitsubaElement::required(const char* name) const {
    if (!has(name)) failAt(place, fmt::format("<{}> needs a '{}'.", tag, name));
    return attribute(name);
}

std::string MitsubaElement::subject() const {
    for (const char* const key : {"id", "name", "type"}) {
        if (!attribute(key).empty()) return fmt::format("{} '{}'", tag, attribute(key));
    }
    return tag;
}

const MitsubaElement* MitsubaElement::child(const char* name) const {
    const MitsubaElement* found = nullptr;
    for (const MitsubaElement& element : children) {
        if (element.attribute("name") != name) continue;
        element.isUsed = true;
        found = &element;  // the last one counts
    }
    return found;
}

double MitsubaElement::number(const char* name, double otherwise) const {
    const MitsubaElement* const found = child(name);
    return found != nullptr ? parseOneNumber(found->required("value"), found->place) : otherwise;
}

bool MitsubaElement::flag(const char* name, bool otherwise) const {
    const MitsubaElement* const found = child(name);
    if (found == nullptr) return otherwise;
    const std::string& value = found->required("value");
    if (value != "true" && value != "false")
        failAt(found->place, fmt::format("'{}' is neither true nor false.", value));
    return value == "true";
}

std::string MitsubaElement::text(const char* name, const std::string& otherwise) const {
    const MitsubaElement* const found = child(name);
    return found != nullptr ? found->required("value") : otherwise;
}

}  // namespace kaustik::scene
