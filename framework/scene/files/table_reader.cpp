// SPDX-License-Identifier: MIT
#include "framework/scene/files/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/core/number_text.h"

namespace kaustik::scene {
namespace {

// What a wrong value looks like in a message: short, whatever it is.
std::string shown(const TomlNode& node) {
    if (const auto* text = node.as<std::string>()) return fmt::format("'{}'", text->substr(0, 40));
    if (const auto* integer = node.as<std::int64_t>()) return fmt::format("{}", *integer);
    if (const auto* number = node.as<double>()) return fmt::format("{}", *number);
    if (const auto* flag = node.as<bool>()) return *flag ? "true" : "false";
    if (const auto* list = node.list()) return fmt::format("a list of {}", list->size());
    return node.as<TomlTable>() ? "a table" : "a date or time";
}

std::string sentence(const std::string& text) {
    return text.ends_with('?') || text.ends_with('.') ? text : text + ".";
}

}  // namespace

bool NumberRange::contains(double value) const {
    return (withoutMinimum ? value > minimum : value >= minimum) &&
           (withoutMaximum ? value < maximum : value <= maximum);
}

std::string NumberRange::description() const {
    return fmt::format("{} {} and {} {}", withoutMinimum ? "greater than" : "at least",
                       numberText(minimum), withoutMaximum ? "less than" : "at most",
                       numberText(maximum));
}

TableReader::TableReader(const TomlNode& table, std::filesystem::path file, std::string subject)
    : table_(&table), file_(std::move(file)), subject_(std::move(subject)) {}

void TableReader::note(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
}

const TomlNode* TableReader::find(std::string_view key, bool isRequired) {
    note(key);
    const TomlNode* node = table_->find(key);
    if (node == nullptr && isRequired) missing_.emplace_back(key);
    return node;
}

double TableReader::checkedNumber(std::string_view key, const TomlNode& node,
                                  const NumberRange& range) const {
    if (!node.isNumber()) fail(key, fmt::format("{} must be a number, not {}", key, shown(node)));
    const auto* const integer = node.as<std::int64_t>();
    const double value = integer != nullptr ? static_cast<double>(*integer) : *node.as<double>();
    if (!std::isfinite(value) || !range.contains(value)) {
        fail(key, fmt::format("{} must be {}, not {}", key, range.description(), shown(node)));
    }
    return value;
}

std::vector<double> TableReader::numbers(std::string_view key, const TomlNode& node,
                                         std::size_t size, bool isUniform,
                                         const NumberRange& range) const {
    if (isUniform && node.isNumber()) return std::vector(size, checkedNumber(key, node, range));
    const std::vector<TomlNode>* array = node.list();
    if (array == nullptr || array->size() != size) {
        fail(key, fmt::format("{} must be {}a list of {} numbers, not {}", key,
                              isUniform ? "a number or " : "", size, shown(node)));
    }
    std::vector<double> values;
    for (const TomlNode& element : *array)
        values.push_back(checkedNumber(key, element, range));
    return values;
}

unsigned TableReader::checkedCount(std::string_view key, const TomlNode& node, unsigned minimum,
                                   unsigned maximum) const {
    const auto* const integer = node.as<std::int64_t>();
    if (integer == nullptr || *integer < minimum || *integer > maximum) {
        fail(key, fmt::format("{} must be a whole number from {} to {}, not {}", key, minimum,
                              maximum, shown(node)));
    }
    return static_cast<unsigned>(*integer);
}

const std::string& TableReader::checkedText(std::string_view key, const TomlNode& node) const {
    const auto* const value = node.as<std::string>();
    if (value == nullptr) fail(key, fmt::format("{} must be text, not {}", key, shown(node)));
    return *value;
}

std::size_t TableReader::indexOf(std::string_view key, const char* intro, const std::string& value,
                                 const std::vector<std::string>& names) const {
    const auto found = std::find(names.begin(), names.end(), value);
    if (found == names.end()) fail(key, std::string(key) + intro + notOneOf(value, names));
    return static_cast<std::size_t>(found - names.begin());
}

void TableReader::counts(glm::uvec2& value, const Key& key, unsigned minimum, unsigned maximum,
                         Presence presence) {
    const TomlNode* node = find<glm::uvec2>(key, presence);
    if (node == nullptr) return;
    const std::vector<TomlNode>* array = node->list();
    if (array != nullptr && array->size() != 2) {
        fail(key.name,
             fmt::format("{} must be one or two whole numbers, not {}", key.name, shown(*node)));
    }
    const auto checked = [&](const TomlNode& count) {
        return checkedCount(key.name, count, minimum, maximum);
    };
    value = array == nullptr ? glm::uvec2(checked(*node))
                             : glm::uvec2(checked(array->front()), checked(array->back()));
}

glm::dvec3 unitDirection(const glm::dvec3& vector) {
    return glm::normalize(vector /
                          std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}));
}

void TableReader::requireDirection(std::string_view key) const {
    for (const TomlNode& element : *table_->find(key)->list()) {
        const auto* const integer = element.as<std::int64_t>();
        if (integer != nullptr ? *integer != 0 : *element.as<double>() != 0.0) return;
    }
    fail(key, fmt::format("{} must not be the zero vector", key));
}

void TableReader::flag(bool& value, const Key& key) {
    const TomlNode* node = find(key.name, false);
    if (node == nullptr) return;
    const bool* const written = node->as<bool>();
    if (written == nullptr) {
        fail(key.name, fmt::format("{} must be true or false, not {}", key.name, shown(*node)));
    }
    value = *written;
}

void TableReader::folderName(std::string& value, const Key& key) {
    text(value, key);
    const bool isPlain = std::all_of(value.begin(), value.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
    });
    if (has(key.name) && (!isPlain || value.empty())) {
        fail(key.name, fmt::format("{} must be of letters, digits, '-' and '_', not '{}', since it "
                                   "names a folder",
                                   key.name, value));
    }
}

void TableReader::texts(std::vector<std::string>& values, const Key& key) {
    const TomlNode* node = find(key.name, false);
    if (node == nullptr) return;
    const std::vector<TomlNode>* array = node->list();
    if (array == nullptr) {
        fail(key.name, fmt::format("{} must be a list of texts, not {}", key.name, shown(*node)));
    }
    for (const TomlNode& element : *array) {
        const auto* const value = element.as<std::string>();
        if (value == nullptr) {
            fail(key.name,
                 fmt::format("{} must hold texts only, not {}", key.name, shown(element)));
        }
        values.push_back(*value);
    }
}

void TableReader::name(std::string& value) {
    text(value, {"name", ""});
    if (has("name") && value.empty()) fail("name", "name must not be empty");
    if (!value.empty()) subject_ = fmt::format("{} '{}'", subject_, value);
}

void TableReader::rule(const KeyRule& rule) {
    for (const char* key : rule.keys)
        note(key);
    if (countOf(rule) > 1) fail(rule.place, rule.sentence);
    rules_.push_back(rule);
}

std::ptrdiff_t TableReader::countOf(const KeyRule& rule) const {
    return std::count_if(rule.keys.begin(), rule.keys.end(),
                         [&](const char* key) { return table_->find(key) != nullptr; });
}

TableReader TableReader::inner(const TomlNode& node, std::string_view key) const {
    return {node, file_,
            subject_.empty() ? std::string(key) : fmt::format("{}: {}", subject_, key)};
}

std::optional<TableReader> TableReader::table(std::string_view key) {
    const TomlNode* node = find(key, false);
    if (node == nullptr) return std::nullopt;
    if (node->as<TomlTable>() == nullptr) {
        fail(key, fmt::format("{0} must be one table, [{0}], not {1}", key, shown(*node)));
    }
    return inner(*node, key);
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
    const TomlNode* node = find(key, false);
    if (node == nullptr) return {};
    const std::vector<TomlNode>* array = node->list();
    const bool right =
        array != nullptr && std::all_of(array->begin(), array->end(), [](const TomlNode& element) {
            return element.as<TomlTable>() != nullptr;
        });
    if (!right) {
        fail(key, fmt::format("{0} must be a list of tables, [[{0}]], not {1}", key, shown(*node)));
    }
    std::vector<TableReader> readers;
    for (const TomlNode& element : *array)
        readers.push_back(inner(element, key));
    return readers;
}

void TableReader::foreignTable(const Key& key, const char*, Tables count) {
    const TomlNode* node = table_->find(key.name);
    if (count == Tables::oneOrSeveral && node != nullptr && node->list() != nullptr) {
        static_cast<void>(tables(key.name));
        if (node->list()->empty()) fail(key.name, fmt::format("{} is an empty list", key.name));
    } else {
        static_cast<void>(table(key.name));
    }
}

bool TableReader::has(std::string_view key) {
    return find(key, false) != nullptr;
}

void TableReader::finish() const {
    for (const auto& [name, node] : table_->entries()) {
        if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        const std::string suggestion = didYouMean(name, known_);
        fail(name,
             fmt::format("'{}' is not a key{}", name,
                         suggestion.empty() ? "; the keys are " + joinNames(known_) : suggestion));
    }
    if (!missing_.empty()) failMissing(missing_.front());
    for (const KeyRule& rule : rules_) {
        if (!rule.needsOne || countOf(rule) == 1) continue;
        if (*rule.missing != '\0') failMissing(rule.missing);
        fail(rule.place, rule.sentence);
    }
}

void TableReader::failMissing(std::string_view key) const {
    for (const auto& [other, node] : table_->entries()) {
        const bool unknown = std::find(known_.begin(), known_.end(), other) == known_.end();
        if (unknown && !nearestName(other, {std::string(key)}).empty()) {
            fail(other, fmt::format("'{}' is not a key; did you mean '{}'?", other, key));
        }
    }
    fail(key, fmt::format("'{}' is missing", key));
}

std::string TableReader::place(std::string_view key) const {
    if (!file_.has_filename()) return "the scene";
    const TomlNode* node = key.empty() ? nullptr : table_->find(key);
    return fmt::format("{}:{}", file_.string(), std::max(1u, (node ? node : table_)->line));
}

void TableReader::fail(std::string_view key, const std::string& message) const {
    throw ConfigError(sentence(
        fmt::format("{}: {}{}{}", place(key), subject_, subject_.empty() ? "" : ": ", message)));
}

std::string TableReader::notOneOf(std::string_view value, const std::vector<std::string>& names) {
    return fmt::format("'{}' is not one of {}{}", value, joinNames(names),
                       didYouMean(value, names));
}

}  // namespace kaustik::scene
