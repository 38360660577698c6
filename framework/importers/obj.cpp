// SPDX-License-Identifier: MIT
// Wavefront OBJ: the statements that carry triangles, v, vt, vn and f. Groups, materials and their
// libraries are left out, since an object of a scene has one material, which the scene gives it.
// What others write is taken where it leaves no doubt: lines that end as on any system, a last one
// that does not end, faces of two corners, uvs and normals that are not there or no numbers (with a
// warning). What would bend the mesh is refused.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/core/error.h"
#include "framework/importers/mesh_formats.h"

namespace kaustik::scene {
namespace {

// A vertex, a uv and a normal, counted from 1; 0 where the corner names none.
using Corner = std::array<std::int64_t, 3>;
constexpr std::array kKinds{"vertex", "uv", "normal"};

struct Face {
    std::size_t lastCorner;  // one past it
    std::size_t line;
};

class Reader {
  public:
    explicit Reader(const std::string& name) : name_(name) {}

    MeshFileContents run(std::string_view bytes) {
        std::string continued;
        if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a byte order mark
        for (std::size_t begin = 0; begin < bytes.size();) {
            ++line_;
            const std::size_t end = std::min(bytes.find_first_of("\r\n", begin), bytes.size());
            std::string_view text = bytes.substr(begin, end - begin);
            const bool endsTwice = end + 1 < bytes.size() && bytes.substr(end, 2) == "\r\n";
            begin = end + (endsTwice ? 2 : 1);
            // A backslash at the end continues the statement on the next line.
            const bool continues = text.ends_with('\\');
            if (continues) text.remove_suffix(1);
            if (continues || !continued.empty()) {
                continued.append(text) += ' ';
                if (continues && begin < bytes.size()) continue;
                text = continued;
            }
            statement(text);
            continued.clear();
        }
        makeFaces();
        const auto warnIfAny = [&](std::size_t count, const char* what) {
            if (count > 0)
                contents_.warnings.push_back(fmt::format("{}: {} {}.", name_, count, what));
        };
        warnIfAny(skipped_, "points, lines, curves or surfaces were left out; only faces are read");
        warnIfAny(shortFaces_, "faces with fewer than three corners were left out");
        warnIfAny(badUvs_, "uvs are no numbers and were taken for 0");
        warnIfAny(badNormals_, "normals are no numbers and were made from the faces");
        warnIfAny(absentUvs_, "corners name a uv that the file does not have");
        warnIfAny(absentNormals_,
                  "corners name a normal that the file does not have, and have it made");
        return std::move(contents_);
    }

  private:
    template <class... Values>
    [[noreturn]] void fail(fmt::format_string<Values...> problem, Values&&... values) const {
        throw IoError(fmt::format("{}:{}: {}.", name_, line_,
                                  fmt::format(problem, std::forward<Values>(values)...)));
    }

    void statement(std::string_view text) {
        const std::string_view keyword = nextWord(text);
        if (keyword == "v") {
            positions_.push_back(position(text));
        } else if (keyword == "vt") {
            uvs_.push_back(uv(text));
        } else if (keyword == "vn") {
            normals_.push_back(normal(text));
        } else if (keyword == "f" || keyword == "fo") {  // as the first version had it
            face(text);
        } else if (keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "curv2" ||
                   keyword == "surf") {
            ++skipped_;
        }
    }

    float coordinate(std::string_view word) const {
        float value = 0.0f;
        if (word.empty()) fail("a vertex has too few coordinates");
        if (!parseFloat(word, value)) fail("'{}' is not a number", word);
        if (!std::isfinite(value)) fail("the coordinate '{}' is not finite", word);
        return value;
    }

    glm::vec3 position(std::string_view text) const {
        glm::vec3 place(0.0f);
        for (glm::length_t i = 0; i < 3; ++i)
            place[i] = coordinate(nextWord(text));
        // A fourth number is a weight; six are a place and a colour.
        float weight = 1.0f;
        float green = 0.0f;
        if (!parseFloat(nextWord(text), weight) || parseFloat(nextWord(text), green)) return place;
        if (weight == 0.0f || !std::isfinite(weight)) fail("a vertex has the weight {}", weight);
        return place / weight;
    }

    // "-nan(ind)" and "1.#QNAN" are how some systems write what is not a number.
    static bool isNumber(std::string_view word, float& value) {
        return parseFloat(word, value) && std::isfinite(value);
    }

    glm::vec2 uv(std::string_view text) {
        glm::vec2 place(0.0f);
        const std::string_view u = nextWord(text);
        const std::string_view v = nextWord(text);
        if (u.empty()) fail("a uv has no coordinate");
        if (isNumber(u, place.x) && (v.empty() || v.starts_with('#') || isNumber(v, place.y)))
            return place;
        ++badUvs_;
        return glm::vec2(0.0f);
    }

    // One that is not a number is made anew after the import.
    glm::vec3 normal(std::string_view text) {
        glm::vec3 direction(0.0f);
        bool isGood = true;
        for (glm::length_t i = 0; i < 3; ++i) {
            const std::string_view word = nextWord(text);
            if (word.empty()) fail("a normal has fewer than three components");
            isGood = isNumber(word, direction[i]) && isGood;
        }
        if (isGood) return direction;
        ++badNormals_;
        return glm::vec3(0.0f);
    }

    void face(std::string_view text) {
        const std::size_t first = corners_.size();
        for (std::string_view word = nextWord(text); !word.empty() && !word.starts_with('#');
             word = nextWord(text))
            corners_.push_back(corner(word));
        if (corners_.size() - first < 3) {
            corners_.resize(first);
            ++shortFaces_;
            return;
        }
        faces_.push_back({corners_.size(), line_});
    }

    // "7", "7/8", "7/8/9" or "7//9".
    Corner corner(std::string_view word) const {
        const std::array<std::size_t, 3> counts{positions_.size(), uvs_.size(), normals_.size()};
        Corner result{};
        std::string_view rest = word;
        for (std::size_t kind = 0;; ++kind) {
            const std::size_t slash = std::min(rest.find('/'), rest.size());
            const std::string_view text = rest.substr(0, slash);
            if (kind == 3) failCorner(word);
            if (!text.empty() || kind == 0) {
                std::int64_t& index = result[kind];
                const auto [end, problem] =
                    std::from_chars(text.data(), text.data() + text.size(), index);
                if (problem != std::errc() || end != text.data() + text.size() || index == 0)
                    failCorner(word);
                // Negative: counted back from the latest.
                const auto count = static_cast<std::int64_t>(counts[kind]);
                if (index < -count) {
                    fail("a face uses {} {}, but there are only {} before it", kKinds[kind], index,
                         count);
                }
                if (index < 0) index += count + 1;
            }
            if (slash == rest.size()) return result;
            rest.remove_prefix(slash + 1);
        }
    }
    [[noreturn]] void failCorner(std::string_view word) const {
        fail("'{}' is not a corner of a face", word);
    }

    // After all statements, since a face may use what follows it.
    void makeFaces() {
        std::vector<std::uint32_t> polygon;
        std::size_t at = 0;
        if (corners_.size() > std::numeric_limits<std::uint32_t>::max())
            throw IoError(fmt::format("{}: the faces have more than 2^32 corners.", name_));
        for (const Face& face : faces_) {
            line_ = face.line;
            polygon.clear();
            for (; at < face.lastCorner; ++at) {
                auto [vertex, uv, normal] = corners_[at];
                if (vertex > static_cast<std::int64_t>(positions_.size())) {
                    fail("a face uses vertex {}, but the file has only {}", vertex,
                         positions_.size());
                }
                const auto leaveOut = [](std::int64_t& index, std::size_t of, std::size_t& absent) {
                    if (index <= static_cast<std::int64_t>(of)) return;
                    index = 0;
                    ++absent;
                };
                leaveOut(uv, uvs_.size(), absentUvs_);
                leaveOut(normal, normals_.size(), absentNormals_);
                polygon.push_back(static_cast<std::uint32_t>(contents_.soup.positions.size()));
                contents_.addVertex(entry(positions_, vertex), entry(normals_, normal),
                                    entry(uvs_, uv));
            }
            contents_.addPolygon(polygon);
        }
    }

    template <class Value>
    static Value entry(const std::vector<Value>& list, std::int64_t index) {
        return index == 0 ? Value(0.0f) : list[static_cast<std::size_t>(index - 1)];
    }

    const std::string& name_;
    std::size_t line_ = 0;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec2> uvs_;
    std::vector<glm::vec3> normals_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    std::size_t skipped_ = 0;
    std::size_t shortFaces_ = 0;
    std::size_t badUvs_ = 0;
    std::size_t badNormals_ = 0;
    std::size_t absentUvs_ = 0;  // of corners
    std::size_t absentNormals_ = 0;
    MeshFileContents contents_;
};

}  // namespace

MeshFileContents readObj(std::string_view bytes, const std::string& name) {
    return Reader(name).run(bytes);
}

}  // namespace kaustik::scene
