// SPDX-License-Identifier: MIT
// Files of the mesh formats, made byte by byte.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/importers/mesh_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::scene::test {

template <class Integer>
std::string littleEndian(Integer value, std::size_t bytes = sizeof(Integer)) {
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i) {
        text += static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xffu);
    }
    return text;
}

inline std::string littleEndianFloats(const std::vector<float>& values) {
    std::string text;
    for (const float value : values)
        text += littleEndian(std::bit_cast<std::uint32_t>(value));
    return text;
}

// The corners of a tetrahedron with a right angle at the origin, edges 1, 2 and 3 along the axes;
// and its four faces, counter-clockwise seen from outside. Its volume is 1.
inline const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
inline const std::vector<int> kFaces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

inline std::string tetrahedronPly(const std::string& format) {
    std::string file = "ply\nformat " + format +
                       " 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                       "property float z\nelement face 4\n"
                       "property list uchar int vertex_indices\nend_header\n";
    const bool big = format == "binary_big_endian";
    if (format == "ascii") {
        return file + "0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    }
    const auto append = [&](std::string word) {
        file += big ? std::string(word.rbegin(), word.rend()) : word;
    };
    for (const float value : kCorners)
        append(littleEndianFloats({value}));
    for (std::size_t i = 0; i < kFaces.size(); ++i) {
        if (i % 3 == 0) file += '\x03';
        append(littleEndian(static_cast<std::uint32_t>(kFaces[i])));
    }
    return file;
}

inline std::string chunk3ds(std::uint16_t kind, const std::string& contents) {
    return littleEndian(kind) + littleEndian(static_cast<std::uint32_t>(contents.size() + 6)) +
           contents;
}

// `lastIndex` in place of the last corner of the last face; `aboutFaces` and `aboutMesh` are
// further chunks.
inline std::string tetrahedron3ds(int lastIndex = 3, const std::string& aboutFaces = "",
                                  const std::string& aboutMesh = "") {
    std::string faces = littleEndian(std::uint16_t{4});
    for (std::size_t i = 0; i < kFaces.size(); ++i) {
        faces += littleEndian(
            static_cast<std::uint16_t>(i + 1 == kFaces.size() ? lastIndex : kFaces[i]));
        if (i % 3 == 2) faces += littleEndian(std::uint16_t{7});  // flags
    }
    const std::string vertices = littleEndian(std::uint16_t{4}) + littleEndianFloats(kCorners);
    const std::string mesh = chunk3ds(
        0x4100, chunk3ds(0x4110, vertices) + chunk3ds(0x4120, faces + aboutFaces) + aboutMesh);
    const std::string object = chunk3ds(0x4000, std::string("tetra") + '\0' + mesh);
    return chunk3ds(0x4d4d,
                    chunk3ds(0x0002, littleEndian(std::uint32_t{3})) + chunk3ds(0x3d3d, object));
}

inline std::string gzip(const std::string& bytes) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::string zipped(bytes.size() + 200, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(zipped.data());
    stream.avail_out = static_cast<uInt>(zipped.size());
    deflate(&stream, Z_FINISH);
    zipped.resize(stream.total_out);
    deflateEnd(&stream);
    return zipped;
}

class MeshImport : public ::testing::Test {
  protected:
    ImportedMesh import(const std::string& name, std::string_view bytes) const {
        return readMeshFile(folder_.file(name, bytes));
    }
    // The message of the IoError that the import of these bytes ends with, or "".
    std::string errorOf(const std::string& name, std::string_view bytes) const {
        return kaustik::test::messageOf<IoError>([&] { (void)import(name, bytes); });
    }
    // Cut off after every byte: an error that names the file, or the whole mesh.
    void expectWholeOrErrorAtEveryLength(const std::string& name, const std::string& bytes,
                                         std::size_t optionalBytes) const {
        ASSERT_EQ(import(name, bytes).mesh.triangles.size(), 4u);
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            const auto path = folder_.file(name, std::string_view(bytes).substr(0, length));
            try {
                EXPECT_EQ(readMeshFile(path).mesh.triangles.size(), 4u)
                    << "cut after byte " << length;
                EXPECT_GE(length, bytes.size() - optionalBytes);
            } catch (const IoError& error) {
                EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos)
                    << error.what();
            }
        }
    }

    kaustik::test::TemporaryFolder folder_;
};

}  // namespace kaustik::scene::test
