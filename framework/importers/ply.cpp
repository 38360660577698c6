// SPDX-License-Identifier: MIT
// The structure of a PLY file (Greg Turk's polygon file format, 1.0): a header in text that
// declares elements with their counts and properties, then their data as text, a line an element,
// or binary of either byte order. Assimp believes the header, reads text by lines, and takes what a
// line lacks from wherever it finds it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>

#include "framework/core/error.h"
#include "framework/importers/mesh_file_checks.h"

namespace kaustik::scene {
namespace {

enum class Encoding { ascii, littleEndian, bigEndian };

struct ScalarType {
    std::string_view name;
    std::string_view otherName;
    std::size_t bytes;
    bool isSigned;
    bool isFloat;

    // Of whole numbers.
    [[nodiscard]] double least() const {
        return isSigned ? -std::ldexp(1.0, static_cast<int>(8 * bytes) - 1) : 0.0;
    }
    [[nodiscard]] double most() const {
        return std::ldexp(1.0, static_cast<int>(8 * bytes) - (isSigned ? 1 : 0)) - 1.0;
    }
};

constexpr std::array kScalarTypes{
    ScalarType{"char", "int8", 1, true, false},    ScalarType{"uchar", "uint8", 1, false, false},
    ScalarType{"short", "int16", 2, true, false},  ScalarType{"ushort", "uint16", 2, false, false},
    ScalarType{"int", "int32", 4, true, false},    ScalarType{"uint", "uint32", 4, false, false},
    ScalarType{"float", "float32", 4, true, true}, ScalarType{"double", "float64", 8, true, true},
};

struct Property {
    std::string_view name;
    const ScalarType* countType = nullptr;  // null: not a list
    const ScalarType* type = nullptr;
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

class Checker {
  public:
    Checker(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    MeshFileContents run() {
        header();
        for (const Element& element : elements_)
            data(element);
        // Text whose last number may have lost digits.
        if (encoding_ == Encoding::ascii && at_ > 0 && at_ == bytes_.size() &&
            !isBlank(bytes_.back())) {
            fail(
                "may be cut off: no line break follows its last number. Add one if it is complete");
        }
        MeshFileContents contents;
        contents.triangles = triangleCount_;
        if (shortFaces_ > 0) {
            contents.warnings.push_back(
                fmt::format("{}: {} faces or strips with fewer than three corners were left out.",
                            name_, shortFaces_));
        }
        while (at_ < bytes_.size() && isBlank(bytes_[at_]))
            ++at_;
        if (at_ < bytes_.size()) {
            contents.warnings.push_back(fmt::format(
                "{}: {} bytes after the elements that its header declares were ignored.", name_,
                bytes_.size() - at_));
        }
        return contents;
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw IoError(fmt::format("{} {}.", name_, problem));
    }
    [[noreturn]] void failBeginning() const {
        fail("is no PLY file: it does not begin with a line 'ply'");
    }
    [[noreturn]] void failCutOff(const Element& element, std::uint64_t index) const {
        fail(fmt::format("is cut off: it holds {} of {} elements '{}'. Fetch or export it again",
                         index, element.count, element.name));
    }

    static bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    static std::string_view nextWord(std::string_view& text) {
        std::size_t begin = 0;
        while (begin < text.size() && isBlank(text[begin]))
            ++begin;
        std::size_t end = begin;
        while (end < text.size() && !isBlank(text[end]))
            ++end;
        const std::string_view word = text.substr(begin, end - begin);
        text.remove_prefix(end);
        return word;
    }

    const ScalarType* scalarType(std::string_view typeName) const {
        for (const ScalarType& type : kScalarTypes) {
            if (typeName == type.name || typeName == type.otherName) return &type;
        }
        fail(fmt::format("has the property type '{}' in its header, which PLY does not know",
                         typeName));
    }

    void header() {
        bool hasFormat = false;
        for (bool isFirst = true;; isFirst = false) {
            const std::size_t end = bytes_.find('\n', at_);
            if (end == std::string_view::npos) {
                if (isFirst) failBeginning();
                fail("is cut off in its header (no end_header). Fetch or export it again");
            }
            std::string_view line = bytes_.substr(at_, end - at_);
            at_ = end + 1;
            const std::string_view keyword = nextWord(line);
            if (isFirst) {
                if (keyword != "ply" || !nextWord(line).empty()) failBeginning();
                continue;
            }
            if (keyword == "end_header") break;
            if (keyword == "format") {
                const std::string_view format = nextWord(line);
                // Readers differ in which of two counts.
                if (hasFormat) fail("has two formats in its header");
                hasFormat = true;
                if (format == "ascii") {
                    encoding_ = Encoding::ascii;
                } else if (format == "binary_little_endian") {
                    encoding_ = Encoding::littleEndian;
                } else if (format == "binary_big_endian") {
                    encoding_ = Encoding::bigEndian;
                } else {
                    fail(fmt::format("has the unknown format '{}' in its header", format));
                }
            } else if (keyword == "element") {
                declareElement(line);
            } else if (keyword == "property") {
                declareProperty(line);
            } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
                // Assimp may take it for one of the above.
                fail(
                    fmt::format("has a line '{}' in its header, which PLY does not know", keyword));
            }
        }
        if (!hasFormat) fail("has no format in its header");
        checkElements();
    }

    // What has no properties takes no bytes, so that any number of it would fit into the file. Of
    // two elements with vertices or faces Assimp makes room for the first, and writes both.
    void checkElements() const {
        std::set<std::string_view> names;
        for (const Element& element : elements_) {
            if (!names.insert(element.name).second)
                fail(fmt::format("declares the element '{}' twice in its header", element.name));
            if (element.properties.empty() && element.count > 0) {
                fail(fmt::format("has {} elements '{}' without properties in its header",
                                 element.count, element.name));
            }
        }
        if (names.contains("face") && names.contains("tristrips"))
            fail("has both faces and strips of triangles; export it with one kind");
    }

    void declareElement(std::string_view line) {
        Element element;
        element.name = nextWord(line);
        const std::string_view count = nextWord(line);
        const auto [end, problem] =
            std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (problem != std::errc() || end != count.data() + count.size() || count.empty()) {
            fail(fmt::format("has no valid count of the element '{}' in its header", element.name));
        }
        if (element.name == "vertex") vertexCount_ = element.count;
        elements_.push_back(element);
    }

    void declareProperty(std::string_view line) {
        if (elements_.empty()) fail("has a property before the first element in its header");
        Property property;
        std::string_view type = nextWord(line);
        if (type == "list") {
            property.countType = scalarType(nextWord(line));
            if (property.countType->isFloat) {
                fail("has a list in its header whose length is no whole number");
            }
            type = nextWord(line);
        }
        property.type = scalarType(type);
        property.name = nextWord(line);
        elements_.back().properties.push_back(property);
    }

    void data(const Element& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (encoding_ == Encoding::ascii) beginLine(element, i);
            for (const Property& property : element.properties) {
                if (property.countType == nullptr) {
                    const double value = scalar(*property.type, element, i);
                    if (element.name == "vertex" && !std::isfinite(value)) checkVertex(property, i);
                    continue;
                }
                list(property, element, i);
            }
            if (encoding_ == Encoding::ascii && !nextWord(line_).empty()) {
                fail(
                    fmt::format("has more on the line of element '{}' ({}) than that element; each "
                                "takes a line of its own",
                                element.name, i));
            }
        }
    }

    void beginLine(const Element& element, std::uint64_t index) {
        if (at_ >= bytes_.size()) failCutOff(element, index);
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        line_ = bytes_.substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
    }

    void checkVertex(const Property& property, std::uint64_t index) const {
        if (property.name == "x" || property.name == "y" || property.name == "z") {
            fail(fmt::format("has a vertex {} whose {} is not finite", index, property.name));
        }
    }

    void list(const Property& property, const Element& element, std::uint64_t index) {
        const double count = scalar(*property.countType, element, index);
        if (count < 0.0) {
            fail(fmt::format("has an element '{}' ({}) whose list has {} entries", element.name,
                             index, count));
        }
        const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
        const bool isFace = element.name == "face" && corners;
        const bool isStrips = element.name == "tristrips";
        std::size_t stripCorners = 0;
        const auto endStrip = [&] {
            if (stripCorners == 1 || stripCorners == 2) ++shortFaces_;
            if (stripCorners > 2) triangleCount_ += stripCorners - 2;
            stripCorners = 0;
        };
        for (double i = 0.0; i < count; ++i) {
            const double value = scalar(*property.type, element, index);
            // -1 ends a strip.
            const bool endsStrip = isStrips && value == -1.0;
            ++stripCorners;
            if (endsStrip) {
                --stripCorners;
                endStrip();
            }
            if (corners && !endsStrip &&
                !(value >= 0.0 && value < static_cast<double>(vertexCount_))) {
                fail(fmt::format("has a face {} that uses vertex {}, but there are only {}", index,
                                 value, vertexCount_));
            }
        }
        if (isStrips && corners) endStrip();
        if (!isFace) return;
        if (count < 3.0) {
            ++shortFaces_;
        } else {
            triangleCount_ += static_cast<std::size_t>(count) - 2;
        }
    }

    // The next number; element and index are for the message when there is none.
    double scalar(const ScalarType& type, const Element& element, std::uint64_t index) {
        if (encoding_ == Encoding::ascii) return number(type, element, index);
        if (bytes_.size() - at_ < type.bytes) failCutOff(element, index);
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t place = encoding_ == Encoding::littleEndian ? i : type.bytes - 1 - i;
            bits |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + i])} << (8 * place);
        }
        at_ += type.bytes;
        if (type.isFloat) {
            return type.bytes == 8 ? std::bit_cast<double>(bits)
                                   : double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
        }
        const std::size_t unused = 64 - 8 * type.bytes;
        return type.isSigned ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >>
                                                   static_cast<int>(unused))
                             : static_cast<double>(bits);
    }

    double number(const ScalarType& type, const Element& element, std::uint64_t index) {
        std::string_view word = nextWord(line_);
        if (word.empty()) {
            if (at_ == bytes_.size()) failCutOff(element, index);
            fail(fmt::format("has too few numbers on the line of element '{}' ({})", element.name,
                             index));
        }
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool isNumber =
            problem != std::errc::invalid_argument && end == word.data() + word.size();
        // 1e3 is the whole number 1 to some readers.
        const bool isRight =
            isNumber && (type.isFloat || word.find_first_not_of("-0123456789") == word.npos);
        if (!isRight) {
            fail(fmt::format("has '{}' in place of a {}number in element '{}' ({})", word,
                             type.isFloat ? "" : "whole ", element.name, index));
        }
        if (!type.isFloat && !(value >= type.least() && value <= type.most())) {
            fail(fmt::format("has '{}' in element '{}' ({}), which its type {} cannot hold", word,
                             element.name, index, type.name));
        }
        return value;
    }

    std::string_view bytes_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::string_view line_;  // what is left of the element's line, in text
    Encoding encoding_ = Encoding::ascii;
    std::vector<Element> elements_;
    std::uint64_t vertexCount_ = 0;
    std::size_t triangleCount_ = 0;
    std::size_t shortFaces_ = 0;
};

}  // namespace

MeshFileContents checkPly(std::string_view bytes, const std::string& name) {
    return Checker(bytes, name).run();
}

}  // namespace kaustik::scene
