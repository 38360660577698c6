// SPDX-License-Identifier: MIT
// PLY (Greg Turk's polygon file format, 1.0): a header in text that declares elements with their
// counts and properties, then their data as text, a line an element, or binary of either byte
// order. Faces and strips of triangles make the mesh; other elements are passed over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "framework/core/error.h"
#include "framework/importers/mesh_formats.h"

namespace kaustik::scene {
namespace {

enum class Encoding { ascii, littleEndian, bigEndian };

struct ScalarType {
    std::string_view name;
    std::string_view otherName;
    std::size_t bytes;
    bool isFloat;
    double min, max;  // of whole numbers
};
constexpr std::array kScalarTypes{
    ScalarType{"char", "int8", 1, false, -128, 127},
    ScalarType{"uchar", "uint8", 1, false, 0, 255},
    ScalarType{"short", "int16", 2, false, -32768, 32767},
    ScalarType{"ushort", "uint16", 2, false, 0, 65535},
    ScalarType{"int", "int32", 4, false, -2147483648.0, 2147483647.0},
    ScalarType{"uint", "uint32", 4, false, 0, 4294967295.0},
    ScalarType{"float", "float32", 4, true, 0, 0},
    ScalarType{"double", "float64", 8, true, 0, 0},
};

// What is read of a vertex, and of a face or strip; all else is passed over.
enum Role { x, y, z, nx, ny, nz, u, v, vertexRoleCount, corners, cornerUvs, none };
struct RoleName {
    std::string_view name;
    Role role;
};
constexpr std::array kVertexRoles{
    RoleName{"x", x},   RoleName{"y", y},   RoleName{"z", z},         RoleName{"nx", nx},
    RoleName{"ny", ny}, RoleName{"nz", nz}, RoleName{"u", u},         RoleName{"v", v},
    RoleName{"s", u},   RoleName{"t", v},   RoleName{"texture_u", u}, RoleName{"texture_v", v},
    RoleName{"tx", u},  RoleName{"ty", v},
};
constexpr std::array kFaceRoles{
    RoleName{"vertex_indices", corners},
    RoleName{"vertex_index", corners},
    RoleName{"texcoord", cornerUvs},
};

struct Property {
    std::string_view name;
    const ScalarType* countType = nullptr;  // null: not a list
    const ScalarType* type = nullptr;
    Role role = none;
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

class Reader {
  public:
    Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    MeshFileContents run() {
        header();
        for (const Element& element : elements_)
            data(element);
        if (shortFaces_ > 0) {
            contents_.warnings.push_back(
                fmt::format("{}: {} faces or strips with fewer than three corners were left out.",
                            name_, shortFaces_));
        }
        if (longLines_ > 0) {
            contents_.warnings.push_back(fmt::format(
                "{}: {} lines have more numbers than their element; these were left out.", name_,
                longLines_));
        }
        const std::size_t more = bytes_.find_first_not_of(" \t\r\n\v\f", at_);
        if (more != std::string_view::npos) {
            contents_.warnings.push_back(fmt::format(
                "{}: {} bytes after the elements that its header declares were ignored.", name_,
                bytes_.size() - more));
        }
        return std::move(contents_);
    }

  private:
    template <class... Values>
    [[noreturn]] void fail(fmt::format_string<Values...> problem, Values&&... values) const {
        throw IoError(
            fmt::format("{} {}.", name_, fmt::format(problem, std::forward<Values>(values)...)));
    }
    [[noreturn]] void failCutOff(const Element& element, std::uint64_t index) const {
        fail("is cut off: it holds {} of {} elements '{}'. Fetch or export it again", index,
             element.count, element.name);
    }

    // False at the end of the bytes; without its line break.
    bool nextLine() {
        if (at_ >= bytes_.size()) return false;
        const std::size_t end = std::min(bytes_.find(lineEnd_, at_), bytes_.size());
        line_ = bytes_.substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
        return true;
    }

    // The next one that is not blank.
    bool nextLineOfData() {
        do {
            if (!nextLine()) return false;
        } while (line_.find_first_not_of(" \t\r\v\f") == std::string_view::npos);
        return true;
    }

    void header() {
        // As old systems wrote text.
        if (bytes_.starts_with("ply\r") && !bytes_.starts_with("ply\r\n")) lineEnd_ = '\r';
        if (!nextLine() || nextWord(line_) != "ply" || !nextWord(line_).empty() ||
            at_ == bytes_.size())
            fail("is no PLY file: it does not begin with a line 'ply'");
        bool hasFormat = false;
        for (std::string_view keyword; keyword != "end_header";) {
            if (!nextLine() || bytes_[at_ - 1] != lineEnd_)
                fail("is cut off in its header (no end_header). Fetch or export it again");
            keyword = nextWord(line_);
            if (keyword == "format") {
                // Readers differ in which of two counts.
                if (hasFormat) fail("has two formats in its header");
                hasFormat = true;
                declareFormat(nextWord(line_));
            } else if (keyword == "element") {
                declareElement();
            } else if (keyword == "property") {
                declareProperty();
            } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" &&
                       keyword != "end_header") {
                // Readers may take it for one of the above.
                fail("has a line '{}' in its header, which PLY does not know", keyword);
            }
        }
        if (!hasFormat) fail("has no format in its header");
        checkElements();
    }

    // What has no properties takes no bytes, so that any number of it would fit into the file. Two
    // lists of vertices leave it open which of them the faces mean.
    void checkElements() const {
        std::set<std::string_view> names;
        for (const Element& element : elements_) {
            if (element.name == "vertex" && (names.contains("face") || names.contains("tristrips")))
                fail("has its faces before their vertices");
            if (!names.insert(element.name).second)
                fail("declares the element '{}' twice in its header", element.name);
            if (element.properties.empty() && element.count > 0) {
                fail("has {} elements '{}' without properties in its header", element.count,
                     element.name);
            }
        }
        if (names.contains("face") && names.contains("tristrips"))
            fail("has both faces and strips of triangles; export it with one kind");
    }

    void declareFormat(std::string_view format) {
        constexpr std::array<std::string_view, 3> kNames{"ascii", "binary_little_endian",
                                                         "binary_big_endian"};
        const auto found = std::find(kNames.begin(), kNames.end(), format);
        if (found == kNames.end()) fail("has the unknown format '{}' in its header", format);
        encoding_ = static_cast<Encoding>(found - kNames.begin());
    }

    void declareElement() {
        Element element;
        element.name = nextWord(line_);
        const std::string_view count = nextWord(line_);
        const auto [end, problem] =
            std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (problem != std::errc() || end != count.data() + count.size() || count.empty()) {
            fail("has no valid count of the element '{}' in its header", element.name);
        }
        elements_.push_back(element);
    }

    void declareProperty() {
        if (elements_.empty()) fail("has a property before the first element in its header");
        Element& element = elements_.back();
        Property property;
        std::string_view type = nextWord(line_);
        if (type == "list") {
            property.countType = scalarType(nextWord(line_));
            if (property.countType->isFloat) {
                fail("has a list in its header whose length is no whole number");
            }
            type = nextWord(line_);
        }
        property.type = scalarType(type);
        property.name = nextWord(line_);
        const auto findRole = [&](const auto& roles) {
            for (const RoleName& known : roles)
                if (known.name == property.name) property.role = known.role;
        };
        if (element.name == "vertex" && property.countType == nullptr) findRole(kVertexRoles);
        if ((element.name == "face" || element.name == "tristrips") &&
            property.countType != nullptr)
            findRole(kFaceRoles);
        for (const Property& other : element.properties) {
            if (other.name == property.name || (other.role == corners && property.role == corners))
                fail("declares '{}' of the element '{}' twice in its header", property.name,
                     element.name);
        }
        element.properties.push_back(property);
    }

    const ScalarType* scalarType(std::string_view typeName) const {
        for (const ScalarType& type : kScalarTypes) {
            if (typeName == type.name || typeName == type.otherName) return &type;
        }
        fail("has the property type '{}' in its header, which PLY does not know", typeName);
    }

    void data(const Element& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (encoding_ == Encoding::ascii && !nextLineOfData()) failCutOff(element, i);
            vertex_.fill(0.0);
            face_.clear();
            faceUvs_.clear();
            for (const Property& property : element.properties) {
                if (property.countType != nullptr) {
                    list(property, element, i);
                } else {
                    const double value = scalar(*property.type, element, i);
                    if (property.role < vertexRoleCount) vertex_[property.role] = value;
                }
            }
            if (encoding_ == Encoding::ascii && !nextWord(line_).empty()) ++longLines_;
            if (element.name == "vertex") {
                addVertex(i);
            } else if (element.name == "face") {
                addFace();
            } else if (element.name == "tristrips") {
                addStrips();
            }
        }
    }

    void addVertex(std::uint64_t index) {
        if (index >= kStripEnd) fail("has more than 2^32 - 1 vertices");
        for (const auto& [name, role] : kVertexRoles) {
            if (role <= z && !std::isfinite(static_cast<float>(vertex_[role])))
                fail("has a vertex {} whose {} is not finite", index, name);
        }
        const std::array<double, vertexRoleCount>& p = vertex_;
        contents_.addVertex(glm::vec3(p[x], p[y], p[z]), glm::vec3(p[nx], p[ny], p[nz]),
                            glm::vec2(p[u], p[v]));
        ++vertexCount_;
    }

    void addFace() {
        if (face_.size() < 3) {
            ++shortFaces_;
            return;
        }
        // Uvs of corners: vertices of the face's own, of which buildMesh joins what is the same.
        const TriangleSoup& soup = contents_.soup;
        for (std::size_t i = 0; i < face_.size() && faceUvs_.size() == 2 * face_.size(); ++i) {
            const std::uint32_t shared = face_[i];
            face_[i] = static_cast<std::uint32_t>(soup.positions.size());
            contents_.addVertex(glm::vec3(soup.positions[shared]), soup.normals[shared],
                                glm::vec2(faceUvs_[2 * i], faceUvs_[2 * i + 1]));
        }
        contents_.addPolygon(face_);
    }

    // -1 ends a strip, of which every second triangle is turned.
    void addStrips() {
        std::size_t first = 0;
        for (std::size_t end = 0; end <= face_.size(); ++end) {
            if (end < face_.size() && face_[end] != kStripEnd) continue;
            if (end - first == 1 || end - first == 2) ++shortFaces_;
            for (std::size_t i = first; i + 2 < end; ++i) {
                const std::size_t turned = (i - first) % 2;
                contents_.soup.triangles.emplace_back(face_[i], face_[i + 1 + turned],
                                                      face_[i + 2 - turned]);
            }
            first = end + 1;
        }
    }

    void list(const Property& property, const Element& element, std::uint64_t index) {
        const double count = scalar(*property.countType, element, index);
        if (count < 0.0) {
            fail("has an element '{}' ({}) whose list has {} entries", element.name, index, count);
        }
        for (double i = 0.0; i < count; ++i) {
            const double value = scalar(*property.type, element, index);
            if (property.role == cornerUvs) faceUvs_.push_back(static_cast<float>(value));
            if (property.role == corners) face_.push_back(corner(value, element, index));
        }
    }

    std::uint32_t corner(double value, const Element& element, std::uint64_t index) const {
        if (element.name == "tristrips" && value == -1.0) return kStripEnd;
        if (!(value >= 0.0 && value < static_cast<double>(vertexCount_)) ||
            value != std::floor(value)) {
            fail("has a face {} that uses vertex {}, but there are only {}", index, value,
                 vertexCount_);
        }
        return static_cast<std::uint32_t>(value);
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
        const double value = static_cast<double>(bits);
        return value > type.max ? value - std::ldexp(1.0, static_cast<int>(8 * type.bytes)) : value;
    }

    double number(const ScalarType& type, const Element& element, std::uint64_t index) {
        const std::string_view word = nextWord(line_);
        if (word.empty()) {
            if (at_ == bytes_.size()) failCutOff(element, index);
            fail("has too few numbers on the line of element '{}' ({})", element.name, index);
        }
        double value = 0.0;
        float single = 0.0f;
        // 1e3 is the whole number 1 to some readers.
        const bool isRight = parseNumber(word, value) &&
                             (type.isFloat || word.find_first_not_of("+-0123456789") == word.npos);
        if (!isRight) {
            fail("has '{}' in place of a {}number in element '{}' ({})", word,
                 type.isFloat ? "" : "whole ", element.name, index);
        }
        if (type.isFloat && type.bytes == 4 && parseFloat(word, single)) return double{single};
        if (!type.isFloat && !(value >= type.min && value <= type.max)) {
            fail("has '{}' in element '{}' ({}), which its type {} cannot hold", word, element.name,
                 index, type.name);
        }
        return value;
    }

    static constexpr std::uint32_t kStripEnd = std::numeric_limits<std::uint32_t>::max();

    std::string_view bytes_;
    const std::string& name_;
    std::size_t at_ = 0;
    char lineEnd_ = '\n';
    std::string_view line_;  // what is left of the line, in text
    Encoding encoding_ = Encoding::ascii;
    std::vector<Element> elements_;
    // Of the element at hand.
    std::array<double, vertexRoleCount> vertex_{};
    std::vector<std::uint32_t> face_;
    std::vector<float> faceUvs_;
    std::uint64_t vertexCount_ = 0;  // so far
    std::size_t shortFaces_ = 0;
    std::size_t longLines_ = 0;
    MeshFileContents contents_;
};

}  // namespace

MeshFileContents readPly(std::string_view bytes, const std::string& name) {
    return Reader(bytes, name).run();
}

}  // namespace kaustik::scene
