// SPDX-License-Identifier: MIT
// The structure of a PLY file (Greg Turk's polygon file format, 1.0): a header in text that
// declares elements with their counts and properties, then their data as text or binary of either
// byte order.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

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
        bool strips = false;
        for (const Element& element : elements_) {
            data(element);
            strips = strips || (element.name == "tristrips" && element.count > 0);
        }
        // Text whose last number may have lost digits.
        if (encoding_ == Encoding::ascii && at_ > 0 && at_ == bytes_.size() &&
            !isBlank(bytes_.back())) {
            fail(
                "may be cut off: no line break follows its last number. Add one if it is complete");
        }
        MeshFileContents contents;
        // How many triangles a strip makes is up to the reader.
        if (!strips) contents.triangles = triangleCount_;
        if (shortFaces_ > 0) {
            contents.warnings.push_back(fmt::format(
                "{}: {} faces with fewer than three corners were left out.", name_, shortFaces_));
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
        if (!bytes_.starts_with("ply")) fail("is no PLY file: it does not begin with 'ply'");
        bool hasFormat = false;
        for (;;) {
            const std::size_t end = bytes_.find('\n', at_);
            if (end == std::string_view::npos) {
                fail("is cut off in its header (no end_header). Fetch or export it again");
            }
            std::string_view line = bytes_.substr(at_, end - at_);
            at_ = end + 1;
            const std::string_view keyword = nextWord(line);
            if (keyword == "end_header") break;
            if (keyword == "format") {
                const std::string_view format = nextWord(line);
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
            }
        }
        if (!hasFormat) fail("has no format in its header");
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
            type = nextWord(line);
        }
        property.type = scalarType(type);
        property.name = nextWord(line);
        elements_.back().properties.push_back(property);
    }

    void data(const Element& element) {
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                if (property.countType == nullptr) {
                    const double value = scalar(*property.type, element, i);
                    if (element.name == "vertex" && !std::isfinite(value)) checkVertex(property, i);
                    continue;
                }
                list(property, element, i);
            }
        }
    }

    void checkVertex(const Property& property, std::uint64_t index) const {
        if (property.name == "x" || property.name == "y" || property.name == "z") {
            fail(fmt::format("has a vertex {} whose {} is not finite", index, property.name));
        }
    }

    void list(const Property& property, const Element& element, std::uint64_t index) {
        const double count = scalar(*property.countType, element, index);
        if (!(count >= 0.0) || count != std::floor(count)) {
            fail(fmt::format("has an element '{}' ({}) whose list has {} entries", element.name,
                             index, count));
        }
        const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
        const bool isFace = element.name == "face" && corners;
        for (double i = 0.0; i < count; ++i) {
            const double value = scalar(*property.type, element, index);
            // -1 ends a strip.
            const bool endsStrip = element.name == "tristrips" && value == -1.0;
            if (corners && !endsStrip &&
                !(value >= 0.0 && value < static_cast<double>(vertexCount_))) {
                fail(fmt::format("has a face {} that uses vertex {}, but there are only {}", index,
                                 value, vertexCount_));
            }
        }
        if (!isFace) return;
        if (count < 3.0) {
            ++shortFaces_;
        } else {
            triangleCount_ += static_cast<std::size_t>(count) - 2;
        }
    }

    // The next number; element and index are for the message when there is none.
    double scalar(const ScalarType& type, const Element& element, std::uint64_t index) {
        if (encoding_ == Encoding::ascii) {
            std::string_view rest = bytes_.substr(at_);
            std::string_view word = nextWord(rest);
            if (word.empty()) failCutOff(element, index);
            at_ = bytes_.size() - rest.size();
            if (word.starts_with('+')) word.remove_prefix(1);
            double value = 0.0;
            const auto [end, problem] =
                std::from_chars(word.data(), word.data() + word.size(), value);
            if (problem == std::errc::invalid_argument || end != word.data() + word.size()) {
                fail(fmt::format("has '{}' in place of a number in element '{}' ({})", word,
                                 element.name, index));
            }
            return value;
        }
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

    std::string_view bytes_;
    const std::string& name_;
    std::size_t at_ = 0;
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
