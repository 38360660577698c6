// SPDX-License-Identifier: MIT
// STL (3D Systems' stereolithography format): triangles one by one, in binary or as text. Normals
// of facets are left out, since they say no more than the corners; equal corners are joined.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "framework/core/error.h"
#include "framework/importers/mesh_formats.h"

namespace kaustik::scene {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kCountBytes = 4;
constexpr std::size_t kFacetBytes = 50;  // normal and corners as 32-bit floats, and two bytes more

std::uint32_t number32(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
        number |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return number;
}

class Reader {
  public:
    Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    MeshFileContents run() {
        // Some programs begin binary files with "solid", too: their size tells.
        std::string_view rest = bytes_;
        const bool isText = !isWholeBinary() && word(rest) == "solid" &&
                            (bytes_.find("facet") != std::string_view::npos ||
                             bytes_.find("endsolid") != std::string_view::npos);
        if (isText) {
            text(rest);
        } else {
            binary();
        }
        return std::move(contents_);
    }

  private:
    template <class... Values>
    [[noreturn]] void fail(fmt::format_string<Values...> problem, Values&&... values) const {
        throw IoError(fmt::format("{} {}. Fetch or export it again.", name_,
                                  fmt::format(problem, std::forward<Values>(values)...)));
    }

    bool isWholeBinary() const {
        if (bytes_.size() < kHeaderBytes + kCountBytes) return false;
        const std::uint64_t count = number32(bytes_, kHeaderBytes);
        return bytes_.size() == kHeaderBytes + kCountBytes + count * kFacetBytes;
    }

    void binary() {
        if (bytes_.size() < kHeaderBytes + kCountBytes) fail("is no STL file: it has no header");
        const std::uint64_t count = number32(bytes_, kHeaderBytes);
        const std::uint64_t room = (bytes_.size() - kHeaderBytes - kCountBytes) / kFacetBytes;
        if (count > room) fail("is cut off: it holds {} of {} triangles", room, count);
        for (std::uint64_t i = 0; i < count; ++i) {
            std::size_t at = kHeaderBytes + kCountBytes + i * kFacetBytes + 3 * sizeof(float);
            for (int corner = 0; corner < 3; ++corner) {
                glm::vec3 place(0.0f);
                for (glm::length_t axis = 0; axis < 3; ++axis, at += sizeof(float))
                    place[axis] = std::bit_cast<float>(number32(bytes_, at));
                addCorner(place);
            }
        }
        const std::size_t more = bytes_.size() - kHeaderBytes - kCountBytes - count * kFacetBytes;
        if (more > 0) {
            contents_.warnings.push_back(fmt::format(
                "{}: {} bytes after the triangles that it counts were ignored.", name_, more));
        }
    }

    // The next word, over the ends of lines.
    static std::string_view word(std::string_view& rest) {
        constexpr const char* kBlanks = " \t\r\n\v\f";
        const std::size_t begin = std::min(rest.find_first_not_of(kBlanks), rest.size());
        const std::size_t end = std::min(rest.find_first_of(kBlanks, begin), rest.size());
        const std::string_view found = rest.substr(begin, end - begin);
        rest.remove_prefix(end);
        return found;
    }

    // What lies between the corners of a facet says nothing more.
    void text(std::string_view rest) {
        int corners = 0;
        bool isEnded = false;
        // The name of the solid may be any words.
        rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
        for (std::string_view next = word(rest); !next.empty(); next = word(rest)) {
            if (next == "vertex") {
                glm::vec3 place(0.0f);
                for (glm::length_t axis = 0; axis < 3; ++axis) {
                    const std::string_view number = word(rest);
                    if (!parseFloat(number, place[axis]))
                        fail("has '{}' in place of a number in triangle {}", number, triangles());
                }
                addCorner(place);
                ++corners;
            } else if (next == "endloop") {
                if (corners != 3) fail("has {} corners in triangle {}", corners, triangles());
                corners = 0;
            } else if (next == "endsolid") {
                isEnded = true;
            }
        }
        if (!isEnded || corners != 0) fail("is cut off: it has no endsolid");
    }

    std::size_t triangles() const { return contents_.soup.triangles.size(); }

    void addCorner(const glm::vec3& place) {
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(place[axis]))
                fail("has a corner of triangle {} that is not finite", triangles());
        }
        contents_.addVertex(place, glm::vec3(0.0f), glm::vec2(0.0f));
        const auto count = static_cast<std::uint32_t>(contents_.soup.positions.size());
        if (count % 3 == 0) contents_.soup.triangles.emplace_back(count - 3, count - 2, count - 1);
    }

    std::string_view bytes_;
    const std::string& name_;
    MeshFileContents contents_;
};

}  // namespace

MeshFileContents readStl(std::string_view bytes, const std::string& name) {
    return Reader(bytes, name).run();
}

}  // namespace kaustik::scene
