// SPDX-License-Identifier: MIT
#include "framework/experiment/spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <tuple>

#include "framework/core/error.h"
#include "framework/experiment/value_range.h"
#include "framework/scene/files/table_reader.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::TomlNode;
using scene::TomlTable;

TomlNode parse(const fs::path& file) {
    try {
        return scene::readToml(file);
    } catch (const ConfigError& error) {
        const std::string what = error.what();
        // TOML has no table and value of one name: trace = "lines" beside trace.epsilon.
        const bool isBoth = what.find("redefine") != std::string::npos;
        throw ConfigError(
            what + (isBoth ? " Write dotted names in quotes: \"trace.epsilon\" = 0.01." : ""));
    }
}

// Reads what the tables of an experiment hold, and knows where they are.
class Reader {
  public:
    explicit Reader(const fs::path& file) : file_(file) {}

    [[nodiscard]] std::vector<Setting> settings(const TomlNode& table) const {
        std::vector<Setting> settings;
        visit(table, "", true, [&](const std::string& key, const TomlNode& node) {
            settings.push_back({key, value(key, node), place(node)});
        });
        return settings;
    }

    [[nodiscard]] Product product(const TomlNode& table) const {
        Product product;
        visit(table, "", false, [&](const std::string& key, const TomlNode& node) {
            product.push_back({key, values(key, node), place(node)});
        });
        return product;
    }

  private:
    using Visitor = std::function<void(const std::string& key, const TomlNode& node)>;

    [[nodiscard]] std::string place(const TomlNode& node) const {
        return fmt::format("{}:{}", file_.string(), node.line);
    }

    [[noreturn]] void fail(const TomlNode& node, const std::string& message) const {
        throw ConfigError(fmt::format("{}: {}.", place(node), message));
    }

    // The leaves by dotted name, in the order of the file.
    void visit(const TomlNode& table, const std::string& prefix, bool entersInline,
               const Visitor& visitor) const {
        std::vector<std::pair<std::string, const TomlNode*>> entries;
        for (const auto& [key, node] : table.entries())
            entries.emplace_back(prefix + key, &node);
        std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
            return std::tie(a.second->line, a.second->column) <
                   std::tie(b.second->line, b.second->column);
        });
        for (const auto& [name, node] : entries) {
            const TomlTable* inner = node->as<TomlTable>();
            if (inner != nullptr && (entersInline || !inner->isInline)) {
                visit(*node, name + ".", entersInline, visitor);
            } else {
                visitor(name, *node);
            }
        }
    }

    [[nodiscard]] json value(const std::string& key, const TomlNode& node) const {
        if (const auto* text = node.as<std::string>()) return *text;
        if (const auto* integer = node.as<std::int64_t>()) return *integer;
        if (const auto* number = node.as<double>()) return *number;
        if (const auto* flag = node.as<bool>()) return *flag;
        const std::vector<TomlNode>* list = node.list();
        if (list == nullptr) {
            fail(node, fmt::format("{} must be text, a number, true or false", key));
        }
        json texts = json::array();
        for (const TomlNode& element : *list) {
            const auto* text = element.as<std::string>();
            if (text == nullptr) {
                fail(element, fmt::format("{} cannot be a list; only disable can, of texts", key));
            }
            texts.push_back(*text);
        }
        return texts;
    }

    [[nodiscard]] std::vector<Setting> values(const std::string& key, const TomlNode& node) const {
        std::vector<Setting> values;
        if (node.as<TomlTable>() != nullptr) {
            for (json& number : readRange(node, key, file_))
                values.push_back({key, std::move(number), place(node)});
            return values;
        }
        const std::vector<TomlNode>* list = node.list();
        if (list == nullptr) {
            fail(node, fmt::format("permute: {} must be a list of values or a range such as "
                                   "{{from = 1, to = 8, factor = 2}}",
                                   key));
        }
        if (list->empty()) {
            fail(node, fmt::format("permute: {} is an empty list; give it at least one value, or "
                                   "leave it out",
                                   key));
        }
        for (const TomlNode& element : *list)
            values.push_back({key, value(key, element), place(element)});
        return values;
    }

    fs::path file_;
};

void checkName(scene::TableReader& top, const std::string& name) {
    const bool isPlain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
    });
    if (!isPlain || name.empty()) {
        top.fail("name", fmt::format("name must be of letters, digits, '-' and '_', not '{}', "
                                     "since it names a folder",
                                     name));
    }
}

// A suite says itself what it renders.
void readSuite(scene::TableReader& top, Spec& spec) {
    spec.suite = top.choice<std::string>("suite", {{"numerics", "numerics"}});
    spec.cases = top.texts("cases");
    spec.casesPlace = top.place("cases");
    top.finish();
    checkName(top, spec.name);
}

}  // namespace

Spec readSpec(const fs::path& file) {
    const TomlNode document = parse(file);
    scene::TableReader top(document, file, "");
    Spec spec;
    spec.file = file;
    spec.name = top.text("name");
    spec.description = top.text("description", "");
    if (top.has("suite")) {
        readSuite(top, spec);
        return spec;
    }
    spec.repeats = static_cast<int>(top.count("repeats", 1, kMostRepeats, 1));
    static_cast<void>(top.table("base"));
    const TomlNode* permute = document.find("permute");
    const bool isList = permute != nullptr && permute->list() != nullptr;
    if (isList) {
        static_cast<void>(top.tables("permute"));
    } else {
        static_cast<void>(top.table("permute"));
    }
    top.finish();
    checkName(top, spec.name);

    const Reader reader(file);
    if (const TomlNode* base = document.find("base")) spec.base = reader.settings(*base);
    if (!isList) {
        spec.products.push_back(permute == nullptr ? Product{} : reader.product(*permute));
        return spec;
    }
    for (const TomlNode& table : *permute->list())
        spec.products.push_back(reader.product(table));
    if (spec.products.empty()) top.fail("permute", "permute is an empty list");
    return spec;
}

}  // namespace kaustik::experiment
