// SPDX-License-Identifier: MIT
// One row a field: what the glTF 2.0 specification and its KHR extensions allow there.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/importers/gltf_document.h"

namespace kaustik::scene {
namespace {

using Json = nlohmann::json;

constexpr double kAny = std::numeric_limits<double>::max();
constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();
constexpr double kMaximumCount = 4294967295.0;
constexpr double kRightAngle = 1.5708;  // pi/2, also as exporters round it

enum class Kind { index, integer, number, numbers, text };
enum class Presence { optional, required };

struct Rule {
    const char* field;  // "[]": every entry of a list; "*": every member of an object
    Kind kind;
    const char* expected;  // ends "it must be ..."; for an index: the list that it points into
    double minimum = 0.0;
    double maximum = kAny;
    std::size_t count = 0;  // of numbers
    Presence presence = Presence::optional;
};

constexpr Presence kRequired = Presence::required;
constexpr const char* kUnitRange = "a number from 0 to 1";
constexpr const char* kUnitColor = "three numbers from 0 to 1";
constexpr const char* kLights = "extensions.KHR_lights_punctual.lights";

constexpr std::array kRules{
    Rule{"scene", Kind::index, "scenes"},
    Rule{"scenes[].nodes[]", Kind::index, "nodes"},
    Rule{"nodes[].children[]", Kind::index, "nodes"},
    Rule{"nodes[].mesh", Kind::index, "meshes"},
    Rule{"nodes[].camera", Kind::index, "cameras"},
    Rule{"nodes[].extensions.KHR_lights_punctual.light", Kind::index, kLights},
    Rule{"nodes[].matrix", Kind::numbers, "16 numbers", -kAny, kAny, 16},
    Rule{"nodes[].translation", Kind::numbers, "three numbers", -kAny, kAny, 3},
    Rule{"nodes[].rotation", Kind::numbers, "four numbers from -1 to 1", -1.001, 1.001, 4},
    Rule{"nodes[].scale", Kind::numbers, "three numbers", -kAny, kAny, 3},

    Rule{"meshes[].primitives[].attributes.*", Kind::index, "accessors"},
    Rule{"meshes[].primitives[].indices", Kind::index, "accessors"},
    Rule{"meshes[].primitives[].material", Kind::index, "materials"},
    Rule{"meshes[].primitives[].mode", Kind::integer, "an integer from 0 to 6", 0, 6},

    Rule{"accessors[].bufferView", Kind::index, "bufferViews"},
    Rule{"accessors[].byteOffset", Kind::integer, "a number of bytes", 0, kMaximumCount},
    Rule{"accessors[].count", Kind::integer, "a positive integer below 2^32", 1, kMaximumCount, 0,
         kRequired},
    Rule{"accessors[].componentType", Kind::integer, "5120 to 5126", 5120, 5126, 0, kRequired},
    Rule{"accessors[].type", Kind::text, "a text such as \"VEC3\"", 0, 0, 0, kRequired},
    Rule{"bufferViews[].buffer", Kind::index, "buffers", 0, 0, 0, kRequired},
    Rule{"bufferViews[].byteOffset", Kind::integer, "a number of bytes", 0, kMaximumCount},
    Rule{"bufferViews[].byteLength", Kind::integer, "a positive number of bytes", 1, kMaximumCount,
         0, kRequired},
    Rule{"bufferViews[].byteStride", Kind::integer, "an integer from 4 to 252", 4, 252},
    Rule{"buffers[].byteLength", Kind::integer, "a positive number of bytes", 1, kMaximumCount, 0,
         kRequired},
    Rule{"buffers[].uri", Kind::text, "a text"},

    Rule{"images[].uri", Kind::text, "a text"},
    Rule{"images[].bufferView", Kind::index, "bufferViews"},
    Rule{"textures[].source", Kind::index, "images"},

    Rule{"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers,
         "four numbers from 0 to 1", 0, 1, 4},
    Rule{"materials[].pbrMetallicRoughness.metallicFactor", Kind::number, kUnitRange, 0, 1},
    Rule{"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number, kUnitRange, 0, 1},
    Rule{"materials[].pbrMetallicRoughness.baseColorTexture.index", Kind::index, "textures", 0, 0,
         0, kRequired},
    Rule{"materials[].pbrMetallicRoughness.baseColorTexture.texCoord", Kind::integer,
         "an integer from 0 to 7", 0, 7},
    Rule{"materials[].emissiveFactor", Kind::numbers, kUnitColor, 0, 1, 3},
    Rule{"materials[].alphaMode", Kind::text, "a text such as \"OPAQUE\""},
    Rule{"materials[].extensions.KHR_materials_transmission.transmissionFactor", Kind::number,
         kUnitRange, 0, 1},
    Rule{"materials[].extensions.KHR_materials_ior.ior", Kind::number,
         "an index of refraction of at least 1 (0, which the extension gives a special meaning, "
         "cannot be rendered here)",
         1, kAny},
    Rule{"materials[].extensions.KHR_materials_dispersion.dispersion", Kind::number,
         "a number of at least 0", 0, kAny},
    Rule{"materials[].extensions.KHR_materials_volume.thicknessFactor", Kind::number,
         "a number of at least 0", 0, kAny},
    Rule{"materials[].extensions.KHR_materials_volume.attenuationDistance", Kind::number,
         "a number above 0", kAboveZero, kAny},
    Rule{"materials[].extensions.KHR_materials_volume.attenuationColor", Kind::numbers, kUnitColor,
         0, 1, 3},

    Rule{"extensions.KHR_lights_punctual.lights[].type", Kind::text,
         "\"directional\", \"point\" or \"spot\"", 0, 0, 0, kRequired},
    Rule{"extensions.KHR_lights_punctual.lights[].color", Kind::numbers,
         "three numbers of at least 0", 0, kAny, 3},
    Rule{"extensions.KHR_lights_punctual.lights[].intensity", Kind::number,
         "a number of at least 0", 0, kAny},
    Rule{"extensions.KHR_lights_punctual.lights[].range", Kind::number, "a number above 0",
         kAboveZero, kAny},
    Rule{"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number,
         "an angle from 0 to pi/2", 0, kRightAngle},
    Rule{"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number,
         "an angle above 0 and up to pi/2", kAboveZero, kRightAngle},

    Rule{"cameras[].type", Kind::text, "\"perspective\" or \"orthographic\"", 0, 0, 0, kRequired},
    Rule{"cameras[].perspective.yfov", Kind::number, "an angle above 0 and below pi", kAboveZero,
         3.14159, 0, kRequired},
    Rule{"cameras[].perspective.znear", Kind::number, "a number above 0", kAboveZero, kAny, 0,
         kRequired},

    Rule{"extensionsUsed[]", Kind::text, "the name of an extension"},
    Rule{"extensionsRequired[]", Kind::text, "the name of an extension"},
};

class Checker {
  public:
    Checker(const Json& document, const std::string& name) : document_(document), name_(name) {}

    void run() {
        if (!document_.is_object()) damaged("the JSON", "is no object");
        checkVersion();
        // Objects first, so that every later step may look up members without a further check.
        for (const char* list : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers",
                                 "images", "textures", "materials", "cameras"}) {
            checkListOfObjects(document_, list, list);
        }
        if (document_.contains("meshes")) checkPrimitives();
        for (const Rule& rule : kRules)
            check(rule, document_, rule.field, "");
        checkExtensions();
        checkBufferViews();
    }

  private:
    [[noreturn]] void damaged(const std::string& path, const std::string& problem) const {
        throw IoError(fmt::format("{}: {} {}. Export the file again.", name_, path, problem));
    }

    static std::string shown(const Json& value) {
        const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
        return text.size() <= 60 ? text : text.substr(0, 57) + "...";
    }

    void checkVersion() const {
        const auto asset = document_.find("asset");
        if (asset == document_.end() || !asset->is_object() || !asset->contains("version")) {
            damaged("asset.version", "is missing, so that this is no glTF file");
        }
        const Json& version = asset->at("version");
        if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2.")) {
            throw ConfigError(fmt::format("{}: asset.version is {}; only glTF 2.0 can be read.",
                                          name_, shown(version)));
        }
    }

    void checkListOfObjects(const Json& parent, const char* member, const std::string& path) const {
        const auto list = parent.find(member);
        if (list == parent.end()) return;
        if (!list->is_array()) damaged(path, "is no list");
        for (std::size_t i = 0; i < list->size(); ++i) {
            if (!(*list)[i].is_object()) damaged(fmt::format("{}[{}]", path, i), "is no object");
        }
    }

    void checkPrimitives() const {
        const Json& meshes = document_["meshes"];
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const std::string path = fmt::format("meshes[{}].primitives", i);
            if (!meshes[i].contains("primitives")) damaged(path, "is missing");
            checkListOfObjects(meshes[i], "primitives", path);
            const Json& primitives = meshes[i]["primitives"];
            for (std::size_t j = 0; j < primitives.size(); ++j) {
                if (!primitives[j].contains("attributes")) {
                    damaged(fmt::format("{}[{}].attributes", path, j), "is missing");
                }
            }
        }
    }

    // Follows `field` (what is left of the rule's) from `value`, which is at `path`.
    void check(const Rule& rule, const Json& value, std::string_view field,
               const std::string& path) const {
        if (field.empty()) return checkValue(rule, value, path);
        if (field.starts_with("[]")) {
            if (!value.is_array()) damaged(path, "is no list");
            field.remove_prefix(field.size() > 2 && field[2] == '.' ? 3 : 2);
            for (std::size_t i = 0; i < value.size(); ++i) {
                check(rule, value[i], field, fmt::format("{}[{}]", path, i));
            }
            return;
        }
        if (!value.is_object()) damaged(path, "is no object");
        const std::size_t end = std::min(field.find_first_of(".["), field.size());
        const std::string member(field.substr(0, end));
        field.remove_prefix(end < field.size() && field[end] == '.' ? end + 1 : end);
        const std::string prefix = path.empty() ? "" : path + ".";
        if (member == "*") {
            for (const auto& [key, entry] : value.items())
                check(rule, entry, field, prefix + key);
            return;
        }
        const auto found = value.find(member);
        if (found != value.end()) return check(rule, *found, field, prefix + member);
        if (field.empty() && rule.presence == Presence::required) {
            damaged(prefix + member, "is missing");
        }
    }

    void checkValue(const Rule& rule, const Json& value, const std::string& path) const {
        bool valid = false;
        switch (rule.kind) {
            case Kind::index:
                return checkIndex(rule, value, path);
            case Kind::integer:
                valid = value.is_number_unsigned() && inRange(rule, value);
                break;
            case Kind::number:
                valid = value.is_number() && inRange(rule, value);
                break;
            case Kind::numbers:
                valid = value.is_array() && value.size() == rule.count;
                for (std::size_t i = 0; valid && i < value.size(); ++i) {
                    valid = value[i].is_number() && inRange(rule, value[i]);
                }
                break;
            case Kind::text:
                valid = value.is_string();
                break;
        }
        if (valid) return;
        throw ConfigError(
            fmt::format("{}: {} is {}; it must be {}.", name_, path, shown(value), rule.expected));
    }

    static bool inRange(const Rule& rule, const Json& value) {
        const auto number = value.get<double>();
        return number >= rule.minimum && number <= rule.maximum;
    }

    void checkIndex(const Rule& rule, const Json& value, const std::string& path) const {
        const Json* list = &document_;
        std::string_view rest = rule.expected;
        while (!rest.empty() && list != nullptr) {
            const std::size_t end = std::min(rest.find('.'), rest.size());
            const auto found = list->find(std::string(rest.substr(0, end)));
            list = found != list->end() ? &*found : nullptr;
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        const std::size_t size = list != nullptr ? list->size() : 0;
        if (value.is_number_unsigned() && value.get<std::uint64_t>() < size) return;
        damaged(path,
                fmt::format("is {}, but {} has {} entries", shown(value), rule.expected, size));
    }

    void checkExtensions() const {
        const std::vector<std::string> known{"KHR_lights_punctual", "KHR_materials_transmission",
                                             "KHR_materials_ior", "KHR_materials_volume",
                                             "KHR_materials_dispersion"};
        for (const auto& required : document_.value("extensionsRequired", Json::array())) {
            const std::string extension = required;
            if (std::find(known.begin(), known.end(), extension) != known.end()) continue;
            // What only looks different without it is told (warnAboutExtensions), not refused.
            if (extension.starts_with("KHR_materials_") || extension == "KHR_texture_transform")
                continue;
            throw ConfigError(fmt::format(
                "{}: extensionsRequired has {}, which cannot be read; {} can. Export the file "
                "without it.",
                name_, extension, joinNames(known)));
        }
    }

    void checkBufferViews() const {
        const Json views = document_.value("bufferViews", Json::array());
        for (std::size_t i = 0; i < views.size(); ++i) {
            const auto buffer = views[i]["buffer"].get<std::size_t>();
            const auto offset = views[i].value("byteOffset", std::uint64_t{0});
            const auto length = views[i]["byteLength"].get<std::uint64_t>();
            const auto available = document_["buffers"][buffer]["byteLength"].get<std::uint64_t>();
            // All are below 2^32, so that the sum cannot overflow.
            if (offset + length <= available) continue;
            damaged(fmt::format("bufferViews[{}]", i),
                    fmt::format("ends at byte {}, but buffers[{}] has only {}", offset + length,
                                buffer, available));
        }
    }

    const Json& document_;
    const std::string& name_;
};

}  // namespace

void checkGltfJson(const Json& document, const std::string& name) {
    Checker(document, name).run();
}

}  // namespace kaustik::scene
