// SPDX-License-Identifier: MIT
// Mitsuba's .serialized: meshes one after another, each a small head and a zlib stream (RFC 1950),
// and at the end of the file the places where they begin.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/importers/byte_reader.h"
#include "framework/importers/foreign_file.h"
#include "framework/importers/triangle_soup.h"

namespace kaustik::scene {
namespace {

constexpr std::uint16_t kMagic = 0x041C;
constexpr std::size_t kHeadBytes = 4;
enum MeshFlag : std::uint32_t {
    hasNormals = 0x0001,
    hasUvs = 0x0002,
    hasColors = 0x0008,
    isDoublePrecision = 0x2000
};

// The stream at the beginning of `bytes`; what follows it is not looked at.
std::string inflateStream(std::string_view bytes, const std::string& name) {
    z_stream stream{};
    if (::inflateInit(&stream) != Z_OK) throw IoError(fmt::format("{}: out of memory.", name));
    struct End {
        z_stream& stream;
        ~End() { ::inflateEnd(&stream); }
    } const end{stream};
    std::string contents;
    std::vector<char> block(std::size_t{1} << 18);
    int status = Z_OK;
    while (status == Z_OK) {
        const auto available =
            std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
        stream.avail_in = static_cast<uInt>(available);
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        status = ::inflate(&stream, Z_NO_FLUSH);
        bytes.remove_prefix(available - stream.avail_in);
        contents.append(block.data(), block.size() - stream.avail_out);
    }
    if (status != Z_STREAM_END)
        throw IoError(fmt::format("{} is cut off or damaged. Export it again.", name));
    return contents;
}

// Where the mesh begins.
std::size_t placeOfMesh(std::string_view bytes, std::size_t shape, const std::string& name) {
    ByteReader head(bytes, name);
    if (head.value<std::uint16_t>() != kMagic)
        throw IoError(fmt::format("{} is no .serialized file of Mitsuba.", name));
    const auto version = head.value<std::uint16_t>();
    if (version != 3 && version != 4)
        throw IoError(fmt::format("{}: version {} is not read, only 3 and 4.", name, version));
    if (bytes.size() < 2 * kHeadBytes) throw IoError(fmt::format("{} is cut off.", name));
    const auto count =
        ByteReader(bytes.substr(bytes.size() - kHeadBytes), name).value<std::uint32_t>();
    const std::size_t entry = version == 4 ? 8 : 4;
    if (count > (bytes.size() - kHeadBytes) / entry)
        throw IoError(fmt::format("{} is cut off or damaged. Export it again.", name));
    if (shape >= count)
        throw ConfigError(fmt::format("{} has {} meshes; there is none with the shape_index {}.",
                                      name, count, shape));
    ByteReader table(bytes.substr(bytes.size() - kHeadBytes - entry * (count - shape)), name);
    const std::uint64_t place =
        version == 4 ? table.value<std::uint64_t>() : table.value<std::uint32_t>();
    if (place > bytes.size() - kHeadBytes)
        throw IoError(fmt::format("{} is cut off or damaged. Export it again.", name));
    return static_cast<std::size_t>(place);
}

class MeshReader {
  public:
    MeshReader(std::string_view bytes, const std::string& name) : reader_(bytes, name) {}

    TriangleSoup read(bool isNamed, const std::string& name) {
        const auto flags = reader_.value<std::uint32_t>();
        isDouble_ = (flags & isDoublePrecision) != 0;
        if (isNamed) static_cast<void>(reader_.text());
        const auto vertexCount = reader_.value<std::uint64_t>();
        const auto triangleCount = reader_.value<std::uint64_t>();
        TriangleSoup soup;
        for (const auto& position : tuples<3>(vertexCount))
            soup.positions.emplace_back(position[0], position[1], position[2]);
        soup.normals.assign(soup.positions.size(), glm::vec3(0.0f));
        soup.uvs.assign(soup.positions.size(), glm::vec2(0.0f));
        if ((flags & hasNormals) != 0) {
            const auto normals = tuples<3>(vertexCount);
            for (std::size_t i = 0; i < normals.size(); ++i)
                soup.normals[i] = glm::vec3(normals[i][0], normals[i][1], normals[i][2]);
        }
        if ((flags & hasUvs) != 0) {
            const auto uvs = tuples<2>(vertexCount);
            for (std::size_t i = 0; i < uvs.size(); ++i)
                soup.uvs[i] = glm::vec2(uvs[i][0], uvs[i][1]);
        }
        if ((flags & hasColors) != 0) static_cast<void>(tuples<3>(vertexCount));
        using Corners = std::array<std::uint32_t, 3>;
        for (const Corners& corners : reader_.values<Corners>(triangleCount)) {
            if (*std::max_element(corners.begin(), corners.end()) >= soup.positions.size())
                throw IoError(fmt::format("{}: a triangle uses a vertex that is not there.", name));
            soup.triangles.emplace_back(corners[0], corners[1], corners[2]);
        }
        return soup;
    }

  private:
    template <std::size_t size>
    std::vector<std::array<double, size>> tuples(std::uint64_t count) {
        if (isDouble_) return reader_.values<std::array<double, size>>(count);
        std::vector<std::array<double, size>> result;
        for (const auto& single : reader_.values<std::array<float, size>>(count)) {
            auto& tuple = result.emplace_back();
            std::copy(single.begin(), single.end(), tuple.begin());
        }
        return result;
    }

    ByteReader reader_;
    bool isDouble_ = false;
};

}  // namespace

ImportedMesh readSerialized(std::string_view bytes, std::size_t shape, const std::string& name) {
    const std::string_view mesh = bytes.substr(placeOfMesh(bytes, shape, name));
    ByteReader head(mesh, name);
    if (head.value<std::uint16_t>() != kMagic)
        throw IoError(fmt::format("{} is cut off or damaged. Export it again.", name));
    const bool isNamed = head.value<std::uint16_t>() == 4;
    const std::string contents = inflateStream(mesh.substr(kHeadBytes), name);
    return buildForeignMesh(MeshReader(contents, name).read(isNamed, name), name);
}

}  // namespace kaustik::scene
