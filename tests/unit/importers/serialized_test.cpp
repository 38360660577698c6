// SPDX-License-Identifier: MIT
// Meshes in Mitsuba's own files, made byte by byte.
#include <zlib.h>

#include "tests/unit/importers/foreign_fixture.h"
#include "tests/unit/importers/mesh_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::HasSubstr;

class Serialized : public ForeignImport {
  protected:
    Serialized() : ForeignImport("scene.xml") {}
};

std::string zipped(const std::string& bytes) {
    std::string result(::compressBound(bytes.size()), '\0');
    uLongf size = result.size();
    ::compress(reinterpret_cast<Bytef*>(result.data()), &size,
               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    result.resize(size);
    return result;
}

// Two meshes, of which the second is the tetrahedron.
std::string serialized(std::uint16_t version, bool isDouble) {
    std::string tetrahedron = littleEndian(std::uint32_t{isDouble ? 0x2000u : 0x1000u});
    if (version == 4) tetrahedron += std::string("tetra\0", 6);
    tetrahedron += littleEndian(std::uint64_t{4}) + littleEndian(std::uint64_t{4});
    for (const float corner : kCorners) {
        tetrahedron += isDouble ? littleEndian(std::bit_cast<std::uint64_t>(double{corner}))
                                : littleEndianFloats({corner});
    }
    for (const int corner : kFaces)
        tetrahedron += littleEndian(static_cast<std::uint32_t>(corner));
    const std::string head = littleEndian(std::uint16_t{0x041C}) + littleEndian(version);
    const std::string first = head + zipped("nothing of use");
    const std::string all = first + head + zipped(tetrahedron);
    const std::size_t entry = version == 4 ? 8 : 4;
    return all + littleEndian(std::uint64_t{0}, entry) +
           littleEndian(std::uint64_t{first.size()}, entry) + littleEndian(std::uint32_t{2});
}

TEST_F(Serialized, MeshesAreReadByTheirIndexOrRefused) {
    const auto text = [](const std::string& index) {
        return "<scene><shape type=\"serialized\"><string name=\"filename\" "
               "value=\"m.serialized\"/><integer name=\"shapeIndex\" value=\"" +
               index + "\"/></shape></scene>";
    };
    for (const std::uint16_t version : {std::uint16_t{3}, std::uint16_t{4}}) {
        for (const bool isDouble : {false, true}) {
            const std::string bytes = serialized(version, isDouble);
            static_cast<void>(folder.file("m.serialized", bytes));
            const ForeignScene scene = read(text("1"));
            EXPECT_EQ(scene.shapes.at(0).mesh.triangles.size(), 4u);
            EXPECT_TRUE(scene.shapes.at(0).mesh.closed);
            EXPECT_THAT(ioErrorOf(text("0")), HasSubstr("m.serialized"));
            EXPECT_THAT(errorOf(text("2")), HasSubstr("shape_index 2"));
            for (std::size_t size = 0; size < bytes.size(); size += 7) {
                static_cast<void>(folder.file("m.serialized", bytes.substr(0, size)));
                EXPECT_NE(messageOf<Error>([&] { static_cast<void>(read(text("1"))); }), "")
                    << size;
            }
        }
    }
}

}  // namespace
}  // namespace kaustik::scene::test
