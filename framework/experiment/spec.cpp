// SPDX-License-Identifier: MIT
#include "framework/experiment/spec.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <tuple>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/experiment/value_range.h"
#include "framework/scene/table_reader.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

toml::table parse(const fs::path& file) {
    const std::string text = readFile(file);
    try {
        return toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        const std::string what(error.description());
        // TOML has no table and value of one name: trace = "lines" beside trace.epsilon.
        const bool isBoth = what.find("redefine") != std::string::npos;
        throw ConfigError(
            fmt::format("{}:{}: This is not valid TOML: {}.{}", file.string(),
                        unsigned(error.source().begin.line), what,
                        isBoth ? " Write dotted names in quotes: \"trace.epsilon\" = 0.01." : ""));
    }
}

// Reads what the tables of an experiment hold, and knows where they are.
class Reader {
  public:
    explicit Reader(const fs::path& file) : file_(file) {}

    [[nodiscard]] std::vector<Setting> settings(const toml::table& table) const {
        std::vector<Setting> settings;
        visit(table, "", true, [&](const std::string& key, const toml::node& node) {
            settings.push_back({key, value(key, node), place(node)});
        });
        return settings;
    }

    [[nodiscard]] Product product(const toml::table& table) const {
        Product product;
        visit(table, "", false, [&](const std::string& key, const toml::node& node) {
            product.push_back({key, values(key, node), place(node)});
        });
        return product;
    }

  private:
    using Visitor = std::function<void(const std::string& key, const toml::node& node)>;

    [[nodiscard]] std::string place(const toml::node& node) const {
        return fmt::format("{}:{}", file_.string(), unsigned(node.source().begin.line));
    }

    [[noreturn]] void fail(const toml::node& node, const std::string& message) const {
        throw ConfigError(fmt::format("{}: {}.", place(node), message));
    }

    // The leaves by dotted name, in the order of the file.
    void visit(const toml::table& table, const std::string& prefix, bool entersInline,
               const Visitor& visitor) const {
        std::vector<std::pair<std::string, const toml::node*>> entries;
        for (const auto& [key, node] : table)
            entries.emplace_back(prefix + std::string(key.str()), &node);
        std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
            const toml::source_position& left = a.second->source().begin;
            const toml::source_position& right = b.second->source().begin;
            return std::tie(left.line, left.column) < std::tie(right.line, right.column);
        });
        for (const auto& [name, node] : entries) {
            const toml::table* inner = node->as_table();
            if (inner != nullptr && (entersInline || !inner->is_inline())) {
                visit(*inner, name + ".", entersInline, visitor);
            } else {
                visitor(name, *node);
            }
        }
    }

    [[nodiscard]] json value(const std::string& key, const toml::node& node) const {
        if (const auto* text = node.as_string()) return text->get();
        if (const auto* integer = node.as_integer()) return integer->get();
        if (const auto* number = node.as_floating_point()) return number->get();
        if (const auto* flag = node.as_boolean()) return flag->get();
        const toml::array* list = node.as_array();
        if (list == nullptr) {
            fail(node, fmt::format("{} must be text, a number, true or false", key));
        }
        json texts = json::array();
        for (const toml::node& element : *list) {
            if (!element.is_string()) {
                fail(element, fmt::format("{} cannot be a list; only disable can, of texts", key));
            }
            texts.push_back(element.as_string()->get());
        }
        return texts;
    }

    [[nodiscard]] std::vector<Setting> values(const std::string& key,
                                              const toml::node& node) const {
        std::vector<Setting> values;
        if (const toml::table* range = node.as_table()) {
            for (json& number : readRange(*range, key, file_))
                values.push_back({key, std::move(number), place(node)});
            return values;
        }
        const toml::array* list = node.as_array();
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
        for (const toml::node& element : *list)
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
    const toml::table document = parse(file);
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
    const toml::node* permute = document.get("permute");
    const bool isList = permute != nullptr && permute->is_array();
    if (isList) {
        static_cast<void>(top.tables("permute"));
    } else {
        static_cast<void>(top.table("permute"));
    }
    top.finish();
    checkName(top, spec.name);

    const Reader reader(file);
    if (const toml::table* base = document["base"].as_table()) spec.base = reader.settings(*base);
    if (!isList) {
        spec.products.push_back(permute == nullptr ? Product{}
                                                   : reader.product(*permute->as_table()));
        return spec;
    }
    for (const toml::node& table : *permute->as_array())
        spec.products.push_back(reader.product(*table.as_table()));
    if (spec.products.empty()) top.fail("permute", "permute is an empty list");
    return spec;
}

}  // namespace kaustik::experiment
