// SPDX-License-Identifier: MIT
// glTF files for tests: a valid scene with one of everything as JSON, to be changed by each test.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/importers/gltf_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::scene::test {

using Json = nlohmann::json;

inline std::string word32(std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>((value >> (8 * i)) & 0xffu);
    return bytes;
}

inline std::string floatBytes(const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values)
        bytes += word32(std::bit_cast<std::uint32_t>(value));
    return bytes;
}

inline std::string shortBytes(const std::vector<std::uint16_t>& values) {
    std::string bytes;
    for (const auto value : values) {
        bytes += static_cast<char>(value & 0xffu);
        bytes += static_cast<char>(value >> 8);
    }
    return bytes;
}

// A tetrahedron with edges 1, 2 and 3 along the axes: 48 bytes of positions, 24 of indices.
inline std::string tetrahedronBytes() {
    return floatBytes({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}) +
           shortBytes({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

inline Json tetrahedronScene() {
    return Json::parse(R"({
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_transmission",
                           "KHR_materials_ior", "KHR_materials_volume"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "directional", "intensity": 683.0, "color": [1.0, 0.5, 0.0]}]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [
            {"name": "glass", "mesh": 0},
            {"camera": 0, "translation": [0, 0, 10]},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.125}}],
        "meshes": [{"name": "tetra", "primitives": [
            {"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "crown",
            "pbrMetallicRoughness": {"roughnessFactor": 0.0, "metallicFactor": 0.0},
            "extensions": {
                "KHR_materials_transmission": {"transmissionFactor": 1.0},
                "KHR_materials_ior": {"ior": 1.5},
                "KHR_materials_volume": {"thicknessFactor": 1.0}}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "buffers": [{"byteLength": 72}]
    })");
}

inline std::string glb(const Json& document, const std::string& binary) {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string padded = binary;
    padded.resize((padded.size() + 3) / 4 * 4, '\0');
    const auto size = [](std::size_t n) { return word32(static_cast<std::uint32_t>(n)); };
    std::string file = "glTF" + word32(2) + size(12 + 8 + text.size() + 8 + padded.size());
    file += size(text.size()) + "JSON" + text;
    file += size(padded.size()) + std::string("BIN\0", 4) + padded;
    return file;
}

class GltfImport : public ::testing::Test {
  protected:
    Scene import(const Json& document, const std::string& binary = tetrahedronBytes()) const {
        return readGltfFile(folder_.file("scene.glb", glb(document, binary)));
    }
    // The scene with the value at a JSON pointer changed.
    static Json changed(const std::string& pointer, const Json& value) {
        Json document = tetrahedronScene();
        document[Json::json_pointer(pointer)] = value;
        return document;
    }
    // The message of the error of that kind, or "".
    template <class E>
    std::string errorOf(const Json& document,
                        const std::string& binary = tetrahedronBytes()) const {
        return kaustik::test::messageOf<E>([&] { (void)import(document, binary); });
    }
    // All warnings, one a line.
    static std::string warnings(const Scene& scene) {
        std::string all;
        for (const std::string& warning : scene.warnings)
            all += warning + "\n";
        return all;
    }

    kaustik::test::TemporaryFolder folder_;
};

}  // namespace kaustik::scene::test
