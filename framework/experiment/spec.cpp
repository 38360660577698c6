// SPDX-License-Identifier: MIT
#include "framework/experiment/spec.h"

#include <fmt/format.h>

#include "framework/experiment/spec_keys.h"

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

}  // namespace

Spec readSpec(const fs::path& file) {
    const SettingReader settings(file);
    const TomlNode document = settings.parse();
    scene::TableReader top(document, file, "");
    Spec spec;
    spec.file = file;
    if (top.has("suite")) {
        auto keys = top.read<SuiteKeys>();
        spec.name = std::move(keys.name);
        spec.description = std::move(keys.description);
        spec.suite = std::move(keys.suite);
        spec.cases = std::move(keys.cases);
        spec.casesPlace = top.place("cases");
        return spec;
    }
    auto keys = top.read<StudyKeys>();
    spec.name = std::move(keys.name);
    spec.description = std::move(keys.description);
    spec.repeats = keys.repeats;

    const Reader reader(file);
    if (const TomlNode* base = document.find("base")) spec.base = settings.settings(*base);
    const TomlNode* permute = document.find("permute");
    if (permute == nullptr || permute->list() == nullptr) {
        spec.products.push_back(permute == nullptr ? Product{} : reader.product(*permute));
        return spec;
    }
    for (const TomlNode& table : *permute->list())
        spec.products.push_back(reader.product(table));
    return spec;
}

}  // namespace kaustik::experiment
