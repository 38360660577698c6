// SPDX-License-Identifier: MIT
// The scene on the device: one vertex and one index buffer for all static meshes, materials, images
// and lights. Vertices of height fields are not here; a node makes them each frame.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "framework/gl/executor.h"
#include "framework/render/scene_bvh.h"
#include "framework/render/view.h"
#include "framework/scene/scene.h"
#include "framework/transport/geometry.h"

namespace kaustik::render {

// The surfaces that a pass draws.
enum class DrawSet { all, receivers, mirrors, dielectrics, specular, nonDielectrics };

// Placed meshes as one view sees them.
struct ViewInstances {
    gl::Buffer instances;  // InstanceData, by object
};

class GpuScene {
  public:
    // Uploads everything that does not depend on the view. Images are decoded here: throws IoError.
    explicit GpuScene(const scene::Scene& scene);

    [[nodiscard]] ViewInstances makeInstances(const glm::dmat4& worldToView) const;
    [[nodiscard]] const scene::Scene& scene() const { return scene_; }

    // Issues `command` for the static meshes and the height fields of `set`. The vertex shader
    // includes include/surfaces/scene_vertex.glsl. `commands`: other indirect commands than the
    // scene's own, laid out the same, or null.
    void draw(gl::Command& command, const gl::PassContext& context, const Geometry& geometry,
              const ViewInstances& view, DrawSet set, const gl::Buffer* commands = nullptr,
              std::size_t firstCommand = 0) const;

    // Issues `command` for one command of the scene's commandCount(), which is one object.
    void drawOne(gl::Command& command, const gl::PassContext& context, const Geometry& geometry,
                 const ViewInstances& view, std::size_t index, const gl::Buffer* commands = nullptr,
                 std::size_t firstCommand = 0) const;
    [[nodiscard]] std::size_t objectOf(std::size_t command) const { return order_[command]; }

    // Binds the triangles of all objects for shaders that include
    // include/surfaces/scene_triangle.glsl. The pass reads `geometry`.
    void bindTriangles(gl::Command& command, const Geometry& geometry) const;

    [[nodiscard]] const gl::Buffer& materials() const { return materials_; }
    [[nodiscard]] const gl::Texture& images() const { return images_; }
    [[nodiscard]] const gl::Buffer& commands() const { return commands_; }
    [[nodiscard]] std::size_t commandCount() const { return commandCount_; }
    [[nodiscard]] std::size_t heightFieldVertexCount() const { return heightFieldVertexCount_; }
    // Materials, images and lights that every surface shader reads.

    // One height field: where its vertices lie, in the order of the scene's objects' meshes.
    struct HeightFieldRange {
        std::size_t mesh;
        std::size_t firstVertex;
    };
    [[nodiscard]] const std::vector<HeightFieldRange>& heightFields() const {
        return heightFields_;
    }
    [[nodiscard]] std::size_t bytes() const;
    // Built when it is first asked for.
    [[nodiscard]] const SceneBvh& bvh() const;

  private:
    // Commands are sorted by kind; a set is a run of them.
    struct Group {
        std::size_t kindBegin[4] = {0, 0, 0, 0};  // receivers, mirrors, dielectrics, end
    };
    void uploadMeshes();
    void uploadMaterials();
    void uploadImages();
    [[nodiscard]] static std::pair<std::size_t, std::size_t> runOf(const Group& group, DrawSet set);

    const scene::Scene& scene_;
    gl::Buffer vertices_;
    gl::Buffer indices_;
    gl::Buffer commands_;
    gl::Buffer objectIndices_;
    gl::Buffer materials_;
    gl::Texture images_;
    gl::VertexArrayObject staticVertexArray_;
    gl::VertexArrayObject heightFieldVertexArray_;
    std::vector<HeightFieldRange> heightFields_;
    std::size_t heightFieldVertexCount_ = 0;
    std::size_t commandCount_ = 0;
    std::vector<GLuint> order_;  // objects by command
    // For each object: how many triangles are drawn before it, its first index, and its first
    // vertex as InstanceData::material has it.
    std::vector<glm::uvec3> firsts_;
    Group staticGroup_;
    Group heightFieldGroup_;
    mutable std::unique_ptr<SceneBvh> bvh_;
};

}  // namespace kaustik::render
