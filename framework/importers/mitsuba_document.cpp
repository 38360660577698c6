// SPDX-License-Identifier: MIT
#include "framework/importers/mitsuba_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/importers/mitsuba_xml.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMaxIncludes = 16;  // in each other

class DocumentReader {
  public:
    explicit DocumentReader(const fs::path& file) : folder_(file.parent_path()) {
        std::error_code error;
        realFolder_ = fs::weakly_canonical(folder_.empty() ? "." : folder_, error);
    }

    MitsubaElement read(const fs::path& file) {
        MitsubaElement root = readXml(file);
        prepare(root);
        return root;
    }

  private:
    // Replaces names and includes in all of the element, in the order of the file.
    void prepare(MitsubaElement& element) {
        for (auto& [name, value] : element.attributes)
            value = substituted(value, element.place);
        std::vector<MitsubaElement> children = std::move(element.children);
        element.children.clear();
        for (MitsubaElement& child : children) {
            if (child.tag == "include") {
                include(child, element.children);
                continue;
            }
            prepare(child);
            if (child.tag == "default") {
                // What the command line or an earlier file has said comes first.
                defaults_.emplace(child.required("name"), child.attribute("value"));
                continue;
            }
            element.children.push_back(std::move(child));
        }
    }

    void include(const MitsubaElement& element, std::vector<MitsubaElement>& children) {
        const std::string name = substituted(element.required("filename"), element.place);
        std::error_code error;
        const fs::path file = folder_ / name;
        const fs::path inside = fs::weakly_canonical(file, error).lexically_relative(realFolder_);
        if (error || inside.empty() || *inside.begin() == ".." || fs::path(name).is_absolute()) {
            failAt(element.place,
                   fmt::format("'{}' is not in the scene's own folder, and only files there are "
                               "included.",
                               name));
        }
        if (++depth_ > kMaxIncludes)
            failAt(element.place, "files include each other without an end.");
        if (!fs::is_regular_file(file, error)) {
            throw IoError(fmt::format("{}: the included file {} was not found.", element.place,
                                      file.string()));
        }
        MitsubaElement root = read(file);
        --depth_;
        if (root.tag != "scene") return children.push_back(std::move(root));
        std::move(root.children.begin(), root.children.end(), std::back_inserter(children));
    }

    std::string substituted(const std::string& text, const std::string& place) const {
        std::string result;
        for (std::size_t i = 0; i < text.size();) {
            if (text[i] != '$') {
                result += text[i++];
                continue;
            }
            const auto isName = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
            const auto begin = text.begin() + static_cast<std::ptrdiff_t>(i) + 1;
            const std::string name(begin, std::find_if_not(begin, text.end(), isName));
            const auto found = defaults_.find(name);
            if (found == defaults_.end())
                failAt(place, fmt::format("'${}' has no <default>; give it one above.", name));
            result += found->second;
            i += 1 + name.size();
        }
        return result;
    }

    fs::path folder_;
    fs::path realFolder_;
    std::map<std::string, std::string> defaults_;
    std::size_t depth_ = 0;
};

void collectIds(const MitsubaElement& element, MitsubaDocument& document) {
    const std::string& id = element.attribute("id");
    if (!id.empty() && element.tag != "ref" && element.tag != "alias") {
        if (!document.ids.emplace(id, &element).second)
            failAt(element.place, fmt::format("the id '{}' is used twice.", id));
    }
    for (const MitsubaElement& child : element.children)
        collectIds(child, document);
}

void collectAliases(const MitsubaElement& element, MitsubaDocument& document) {
    for (const MitsubaElement& child : element.children) {
        if (child.tag != "alias") continue;
        const auto found = document.ids.find(child.required("id"));
        if (found == document.ids.end())
            failAt(child.place, fmt::format("nothing has the id '{}'.", child.required("id")));
        document.ids.emplace(child.required("as"), found->second);
        child.isUsed = true;
    }
}

}  // namespace

const MitsubaElement& MitsubaDocument::resolve(const MitsubaElement& element) const {
    element.isUsed = true;
    if (element.tag != "ref") return element;
    const std::string& id = element.required("id");
    const auto found = ids.find(id);
    if (found != ids.end()) {
        found->second->isUsed = true;
        return *found->second;
    }
    std::vector<std::string> names;
    for (const auto& [name, target] : ids)
        names.push_back(name);
    const std::string suggestion = didYouMean(id, names);
    failAt(element.place,
           fmt::format("nothing has the id '{}'{}", id, suggestion.empty() ? "." : suggestion));
}

fs::path MitsubaDocument::file(const std::string& name) const {
    return folder / name;
}

void readMitsubaDocument(const fs::path& file, MitsubaDocument& document) {
    document.folder = file.parent_path();
    document.root = DocumentReader(file).read(file);
    if (document.root.tag != "scene") {
        failAt(document.root.place,
               fmt::format("the file's element is <{}> and not <scene>, so that it is no Mitsuba "
                           "scene.",
                           document.root.tag));
    }
    document.root.isUsed = true;
    collectIds(document.root, document);
    collectAliases(document.root, document);
}

}  // namespace kaustik::scene
