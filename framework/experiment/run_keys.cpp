// SPDX-License-Identifier: MIT
#include "framework/experiment/run_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/experiment/setting.h"
#include "framework/params/assignment.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;

const RunKey* findRunKey(const std::string& name) {
    const auto found = std::find_if(runKeys().begin(), runKeys().end(),
                                    [&](const RunKey& key) { return key.name == name; });
    return found == runKeys().end() ? nullptr : &*found;
}

[[noreturn]] void refuse(const Setting& setting, const std::string& expected) {
    failAt(setting,
           fmt::format("{} must be {}, not {}.", setting.key, expected, setting.value.dump()));
}

std::vector<std::string> sortedTexts(const Setting& setting) {
    if (setting.value.is_string()) return {setting.value.get<std::string>()};
    if (!setting.value.is_array()) refuse(setting, "a list of texts");
    auto texts = setting.value.get<std::vector<std::string>>();
    std::sort(texts.begin(), texts.end());
    texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
    return texts;
}

std::string sizeText(const Setting& setting) {
    const params::Extent size = params::parsePictureSize(textOf(setting), setting.place);
    return fmt::format("{}x{}", size.width, size.height);
}

}  // namespace

const std::vector<RunKey>& runKeys() {
    using Type = RunKey::Type;
    static const std::vector<RunKey> keys = {
        {"scene", "A name of 'kaustik list scenes', or a file beside the experiment", "",
         Type::text},
        {"technique", "A name of 'kaustik list techniques'", "", Type::text},
        {"as_published", "Takes the technique as its paper has it to the letter", "", Type::flag},
        {"size", "Picture size", "px", Type::size},
        {"frames", "Frames that are timed", "", Type::whole, 1, 1000000},
        {"warmup", "Frames before them", "", Type::whole, 0, 1000000},
        {"seed", "Seed of everything random", "", Type::whole, INT64_MIN, INT64_MAX},
        {"precise", "Times each pass with the device finished around it", "", Type::flag},
        {"ledger", "Whether frames that are timed sum up the energy ledger", "", Type::flag},
        {"time", "Time of the animation", "s", Type::number},
        {"time_step", "Time from frame to frame", "s", Type::number},
        {"reference", "none, auto, or a file beside the experiment", "", Type::text},
        {"reference_photons", "Photons that the reference of auto has at least", "", Type::whole, 1,
         kMaxReferencePhotons},
        {"disable", "Passes that are not to run", "", Type::texts}};
    return keys;
}

json schemaOf(const RunKey& key) {
    json text = {{"type", "string"}};
    json schema;
    switch (key.type) {
        case RunKey::Type::text:
            schema = text;
            break;
        case RunKey::Type::size:
            schema = {{"type", "string"}, {"pattern", "^[0-9]+x[0-9]+$"}};
            break;
        case RunKey::Type::whole:
            schema = {{"type", "integer"}, {"minimum", key.minimum}, {"maximum", key.maximum}};
            break;
        case RunKey::Type::number:
            schema = {{"type", "number"}};
            break;
        case RunKey::Type::flag:
            schema = {{"type", "boolean"}};
            break;
        case RunKey::Type::texts:
            text["minLength"] = 1;
            schema = {{"anyOf", {text, {{"type", "array"}, {"items", text}}}}};
            break;
    }
    schema["description"] =
        fmt::format("{}{}{}", key.sentence, *key.unit == '\0' ? "" : ", ", key.unit);
    return schema;
}

bool isRunKey(const std::string& key) {
    return findRunKey(key) != nullptr;
}

json runValue(const Setting& setting) {
    const RunKey& key = *findRunKey(setting.key);
    const json& value = setting.value;
    switch (key.type) {
        case RunKey::Type::text:
            if (!value.is_string()) refuse(setting, "text");
            return value;
        case RunKey::Type::size:
            return sizeText(setting);
        case RunKey::Type::whole: {
            const bool isWhole = value.is_number_integer();
            const long long number = isWhole ? value.get<long long>() : 0;
            if (!isWhole || number < key.minimum || number > key.maximum) {
                refuse(setting,
                       fmt::format("a whole number from {} to {}", key.minimum, key.maximum));
            }
            return value;
        }
        case RunKey::Type::number:
            if (!value.is_number() || !std::isfinite(value.get<double>()))
                refuse(setting, "a number of seconds");
            return value.get<double>();
        case RunKey::Type::texts:
            return sortedTexts(setting);
        case RunKey::Type::flag:
            if (!value.is_boolean()) failAt(setting, setting.key + " must be true or false.");
            return value;
    }
    return value;
}

}  // namespace kaustik::experiment
