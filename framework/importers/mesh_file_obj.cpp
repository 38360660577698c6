// SPDX-License-Identifier: MIT
// The statements of a Wavefront OBJ file that carry triangles: v, vt, vn and f. Assimp gets these
// alone. It answers a material library that is missing with the OBJ file itself, and takes a time
// that grows with the square of the number of groups; nothing is lost, since an object of a scene
// has one material, which the scene gives it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "framework/core/error.h"
#include "framework/importers/mesh_file_checks.h"

namespace kaustik::scene {
namespace {

// An index that was used: counted from 1, with the line that used it.
struct LargestIndex {
    std::int64_t index = 0;
    std::size_t line = 0;
};

struct Kind {
    const char* what;
    std::int64_t count = 0;
    LargestIndex largest{};
};

class Checker {
  public:
    explicit Checker(const std::string& name) : name_(name) {}

    MeshFileContents run(std::string_view bytes) {
        geometry_.reserve(bytes.size());
        for (std::size_t begin = 0; begin < bytes.size();) {
            ++line_;
            const std::size_t found = bytes.find('\n', begin);
            const std::size_t end = found == std::string_view::npos ? bytes.size() : found;
            std::string_view text = bytes.substr(begin, end - begin);
            begin = end + 1;
            if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
            // A backslash at the end continues the statement on the next line.
            if (!text.empty() && text.back() == '\\') {
                text.remove_suffix(1);
                continued_ += std::string(text) + ' ';
                if (found != std::string_view::npos) continue;
            }
            continued_ += text;
            const bool isGeometry = statement(continued_);
            if (isGeometry) geometry_.append(continued_) += '\n';
            continued_.clear();
            if (isGeometry && found == std::string_view::npos) {
                fail(
                    "the file ends within this statement, so that it may be cut off; if it is "
                    "complete, add a line break at its end");
            }
        }
        for (const Kind* kind : {&positions_, &uvs_, &normals_}) {
            if (kind->largest.index <= kind->count) continue;
            line_ = kind->largest.line;
            fail(fmt::format("a face uses {} {}, but the file has only {}", kind->what,
                             kind->largest.index, kind->count));
        }
        MeshFileContents contents;
        contents.triangles = triangleCount_;
        contents.geometry = std::move(geometry_);
        if (leftOut_ > 0) {
            contents.warnings.push_back(fmt::format(
                "{}: {} points, lines, curves or surfaces were left out; only faces are read.",
                name_, leftOut_));
        }
        return contents;
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw IoError(fmt::format("{}:{}: {}.", name_, line_, problem));
    }

    static std::string_view nextWord(std::string_view& text) {
        constexpr const char* kBlanks = " \t\r\v\f";
        const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
        const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        text.remove_prefix(end);
        return word;
    }

    // True when it was one of the statements that the mesh is made of.
    bool statement(std::string_view text) {
        const std::string_view keyword = nextWord(text);
        if (keyword == "v") {
            ++positions_.count;
            for (int i = 0; i < 3; ++i)
                checkCoordinate(nextWord(text));
        } else if (keyword == "vt") {
            ++uvs_.count;
            checkCoordinate(nextWord(text));
        } else if (keyword == "vn") {
            // A normal that is not a number is made anew after the import.
            ++normals_.count;
            for (int i = 0; i < 3; ++i) {
                if (nextWord(text).empty()) fail("a normal has fewer than three components");
            }
        } else if (keyword == "f") {
            face(text);
        } else {
            if (keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "curv2" ||
                keyword == "surf") {
                ++leftOut_;
            }
            return false;
        }
        return true;
    }

    void checkCoordinate(std::string_view word) const {
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty()) fail("a vertex has too few coordinates");
        if (problem == std::errc::invalid_argument || end != word.data() + word.size()) {
            fail(fmt::format("'{}' is not a number", word));
        }
        if (problem != std::errc() ||
            !(std::abs(value) <= double{std::numeric_limits<float>::max()})) {
            fail(fmt::format("the coordinate '{}' is not finite", word));
        }
    }

    void face(std::string_view text) {
        std::size_t corners = 0;
        for (std::string_view word = nextWord(text); !word.empty(); word = nextWord(text)) {
            if (word.starts_with('#')) break;
            ++corners;
            const std::string_view whole = word;
            std::size_t part = 0;
            for (Kind* kind : {&positions_, &uvs_, &normals_}) {
                const std::size_t slash = std::min(word.find('/'), word.size());
                const std::string_view index = word.substr(0, slash);
                // "1//3" has no uv.
                if (!index.empty() || part == 0) use(*kind, index, whole);
                ++part;
                if (slash == word.size()) {
                    word = {};
                    break;
                }
                word.remove_prefix(slash + 1);
            }
            if (!word.empty()) fail(fmt::format("'{}' is not a corner of a face", whole));
        }
        if (corners < 3) {
            fail(fmt::format("a face has {} corners; it takes three or more", corners));
        }
        triangleCount_ += corners - 2;
    }

    void use(Kind& kind, std::string_view text, std::string_view corner) {
        std::int64_t index = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), index);
        if (problem != std::errc() || end != text.data() + text.size() || index == 0) {
            fail(fmt::format("'{}' is not a corner of a face", corner));
        }
        // Negative: counted back from the latest.
        if (index < 0 && index < -kind.count) {
            fail(fmt::format("a face uses {} {}, but there are only {} before it", kind.what, index,
                             kind.count));
        }
        if (index > kind.largest.index) kind.largest = {index, line_};
    }

    const std::string& name_;
    std::size_t line_ = 0;
    std::string continued_;
    std::string geometry_;
    Kind positions_{"vertex"};
    Kind uvs_{"uv"};
    Kind normals_{"normal"};
    std::size_t triangleCount_ = 0;
    std::size_t leftOut_ = 0;
};

}  // namespace

MeshFileContents checkObj(std::string_view bytes, const std::string& name) {
    return Checker(name).run(bytes);
}

}  // namespace kaustik::scene
