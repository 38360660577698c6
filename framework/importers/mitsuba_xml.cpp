// SPDX-License-Identifier: MIT
#include "framework/importers/mitsuba_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <string_view>

#include "framework/core/files.h"

namespace kaustik::scene {
namespace {

constexpr int kMaxXmlDepth = 64;

class XmlReader {
  public:
    explicit XmlReader(const std::filesystem::path& file)
        : file_(file.string()), text_(readFile(file)) {
        for (std::size_t i = 0; i < text_.size(); ++i) {
            if (text_[i] == '\n') lineEnds_.push_back(i);
        }
    }

    MitsubaElement read() {
        checkEntitiesAndDoctype();
        pugi::xml_document document;
        const pugi::xml_parse_result result = document.load_buffer(
            text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!result) {
            failAt(placeOf(static_cast<std::size_t>(result.offset)),
                   fmt::format("This is not valid XML: {}.", result.description()));
        }
        if (document.document_element().empty()) failAt(placeOf(0), "The file has no element.");
        return copy(document.document_element(), 0);
    }

  private:
    [[nodiscard]] std::string placeOf(std::size_t offset) const {
        const auto line =
            std::lower_bound(lineEnds_.begin(), lineEnds_.end(), std::min(offset, text_.size()));
        return fmt::format("{}:{}", file_, line - lineEnds_.begin() + 1);
    }

    // The library would leave an entity that it does not know as it stands, and pass a DOCTYPE
    // over.
    void checkEntitiesAndDoctype() const {
        const std::string_view text(text_);
        for (std::size_t i = text.find_first_of("&<"); i < text.size();
             i = text.find_first_of("&<", i + 1)) {
            if (text.substr(i).starts_with("<!--")) {
                i = std::min(text.find("-->", i + 4), text.size());
            } else if (text.substr(i).starts_with("<![CDATA[")) {
                i = std::min(text.find("]]>", i), text.size());
            } else if (text.substr(i).starts_with("<!DOCTYPE")) {
                failAt(placeOf(i), "A DOCTYPE is not taken; a scene does without.");
            } else if (text[i] == '&') {
                const std::string_view name =
                    text.substr(i + 1, std::min<std::size_t>(text.substr(i + 1, 12).find(';'), 12));
                if (!isKnownEntity(name)) {
                    failAt(placeOf(i), fmt::format("'&{};' is no entity of XML; a '&' is written "
                                                   "&amp;.",
                                                   name.substr(0, name.find_first_of(" \n\"<"))));
                }
            }
        }
    }

    static bool isKnownEntity(std::string_view name) {
        if (name.starts_with("#x")) {
            name.remove_prefix(2);
            return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
                return std::isxdigit(c) != 0;
            });
        }
        if (name.starts_with('#')) {
            name.remove_prefix(1);
            return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
                return std::isdigit(c) != 0;
            });
        }
        return name == "lt" || name == "gt" || name == "amp" || name == "quot" || name == "apos";
    }

    MitsubaElement copy(const pugi::xml_node& node, int depth) const {
        MitsubaElement element;
        element.place =
            placeOf(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)));
        if (depth > kMaxXmlDepth)
            failAt(element.place, fmt::format("This is nested more than {} deep.", kMaxXmlDepth));
        element.tag = node.name();
        std::transform(element.tag.begin(), element.tag.end(), element.tag.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        for (const pugi::xml_attribute& attribute : node.attributes()) {
            const std::string name = attribute.name();
            const bool isSpelled = name == "name" && element.tag != "default";
            element.attributes.emplace_back(
                name, isSpelled ? spelledAsOfVersion2(attribute.value()) : attribute.value());
        }
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_element)
                element.children.push_back(copy(child, depth + 1));
        }
        return element;
    }

    // toWorld is to_world since version 2, intIOR int_ior.
    static std::string spelledAsOfVersion2(const std::string& name) {
        std::string spelled;
        bool wasCapital = true;
        for (const char c : name) {
            const bool isCapital = c >= 'A' && c <= 'Z';
            if (isCapital && !wasCapital) spelled += '_';
            spelled += isCapital ? static_cast<char>(c + 32) : c;
            wasCapital = isCapital;
        }
        return spelled;
    }

    std::string file_;
    std::string text_;
    std::vector<std::size_t> lineEnds_;
};

}  // namespace

MitsubaElement readXml(const std::filesystem::path& file) {
    return XmlReader(file).read();
}

}  // namespace kaustik::scene
