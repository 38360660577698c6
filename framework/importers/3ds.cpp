// SPDX-License-Identifier: MIT
// 3D Studio files: chunks of a 16-bit kind and a 32-bit length (which counts these six bytes), then
// data or further chunks. Only those on the way to the triangles are followed. Vertices stand where
// the scene has them; local axes are for whoever edits it. Z is up in the file, y in the mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "framework/core/error.h"
#include "framework/importers/mesh_formats.h"
#include "framework/scene/meshes/position_welding.h"

namespace kaustik::scene {
namespace {

constexpr std::size_t kChunkHeaderBytes = 6;
// Smoothing groups lie six deep; chunks in chunks of the same kind would fill the stack.
constexpr int kMaxDepth = 16;
constexpr unsigned kMain = 0x4d4d;
constexpr unsigned kEditor = 0x3d3d;
constexpr unsigned kMasterScale = 0x0100;
constexpr unsigned kObject = 0x4000;
constexpr unsigned kTriangleMesh = 0x4100;
constexpr unsigned kVertices = 0x4110;
constexpr unsigned kFaces = 0x4120;
constexpr unsigned kUvs = 0x4140;
constexpr unsigned kSmoothingGroups = 0x4150;
constexpr unsigned kKeyframes = 0xb000;

struct Face {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t groups;  // a bit each
};

// One object's mesh.
struct Object {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<Face> faces;
};

class Reader {
  public:
    explicit Reader(const std::string& name) : name_(name) {}

    MeshFileContents run(std::string_view bytes) {
        if (bytes.size() < kChunkHeaderBytes || number16(bytes) != kMain) {
            fail("is no 3DS file: it does not begin with the chunk 4D4D");
        }
        const std::uint32_t length = number32(bytes.substr(2));
        if (length > bytes.size()) {
            fail("is cut off: {} bytes of {}", bytes.size(), length);
        }
        if (length < kChunkHeaderBytes) fail("is damaged: its main chunk is shorter than a header");
        children(bytes.substr(kChunkHeaderBytes, length - kChunkHeaderBytes));
        for (glm::dvec3& position : contents_.soup.positions)
            position /= scale_;
        return std::move(contents_);
    }

  private:
    template <class... Values>
    [[noreturn]] void fail(fmt::format_string<Values...> problem, Values&&... values) const {
        throw IoError(fmt::format("{} {}. Fetch or export it again.", name_,
                                  fmt::format(problem, std::forward<Values>(values)...)));
    }

    static unsigned number16(std::string_view bytes) {
        return static_cast<unsigned char>(bytes[0]) |
               static_cast<unsigned>(static_cast<unsigned char>(bytes[1])) << 8;
    }
    static std::uint32_t number32(std::string_view bytes) {
        return number16(bytes) | static_cast<std::uint32_t>(number16(bytes.substr(2))) << 16;
    }
    static float real(std::string_view bytes) { return std::bit_cast<float>(number32(bytes)); }

    // The chunks that fill `bytes`.
    void children(std::string_view bytes) {
        if (++depth_ > kMaxDepth) {
            fail("is damaged: its chunks are nested more than {} deep", kMaxDepth);
        }
        // Some writers pad the end of a chunk.
        while (bytes.size() >= kChunkHeaderBytes) {
            const unsigned kind = number16(bytes);
            const std::uint32_t length = number32(bytes.substr(2));
            if (length < kChunkHeaderBytes || length > bytes.size()) {
                fail("is damaged: the chunk {:04X} does not fit into its parent", kind);
            }
            chunk(kind, bytes.substr(kChunkHeaderBytes, length - kChunkHeaderBytes));
            bytes.remove_prefix(length);
        }
        --depth_;
    }

    void chunk(unsigned kind, std::string_view bytes) {
        switch (kind) {
            case kEditor:
                children(bytes);
                break;
            case kMasterScale:
                masterScale(bytes);
                break;
            case kObject: {
                const std::size_t nameEnd = bytes.find('\0');
                if (nameEnd == std::string_view::npos) fail("is damaged: an object has no name");
                children(bytes.substr(nameEnd + 1));
                break;
            }
            case kTriangleMesh:
                object_ = {};
                children(bytes);
                addObject();
                break;
            case kVertices:
                object_.positions.clear();
                forEach(bytes, 12, "vertices", [&](std::string_view item) {
                    object_.positions.emplace_back(real(item), real(item.substr(8)),
                                                   -real(item.substr(4)));
                });
                break;
            case kUvs:
                object_.uvs.clear();
                forEach(bytes, 8, "uvs", [&](std::string_view item) {
                    object_.uvs.emplace_back(real(item), real(item.substr(4)));
                });
                break;
            case kFaces:
                readFaces(bytes);
                break;
            case kSmoothingGroups:
                for (std::size_t i = 0; i < object_.faces.size() && 4 * i + 4 <= bytes.size(); ++i)
                    object_.faces[i].groups = number32(bytes.substr(4 * i));
                break;
            case kKeyframes:
                contents_.warnings.push_back(fmt::format(
                    "{}: its keyframes were left out; objects stand where their vertices are.",
                    name_));
                break;
            default:
                break;
        }
    }

    // Zero says that there is none.
    void masterScale(std::string_view bytes) {
        const float scale = bytes.size() < 4 ? 0.0f : real(bytes);
        if (!(scale >= 0.0f && std::isfinite(scale)))
            fail("is damaged: its master scale is {}", scale);
        if (scale > 0.0f) scale_ = double{scale};
    }

    // The items of a list that begins with its 16-bit count; gives the bytes behind it.
    template <class Take>
    std::string_view forEach(std::string_view bytes, std::size_t itemBytes, const char* items,
                             const Take& take) const {
        const std::size_t count = bytes.size() < 2 ? 0 : number16(bytes);
        if (bytes.size() < 2 + itemBytes * count) {
            fail("is damaged: a chunk is too short for its {}", items);
        }
        for (std::size_t i = 0; i < count; ++i)
            take(bytes.substr(2 + itemBytes * i, itemBytes));
        return bytes.substr(2 + itemBytes * count);
    }

    // Three 16-bit vertices and 16 bits of flags a face; then chunks about the faces.
    void readFaces(std::string_view bytes) {
        object_.faces.clear();
        children(forEach(bytes, 8, "faces", [&](std::string_view item) {
            object_.faces.push_back(
                {{number16(item), number16(item.substr(2)), number16(item.substr(4))}, 0});
        }));
    }

    // A vertex of its own for each corner; buildMesh joins those that are the same.
    void addObject() {
        const std::size_t count = object_.positions.size();
        for (const Face& face : object_.faces) {
            const std::uint32_t largest =
                *std::max_element(face.corners.begin(), face.corners.end());
            if (largest < count) continue;
            fail("is damaged: a face uses vertex {}, but there are only {}", largest, count);
        }
        object_.uvs.resize(count, glm::vec2(0.0f));
        const std::vector<std::uint32_t> places = weldPositions(object_.positions);
        const NormalSums sums = sumNormals(places);
        for (const auto& [corners, groups] : object_.faces) {
            const auto first = static_cast<std::uint32_t>(contents_.soup.positions.size());
            for (const std::uint32_t vertex : corners) {
                contents_.addVertex(object_.positions[vertex],
                                    smoothNormal(sums, places[vertex], groups),
                                    object_.uvs[vertex]);
            }
            contents_.soup.triangles.emplace_back(first, first + 1, first + 2);
        }
    }

    // By place and smoothing groups: the sum of the normals of the faces there, by their area. None
    // where the object has no groups, since it is then smooth everywhere.
    using NormalSums = std::map<std::pair<std::uint32_t, std::uint32_t>, glm::vec3>;
    NormalSums sumNormals(const std::vector<std::uint32_t>& places) const {
        NormalSums sums;
        const auto& faces = object_.faces;
        if (std::all_of(faces.begin(), faces.end(), [](const Face& f) { return f.groups == 0; }))
            return sums;
        for (const auto& [corners, groups] : faces) {
            const glm::vec3& a = object_.positions[corners[0]];
            const glm::vec3 normal =
                glm::cross(object_.positions[corners[1]] - a, object_.positions[corners[2]] - a);
            for (const std::uint32_t vertex : corners)
                sums.try_emplace({places[vertex], groups}, 0.0f).first->second += normal;
        }
        return sums;
    }

    // Of those faces that have a group in common; one without a group joins all.
    static glm::vec3 smoothNormal(const NormalSums& sums, std::uint32_t place,
                                  std::uint32_t groups) {
        glm::vec3 normal(0.0f);
        for (auto sum = sums.lower_bound({place, 0});
             sum != sums.end() && sum->first.first == place; ++sum) {
            const std::uint32_t others = sum->first.second;
            if (groups == 0 || others == 0 || (groups & others) != 0) normal += sum->second;
        }
        return normal;
    }

    const std::string& name_;
    int depth_ = 0;
    double scale_ = 1.0;
    Object object_;  // at hand
    MeshFileContents contents_;
};

}  // namespace

MeshFileContents read3ds(std::string_view bytes, const std::string& name) {
    return Reader(name).run(bytes);
}

}  // namespace kaustik::scene
