// SPDX-License-Identifier: MIT
#include "framework/scene/files/toml_node.h"

#include <algorithm>

namespace kaustik::scene {

const std::vector<TomlNode>* TomlNode::list() const {
    const TomlList* const found = as<TomlList>();
    return found != nullptr ? &found->elements : nullptr;
}

const std::vector<TomlEntry>& TomlNode::entries() const {
    static const std::vector<TomlEntry> none;
    const TomlTable* const table = as<TomlTable>();
    return table != nullptr ? table->entries : none;
}

const TomlNode* TomlNode::find(std::string_view key) const {
    const std::vector<TomlEntry>& all = entries();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const TomlEntry& entry) { return entry.key == key; });
    return found != all.end() ? &found->node : nullptr;
}

TomlNode readToml(const std::filesystem::path& file) {
    reading::ReaderProcess reader;
    return readToml(file, reader);
}

TomlNode readToml(const std::filesystem::path& file, reading::ReaderProcess& reader) {
    return reader.ask<TomlNode>({reading::RequestKind::toml, file.string(), file, ""});
}

}  // namespace kaustik::scene
