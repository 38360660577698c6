// SPDX-License-Identifier: MIT
#include "framework/importers/gltf_meshes.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <utility>

#include "framework/core/error.h"
#include "framework/importers/triangle_soup.h"

namespace kaustik::scene {
namespace {

// The bytes of an accessor's elements, found to lie inside their buffer.
struct ElementBytes {
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
    std::size_t count = 0;
};

class PrimitiveReader {
  public:
    PrimitiveReader(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                    std::string where)
        : model_(model), primitive_(primitive), where_(std::move(where)) {}

    TriangleSoup read(int uvSet) {
        TriangleSoup soup;
        const std::optional<ElementBytes> positions = attribute("POSITION", 3);
        if (!positions) fail("attributes.POSITION", "is missing");
        const std::size_t count = positions->count;
        for (std::size_t i = 0; i < count; ++i)
            soup.positions.emplace_back(vector<3>(*positions, i));
        soup.normals.assign(count, glm::vec3(0.0f));
        if (const auto normals = attribute("NORMAL", 3)) {
            requireCount("NORMAL", *normals, count);
            for (std::size_t i = 0; i < count; ++i)
                soup.normals[i] = vector<3>(*normals, i);
        }
        readUvs(soup, fmt::format("TEXCOORD_{}", uvSet));
        triangulate(soup, readIndices(count));
        return soup;
    }

  private:
    [[noreturn]] void fail(const std::string& field, const std::string& problem) const {
        throw IoError(fmt::format("{}.{} {}. Export the file again.", where_, field, problem));
    }

    std::optional<int> attributeIndex(const std::string& name) const {
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end()) return std::nullopt;
        return found->second;
    }

    // A 32-bit float attribute, or none.
    std::optional<ElementBytes> attribute(const std::string& name, int components) const {
        const std::optional<int> index = attributeIndex(name);
        if (!index) return std::nullopt;
        const std::string field = "attributes." + name;
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(*index)];
        if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            fail(field,
                 fmt::format("is not made of 32-bit floats (accessors[{}].componentType)", *index));
        }
        return elements(*index, components, field);
    }

    ElementBytes elements(int accessorIndex, int components, const std::string& field) const {
        const tinygltf::Accessor& accessor =
            model_.accessors[static_cast<std::size_t>(accessorIndex)];
        const std::string path = fmt::format("(accessors[{}])", accessorIndex);
        if (accessor.sparse.isSparse || accessor.bufferView < 0) {
            fail(field, fmt::format("is a sparse accessor {}, which cannot be read", path));
        }
        if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
            components) {
            fail(field, fmt::format("does not have {} components {}", components, path));
        }
        const tinygltf::BufferView& view =
            model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        const tinygltf::Buffer& buffer = model_.buffers[static_cast<std::size_t>(view.buffer)];
        const int componentBytes =
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
        if (componentBytes < 1) fail(field, fmt::format("has an unknown component type {}", path));
        const auto elementBytes = static_cast<std::size_t>(componentBytes * components);
        const std::size_t stride = view.byteStride == 0 ? elementBytes : view.byteStride;
        // Offsets, lengths and counts are below 2^32 and strides at most 252: no sum overflows.
        const std::size_t end = accessor.byteOffset + stride * (accessor.count - 1) + elementBytes;
        if (end > view.byteLength || view.byteOffset + view.byteLength > buffer.data.size()) {
            fail(field, fmt::format("is out of range: {} ends at byte {} of bufferViews[{}], which "
                                    "has {}",
                                    path, end, accessor.bufferView, view.byteLength));
        }
        return {buffer.data.data() + view.byteOffset + accessor.byteOffset, stride, accessor.count};
    }

    void requireCount(const std::string& name, const ElementBytes& bytes, std::size_t count) const {
        if (bytes.count == count) return;
        fail("attributes." + name,
             fmt::format("has {} elements, but POSITION has {}", bytes.count, count));
    }

    template <int size>
    static glm::vec<size, float> vector(const ElementBytes& bytes, std::size_t index) {
        glm::vec<size, float> value(0.0f);
        std::memcpy(&value[0], bytes.first + index * bytes.stride, size * sizeof(float));
        return value;
    }

    template <class Integer>
    static Integer integer(const ElementBytes& bytes, std::size_t index, std::size_t component) {
        Integer value{};
        std::memcpy(&value, bytes.first + index * bytes.stride + component * sizeof(Integer),
                    sizeof(Integer));
        return value;
    }

    // Floats, or unsigned integers for [0,1]; v is turned, since glTF counts it from the image's
    // top.
    void readUvs(TriangleSoup& soup, const std::string& name) const {
        soup.uvs.assign(soup.positions.size(), glm::vec2(0.0f));
        const std::optional<int> index = attributeIndex(name);
        if (!index) return;
        const int type = model_.accessors[static_cast<std::size_t>(*index)].componentType;
        const ElementBytes bytes = elements(*index, 2, "attributes." + name);
        requireCount(name, bytes, soup.uvs.size());
        for (std::size_t i = 0; i < soup.uvs.size(); ++i) {
            if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
                soup.uvs[i] = vector<2>(bytes, i);
                continue;
            }
            for (glm::length_t c = 0; c < 2; ++c) {
                const auto component = static_cast<std::size_t>(c);
                if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
                    soup.uvs[i][c] =
                        static_cast<float>(integer<std::uint8_t>(bytes, i, component)) / 255.0f;
                } else if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
                    soup.uvs[i][c] =
                        static_cast<float>(integer<std::uint16_t>(bytes, i, component)) / 65535.0f;
                } else {
                    fail("attributes." + name, "has a component type that glTF does not allow");
                }
            }
        }
        for (glm::vec2& uv : soup.uvs)
            uv.y = 1.0f - uv.y;
    }

    std::vector<std::uint32_t> readIndices(std::size_t vertexCount) const {
        std::vector<std::uint32_t> indices;
        if (primitive_.indices < 0) {
            for (std::size_t i = 0; i < vertexCount; ++i) {
                indices.push_back(static_cast<std::uint32_t>(i));
            }
            return indices;
        }
        const int type =
            model_.accessors[static_cast<std::size_t>(primitive_.indices)].componentType;
        const ElementBytes bytes = elements(primitive_.indices, 1, "indices");
        indices.reserve(bytes.count);
        for (std::size_t i = 0; i < bytes.count; ++i) {
            std::uint32_t index = 0;
            if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
                index = integer<std::uint8_t>(bytes, i, 0);
            } else if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
                index = integer<std::uint16_t>(bytes, i, 0);
            } else if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
                index = integer<std::uint32_t>(bytes, i, 0);
            } else {
                fail("indices", "are not unsigned integers");
            }
            if (index >= vertexCount) {
                fail("indices", fmt::format("has vertex {} at place {}, but there are only {}",
                                            index, i, vertexCount));
            }
            indices.push_back(index);
        }
        return indices;
    }

    // glTF 2.0, section 3.7.2.1: the corners of each triangle of a list, strip or fan.
    void triangulate(TriangleSoup& soup, const std::vector<std::uint32_t>& indices) const {
        const std::size_t count = indices.size();
        const bool isList = primitive_.mode == TINYGLTF_MODE_TRIANGLES;
        if (count < 3 || (isList && count % 3 != 0)) {
            fail(primitive_.indices < 0 ? "attributes.POSITION" : "indices",
                 fmt::format("has {} entries, which make no whole triangles", count));
        }
        if (isList) {
            for (std::size_t i = 0; i < count; i += 3) {
                soup.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
            }
            return;
        }
        for (std::size_t i = 0; i + 2 < count; ++i) {
            if (primitive_.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                soup.triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
            } else {
                soup.triangles.emplace_back(indices[i], indices[i + 1 + i % 2],
                                            indices[i + 2 - i % 2]);
            }
        }
    }

    const tinygltf::Model& model_;
    const tinygltf::Primitive& primitive_;
    std::string where_;
};

void mirror(TriangleSoup& soup) {
    for (glm::dvec3& position : soup.positions)
        position.x = -position.x;
    for (glm::vec3& normal : soup.normals)
        normal.x = -normal.x;
    for (glm::uvec3& triangle : soup.triangles)
        std::swap(triangle.y, triangle.z);
}

}  // namespace

std::optional<Mesh> importGltfPrimitive(const tinygltf::Model& model, std::size_t meshIndex,
                                        std::size_t primitiveIndex, int uvSet, bool mirrored,
                                        const std::string& file,
                                        std::vector<std::string>& warnings) {
    const tinygltf::Mesh& mesh = model.meshes[meshIndex];
    const tinygltf::Primitive& primitive = mesh.primitives[primitiveIndex];
    const std::string where =
        fmt::format("{}: meshes[{}].primitives[{}]", file, meshIndex, primitiveIndex);
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        warnings.push_back(fmt::format("{} holds points or lines and was left out.", where));
        return std::nullopt;
    }
    if (!primitive.targets.empty()) {
        warnings.push_back(fmt::format("{} has morph targets, which were left out.", where));
    }
    TriangleSoup soup = PrimitiveReader(model, primitive, where).read(uvSet);
    if (mirrored) mirror(soup);
    std::string name = mesh.name.empty() ? fmt::format("mesh {}", meshIndex) : mesh.name;
    if (mesh.primitives.size() > 1) name += fmt::format(" ({})", primitiveIndex);
    BuiltMesh built = buildMesh(soup, name, where);
    for (const std::string& oddity : built.oddities())
        warnings.push_back(fmt::format("{}: {}.", where, oddity));
    return std::move(built.mesh);
}

}  // namespace kaustik::scene
