// SPDX-License-Identifier: MIT
#include "framework/reference/path_classes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik::reference {
namespace {

// Layers that a file of classes has next to them.
constexpr std::array kOwnLayers{kOtherClass, "error"};

}  // namespace

std::string layerName(const std::string& text) {
    std::string name = text;
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return c == '.' || c == ' ' || static_cast<unsigned char>(c) < 0x20; }, '_');
    return name;
}

PathClass pathClassOf(const std::string& text, const std::string& place) {
    const std::size_t mark = text.find('=');
    // An object's name may have a sign of its own.
    const bool isNamed = mark != std::string::npos && mark < text.find('@');
    const PathPattern pattern(isNamed ? text.substr(mark + 1) : text, place);
    const std::string whole =
        pattern.object().empty() ? pattern.text() : pattern.text() + "@" + pattern.object();
    if (!isNamed) return {layerName(whole), whole};
    const std::string name = text.substr(0, mark);
    const bool isRight = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
    if (!isRight) {
        throw ConfigError(fmt::format(
            "{}: '{}' is no name of a class; letters, digits, '_' and '-' make one.", place, name));
    }
    return {name, whole};
}

void requireClasses(const std::vector<PathClass>& classes, const scene::Scene& scene,
                    const std::string& place) {
    if (classes.size() > static_cast<std::size_t>(kMaximumClasses)) {
        throw ConfigError(
            fmt::format("{}: {} classes are more than the {} that a reference keeps "
                        "apart.",
                        place, classes.size(), kMaximumClasses));
    }
    std::set<std::string> names;
    for (const PathClass& one : classes) {
        if (std::find(kOwnLayers.begin(), kOwnLayers.end(), one.name) != kOwnLayers.end()) {
            throw ConfigError(fmt::format(
                "{}: a class cannot be called '{}', which the file has already.", place, one.name));
        }
        if (!names.insert(one.name).second) {
            throw ConfigError(
                fmt::format("{}: two classes are called '{}'; NAME=PATTERN gives one another name.",
                            place, one.name));
        }
        const std::string object = PathPattern(one.pattern, place).object();
        if (object.empty()) continue;
        std::vector<std::string> known;
        bool isThere = false;
        for (const scene::Object& candidate : scene.objects) {
            if (scene::isReceiver(scene.materials[candidate.material].kind)) continue;
            known.push_back(candidate.name);
            isThere = isThere || candidate.name == object;
        }
        if (isThere) continue;
        const std::string suggestion = didYouMean(object, known);
        throw ConfigError(fmt::format("{}: the scene has no specular object '{}'{}", place, object,
                                      suggestion.empty() ? "." : suggestion));
    }
}

PathClassifier::PathClassifier(const scene::Scene& scene, const std::vector<PathClass>& classes)
    : scene_(scene) {
    for (const PathClass& one : classes)
        patterns_.emplace_back(one.pattern, "class");
}

std::size_t PathClassifier::classOf(const ArrivedPath& path) {
    const std::uint64_t mixed =
        (path.word.reflections * 0x9e3779b97f4a7c15u) ^
        (static_cast<std::uint64_t>(path.interactions) * 0xbf58476d1ce4e5b9u) ^
        (static_cast<std::uint64_t>(path.firstObject) * 0x94d049bb133111ebu);
    Known& known = known_[(mixed >> 40) % known_.size()];
    if (!known.isThere || !(known.path == path)) known = {path, findClass(path), true};
    return known.place;
}

std::size_t PathClassifier::findClass(const ArrivedPath& path) const {
    if (path.interactions > kLongestPathWord) return patterns_.size();
    for (std::size_t i = 0; i < patterns_.size(); ++i) {
        const PathPattern& pattern = patterns_[i];
        if (!pattern.object().empty() && scene_.objects[path.firstObject].name != pattern.object())
            continue;
        if (pattern.matches(path.word)) return i;
    }
    return patterns_.size();
}

}  // namespace kaustik::reference
