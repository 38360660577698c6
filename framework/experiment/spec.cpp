// SPDX-License-Identifier: MIT
#include "framework/experiment/spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "framework/core/error.h"
#include "framework/experiment/value_range.h"
#include "framework/scene/files/table_reader.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::TomlNode;
using scene::TomlTable;

// What the tables of an experiment hold.
class Reader {
  public:
    explicit Reader(const fs::path& file) : file_(file), reader_(file) {}

    [[nodiscard]] Product product(const TomlNode& table) const {
        Product product;
        reader_.visit(table, "", false, [&](const std::string& key, const TomlNode& node) {
            product.push_back({key, values(key, node), reader_.place(node)});
        });
        return product;
    }

  private:
    [[nodiscard]] std::vector<Setting> values(const std::string& key, const TomlNode& node) const {
        std::vector<Setting> values;
        if (node.as<TomlTable>() != nullptr) {
            for (json& number : readRange(node, key, file_))
                values.push_back({key, std::move(number), reader_.place(node)});
            return values;
        }
        const std::vector<TomlNode>* list = node.list();
        if (list == nullptr) {
            reader_.fail(node,
                         fmt::format("permute: {} must be a list of values or a range such as "
                                     "{{from = 1, to = 8, factor = 2}}",
                                     key));
        }
        if (list->empty()) {
            reader_.fail(node,
                         fmt::format("permute: {} is an empty list; give it at least one value, or "
                                     "leave it out",
                                     key));
        }
        for (const TomlNode& element : *list)
            values.push_back({key, reader_.value(key, element), reader_.place(element)});
        return values;
    }

    fs::path file_;
    SettingReader reader_;
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
    const SettingReader settings(file);
    const TomlNode document = settings.parse();
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
    if (const TomlNode* base = document.find("base")) spec.base = settings.settings(*base);
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
