// SPDX-License-Identifier: MIT
#include "framework/render/scene_bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/core/error.h"
#include "framework/transport/types.h"

namespace kaustik::render {
namespace {

using transport::BvhSource;
using transport::VertexData;

struct Triangles {
    std::vector<VertexData> corners;  // three each, local
    std::vector<BvhSource> sources;
};

void addObject(const scene::Scene& scene, std::uint32_t number, const glm::dmat4& worldToLocal,
               Triangles& triangles) {
    const scene::Object& object = scene.objects[number];
    const scene::Mesh& mesh = scene.meshes[object.mesh];
    // In double up to here, so that what is left is small.
    const glm::dmat4 toLocal =
        worldToLocal * object.toWorld * glm::translate(glm::dmat4(1.0), mesh.origin);
    const glm::dmat3 normalToLocal = glm::transpose(glm::inverse(glm::dmat3(toLocal)));
    std::uint32_t index = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (glm::length_t i = 0; i < 3; ++i) {
            const std::uint32_t v = triangle[i];
            triangles.corners.push_back(
                {glm::vec3(toLocal * glm::dvec4(mesh.positions[v], 1.0)), mesh.uvs[v].x,
                 glm::vec3(normalToLocal * glm::dvec3(mesh.normals[v])), mesh.uvs[v].y});
        }
        triangles.sources.push_back(
            {object.material + 1, number, index, mesh.heightField.has_value() ? 1u : 0u});
        ++index;
    }
}

void requireRoom(const Triangles& triangles) {
    GLint64 allowed = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &allowed);
    // Rays read it as a texture of the buffer's words by fours.
    GLint64 texels = 0;
    glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    allowed = std::min<GLint64>(allowed, texels * static_cast<GLint64>(sizeof(glm::vec4)));
    const std::size_t bytes = triangles.corners.size() * sizeof(VertexData);
    constexpr std::size_t kNumbers = std::size_t{1} << transport::kBvhLeafShift;
    if (bytes <= static_cast<std::size_t>(allowed) && triangles.sources.size() <= kNumbers) return;
    throw ConfigError(fmt::format(
        "A hierarchy over {} triangles takes {} MiB in one buffer, and this device allows {}: take "
        "trace=hierarchical, view=refraction and shadow=map.",
        triangles.sources.size(), bytes >> 20, allowed >> 20));
}

template <class T>
gl::Buffer upload(std::vector<T>& values, const char* label) {
    if (values.empty()) values.emplace_back();  // a block is never empty
    return gl::Buffer(values, label);
}

}  // namespace

SceneBvh::SceneBvh(const scene::Scene& scene) {
    const scene::Bounds world = sceneBounds(scene);
    if (!world.empty) center_ = 0.5 * (world.minimum + world.maximum);
    Triangles given;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        addObject(scene, i, worldToLocal(), given);
    std::vector<scene::BoxBounds> bounds(given.sources.size());
    requireRoom(given);
    scene::BoxBounds whole;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            bounds[i].include(given.corners[3 * i + corner].position);
        whole.include(bounds[i]);
    }
    const glm::vec3 farthest = glm::max(glm::abs(whole.lower), glm::abs(whole.upper));
    if (!bounds.empty()) roundingMeters_ = 1e-6f * std::max({farthest.x, farthest.y, farthest.z});
    scene::Bvh bvh = scene::buildBvh(bounds);
    nodeCount_ = bvh.nodes.size();
    triangleCount_ = bvh.order.size();
    levels_ = bvh.levels;
    stackSize_ = bvh.stackSize();
    Triangles ordered;
    ordered.corners.reserve(given.corners.size());
    ordered.sources.reserve(given.sources.size());
    for (const std::uint32_t i : bvh.order) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            ordered.corners.push_back(given.corners[3 * i + corner]);
        ordered.sources.push_back(given.sources[i]);
        isMoving_ = isMoving_ || given.sources[i].isMoving != 0;
    }
    nodes_ = upload(bvh.nodes, "hierarchy");
    corners_ = upload(ordered.corners, "triangles of the hierarchy");
    sources_ = upload(ordered.sources, "sources of the hierarchy");
}

glm::dmat4 SceneBvh::worldToLocal() const {
    return glm::translate(glm::dmat4(1.0), -center_);
}

std::size_t SceneBvh::bytes() const {
    return nodes_.bytes() + corners_.bytes() + sources_.bytes();
}

}  // namespace kaustik::render
