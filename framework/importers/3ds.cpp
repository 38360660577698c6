// SPDX-License-Identifier: MIT
// The chunks of a 3D Studio file: a 16-bit kind and a 32-bit length (which counts these six bytes),
// then data or further chunks. Only those on the way to the triangles are followed.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "framework/core/error.h"
#include "framework/importers/mesh_file_checks.h"

namespace kaustik::scene {
namespace {

constexpr std::size_t kChunkHeaderBytes = 6;
// Smoothing groups lie six deep; readers recurse.
constexpr int kDeepest = 16;
constexpr unsigned kMain = 0x4d4d;
constexpr unsigned kEditor = 0x3d3d;
constexpr unsigned kObject = 0x4000;
constexpr unsigned kTriangleMesh = 0x4100;
constexpr unsigned kVertices = 0x4110;
constexpr unsigned kFaces = 0x4120;
constexpr unsigned kSmoothingGroups = 0x4150;

class Checker {
  public:
    explicit Checker(const std::string& name) : name_(name) {}

    MeshFileContents run(std::string_view bytes) {
        if (bytes.size() < kChunkHeaderBytes || number16(bytes) != kMain) {
            fail("is no 3DS file: it does not begin with the chunk 4D4D");
        }
        const std::uint32_t length = number32(bytes.substr(2));
        if (length > bytes.size()) {
            fail(fmt::format("is cut off: {} bytes of {}", bytes.size(), length));
        }
        if (length < kChunkHeaderBytes) fail("is damaged: its main chunk is shorter than a header");
        children(bytes.substr(kChunkHeaderBytes, length - kChunkHeaderBytes));
        MeshFileContents contents;
        contents.triangles = triangleCount_;
        // Without smoothing groups a 3DS file says nothing about normals.
        contents.trustNormals = hasSmoothingGroups_;
        return contents;
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw IoError(fmt::format("{} {}. Fetch or export it again.", name_, problem));
    }

    static unsigned number16(std::string_view bytes) {
        return static_cast<unsigned char>(bytes[0]) |
               static_cast<unsigned>(static_cast<unsigned char>(bytes[1])) << 8;
    }
    static std::uint32_t number32(std::string_view bytes) {
        return number16(bytes) | static_cast<std::uint32_t>(number16(bytes.substr(2))) << 16;
    }

    // The chunks that fill `bytes`.
    void children(std::string_view bytes) {
        if (++depth_ > kDeepest) {
            fail(fmt::format("is damaged: its chunks are nested more than {} deep", kDeepest));
        }
        while (!bytes.empty()) {
            // Some writers pad the end of a chunk.
            if (bytes.size() < kChunkHeaderBytes) break;
            const unsigned kind = number16(bytes);
            const std::uint32_t length = number32(bytes.substr(2));
            if (length < kChunkHeaderBytes || length > bytes.size()) {
                fail(
                    fmt::format("is damaged: the chunk {:04X} does not fit into its parent", kind));
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
            case kObject: {
                const std::size_t nameEnd = bytes.find('\0');
                if (nameEnd == std::string_view::npos) fail("is damaged: an object has no name");
                children(bytes.substr(nameEnd + 1));
                break;
            }
            case kTriangleMesh:
                vertexCount_ = 0;
                indicesUsed_ = 0;
                children(bytes);
                if (indicesUsed_ > vertexCount_) {
                    fail(fmt::format("is damaged: a face uses vertex {}, but there are only {}",
                                     indicesUsed_ - 1, vertexCount_));
                }
                break;
            case kVertices:
                vertexCount_ = countOf(bytes, 12, "vertices");
                break;
            case kFaces:
                faces(bytes);
                break;
            case kSmoothingGroups:
                hasSmoothingGroups_ = true;
                break;
            default:
                break;
        }
    }

    // Three 16-bit vertices and 16 bits of flags a face; then chunks about the faces.
    void faces(std::string_view bytes) {
        constexpr std::size_t kFaceBytes = 8;
        const unsigned count = countOf(bytes, kFaceBytes, "faces");
        triangleCount_ += count;
        for (unsigned face = 0; face < count; ++face) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const unsigned index = number16(bytes.substr(2 + kFaceBytes * face + 2 * corner));
                indicesUsed_ = std::max(indicesUsed_, index + 1);
            }
        }
        children(bytes.substr(2 + kFaceBytes * count));
    }

    // The 16-bit count at the start of a chunk, whose items must fit into the chunk.
    unsigned countOf(std::string_view bytes, std::size_t itemBytes, const char* items) const {
        const unsigned count = bytes.size() < 2 ? 0 : number16(bytes);
        if (bytes.size() < 2 + itemBytes * count) {
            fail(fmt::format("is damaged: a chunk is too short for its {}", items));
        }
        return count;
    }

    const std::string& name_;
    int depth_ = 0;
    unsigned vertexCount_ = 0;  // of the current mesh
    unsigned indicesUsed_ = 0;  // one more than the largest index of the current mesh
    std::size_t triangleCount_ = 0;
    bool hasSmoothingGroups_ = false;
};

}  // namespace

MeshFileContents check3ds(std::string_view bytes, const std::string& name) {
    return Checker(name).run(bytes);
}

}  // namespace kaustik::scene
