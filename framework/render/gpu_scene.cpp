// SPDX-License-Identifier: MIT
#include "framework/render/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/dielectrics.h"
#include "framework/scene/light_paths.h"
#include "framework/scene/texture.h"

namespace kaustik::render {
namespace {

using transport::InstanceData;
using transport::MaterialData;
using transport::VertexData;

constexpr int kMaxImageSide = 1024;

struct DrawCommand {
    GLuint indexCount;
    GLuint instanceCount;
    GLuint firstIndex;
    GLint baseVertex;
    GLuint baseInstance;  // selects the object, through an attribute with a divisor
};

// Receivers first, then mirrors, then dielectrics.
std::size_t drawOrder(scene::MaterialKind kind) {
    switch (kind) {
        case scene::MaterialKind::lambertian:
        case scene::MaterialKind::glossy:
            return 0;
        case scene::MaterialKind::mirror:
            return 1;
        case scene::MaterialKind::dielectric:
            return 2;
    }
    return 0;
}

// Beyond its edges an image goes on with itself, or with its outermost texels where it is clamped.
struct Edges {
    bool clampsColumns = false;
    bool clampsRows = false;
};

// What an image shows decides: a spot's ends at its edge, and above the environment there
// is not what lies below.
Edges edgesOf(const scene::Scene& scene, int image) {
    const bool isProjected =
        std::any_of(scene.lights.begin(), scene.lights.end(),
                    [&](const scene::Light& light) { return light.image == image; });
    return {isProjected, isProjected || scene.environmentImage == image};
}

// `image` as RGBA, resampled bilinearly to side x side, bottom row first.
std::vector<float> resample(const Image& image, int side, const Edges& edges) {
    std::vector<float> texels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4,
                              1.0f);
    const auto inside = [](int i, int n, bool clamps) {
        return clamps ? std::clamp(i, 0, n - 1) : (i % n + n) % n;
    };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(side) *
                                static_cast<float>(image.width) -
                            0.5f;
            const float v = (static_cast<float>(side - 1 - y) + 0.5f) / static_cast<float>(side) *
                                static_cast<float>(image.height) -
                            0.5f;
            const int x0 = static_cast<int>(std::floor(u));
            const int y0 = static_cast<int>(std::floor(v));
            const float fx = u - static_cast<float>(x0);
            const float fy = v - static_cast<float>(y0);
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int i, int j) {
                    return image.at(inside(i, image.width, edges.clampsColumns),
                                    inside(j, image.height, edges.clampsRows), c);
                };
                const float low = at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx;
                const float high = at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx;
                texels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                        static_cast<std::size_t>(x)) *
                           4 +
                       static_cast<std::size_t>(c)] = low * (1 - fy) + high * fy;
            }
        }
    }
    return texels;
}

}  // namespace

GpuScene::GpuScene(const scene::Scene& scene) : scene_(scene) {
    uploadMeshes();
    uploadMaterials();
    uploadImages();
}

void GpuScene::uploadMeshes() {
    std::vector<VertexData> vertices;
    std::vector<GLuint> indices;
    struct MeshRange {
        std::size_t firstVertex;
        std::size_t firstIndex;
    };
    std::vector<MeshRange> ranges;
    for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
        const scene::Mesh& mesh = scene_.meshes[m];
        const bool isHeightField = mesh.heightField.has_value();
        ranges.push_back(
            {isHeightField ? heightFieldVertexCount_ : vertices.size(), indices.size()});
        if (isHeightField) {
            heightFields_.push_back({m, heightFieldVertexCount_});
            heightFieldVertexCount_ += mesh.positions.size();
        } else {
            for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
                vertices.push_back(
                    {mesh.positions[v], mesh.uvs[v].x, mesh.normals[v], mesh.uvs[v].y});
            }
        }
        for (const glm::uvec3& t : mesh.triangles)
            indices.insert(indices.end(), {t.x, t.y, t.z});
    }

    std::vector<GLuint> order(scene_.objects.size());
    for (GLuint i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto orderOf = [&](GLuint object) {
        const scene::Object& o = scene_.objects[object];
        const bool isHeightField = scene_.meshes[o.mesh].heightField.has_value();
        return (isHeightField ? 3u : 0u) + drawOrder(scene_.materials[o.material].kind);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](GLuint a, GLuint b) { return orderOf(a) < orderOf(b); });
    std::vector<DrawCommand> commands;
    firsts_.resize(order.size());
    GLuint triangles = 0;
    for (const GLuint object : order) {
        const std::size_t mesh = scene_.objects[object].mesh;
        const bool isHeightField = scene_.meshes[mesh].heightField.has_value();
        firsts_[object] = {
            triangles, static_cast<GLuint>(ranges[mesh].firstIndex),
            2 * static_cast<GLuint>(ranges[mesh].firstVertex) + (isHeightField ? 1u : 0u)};
        triangles += static_cast<GLuint>(scene_.meshes[mesh].triangles.size());
        commands.push_back({static_cast<GLuint>(3 * scene_.meshes[mesh].triangles.size()), 1,
                            static_cast<GLuint>(ranges[mesh].firstIndex),
                            static_cast<GLint>(ranges[mesh].firstVertex), object});
    }
    commandCount_ = commands.size();
    order_ = order;
    const auto firstOfOrder = [&](std::size_t wanted) {
        return static_cast<std::size_t>(
            std::find_if(order.begin(), order.end(),
                         [&](GLuint object) { return orderOf(object) >= wanted; }) -
            order.begin());
    };
    for (std::size_t kind = 0; kind < 4; ++kind) {
        staticGroup_.kindBegin[kind] = firstOfOrder(kind);
        heightFieldGroup_.kindBegin[kind] = firstOfOrder(3 + kind);
    }

    if (vertices.empty()) vertices.push_back({});  // blocks are never empty
    if (indices.empty()) indices.push_back(0);
    vertices_ = gl::Buffer(vertices, "scene vertices");
    indices_ = gl::Buffer(indices, "scene indices");
    commands_ = gl::Buffer(commands, "scene commands");
    std::vector<GLuint> iota(std::max<std::size_t>(scene_.objects.size(), 1));
    for (GLuint i = 0; i < iota.size(); ++i)
        iota[i] = i;
    objectIndices_ = gl::Buffer(iota, "object indices");

    for (gl::VertexArrayObject* array : {&staticVertexArray_, &heightFieldVertexArray_}) {
        *array = gl::makeVertexArray();
        const GLuint id = array->id();
        const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
            glEnableVertexArrayAttrib(id, index);
            glVertexArrayAttribFormat(id, index, size, GL_FLOAT, GL_FALSE,
                                      static_cast<GLuint>(offset));
            glVertexArrayAttribBinding(id, index, 0);
        };
        attribute(0, 3, offsetof(VertexData, position));
        attribute(1, 3, offsetof(VertexData, normal));
        attribute(2, 1, offsetof(VertexData, u));
        attribute(3, 1, offsetof(VertexData, v));
        glEnableVertexArrayAttrib(id, 4);
        glVertexArrayAttribIFormat(id, 4, 1, GL_UNSIGNED_INT, 0);
        glVertexArrayAttribBinding(id, 4, 1);
        glVertexArrayVertexBuffer(id, 1, objectIndices_.id(), 0, sizeof(GLuint));
        glVertexArrayBindingDivisor(id, 1, 1);
        glVertexArrayElementBuffer(id, indices_.id());
    }
    glVertexArrayVertexBuffer(staticVertexArray_.id(), 0, vertices_.id(), 0, sizeof(VertexData));
}

void GpuScene::uploadMaterials() {
    std::vector<MaterialData> materials;
    const scene::Dielectrics dielectrics = numberDielectrics(scene_);
    const auto mediumOf = [&](std::size_t m) {
        const bool isDielectric = m < dielectrics.numberOf.size();
        const bool isNumber = m < dielectrics.materialOf.size();
        return glm::vec4(isDielectric ? dielectrics.numberOf[m] : 0u,
                         isNumber ? dielectrics.materialOf[m] + 1u : 0u, dielectrics.base,
                         dielectrics.end);
    };
    for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
        const scene::Material& material = scene_.materials[m];
        MaterialData data{};
        data.albedo = glm::vec4(material.albedo, static_cast<float>(material.kind));
        data.patternAlbedo =
            glm::vec4(material.patternAlbedo, static_cast<float>(material.pattern));
        data.absorption = glm::vec4(material.absorptionPerMeter, material.ior);
        data.uv = glm::vec4(material.uvScale, static_cast<float>(material.image),
                            isOpen(scene_, m) ? 1.0f : 0.0f);
        data.specular = glm::vec4(material.specular, material.exponent);
        data.emission = glm::vec4(material.emission, 0.0f);
        data.normalMap = {static_cast<float>(material.normalMap), material.normalScale, 0.0f, 0.0f};
        data.dispersion = material.dispersion;
        data.medium = mediumOf(m);
        materials.push_back(data);
    }
    MaterialData none{};  // an empty scene still binds a block
    none.medium = mediumOf(materials.size());
    materials.push_back(none);
    materials_ = gl::Buffer(materials, "materials");
}

void GpuScene::uploadImages() {
    int side = 1;
    std::vector<Image> images;
    for (const scene::TextureImage& texture : scene_.images) {
        images.push_back(scene::decodeTexture(texture));
        side = std::max({side, images.back().width, images.back().height});
    }
    side = std::min(side, kMaxImageSide);
    const int layers = std::max(static_cast<int>(images.size()), 1);
    images_ = gl::Texture({side, side, graph::Format::rgba16f, layers}, "scene images", true);
    for (std::size_t i = 0; i < images.size(); ++i) {
        const int index = static_cast<int>(i);
        images_.upload(index, resample(images[i], side, edgesOf(scene_, index)));
    }
    if (!images.empty()) images_.generateMipmaps();
}

ViewInstances GpuScene::makeInstances(const glm::dmat4& worldToView) const {
    std::vector<InstanceData> instances;
    for (const scene::Object& object : scene_.objects) {
        // The mesh's own origin joins here, in double, so that a scene far from the world's origin
        // loses nothing: what is left is small.
        const glm::dmat4 modelToView =
            worldToView * object.toWorld *
            glm::translate(glm::dmat4(1.0), scene_.meshes[object.mesh].origin);
        InstanceData data{};
        data.modelToView = glm::mat4(modelToView);
        data.normalToView =
            glm::mat4(glm::dmat4(glm::transpose(glm::inverse(glm::dmat3(modelToView)))));
        data.material = glm::uvec4(object.material, firsts_[instances.size()]);
        instances.push_back(data);
    }
    instances.push_back({});
    return {gl::Buffer(instances, "instances")};
}

std::pair<std::size_t, std::size_t> GpuScene::runOf(const Group& group, DrawSet set) {
    const auto run = [&](std::size_t first, std::size_t end) {
        return std::pair(group.kindBegin[first], group.kindBegin[end] - group.kindBegin[first]);
    };
    switch (set) {
        case DrawSet::all:
            return run(0, 3);
        case DrawSet::receivers:
            return run(0, 1);
        case DrawSet::mirrors:
            return run(1, 2);
        case DrawSet::specular:
            return run(1, 3);
        case DrawSet::dielectrics:
            return run(2, 3);
        case DrawSet::nonDielectrics:
            return run(0, 2);
    }
    return {0, 0};
}

void GpuScene::draw(gl::Command& command, const gl::PassContext& context, const Geometry& geometry,
                    const ViewInstances& view, DrawSet set, const gl::Buffer* commands,
                    std::size_t firstCommand) const {
    command.storage("Instances", view.instances);
    const gl::Buffer& list = commands != nullptr ? *commands : commands_;
    const auto [first, count] = runOf(staticGroup_, set);
    command.drawIndexedIndirect(staticVertexArray_.id(), list, firstCommand + first, count);
    const auto [fieldFirst, fieldCount] = runOf(heightFieldGroup_, set);
    if (fieldCount == 0 || !geometry.heightFields.valid()) return;
    glVertexArrayVertexBuffer(heightFieldVertexArray_.id(), 0,
                              context.buffer(geometry.heightFields, gl::Use::vertices).id(), 0,
                              sizeof(VertexData));
    command.drawIndexedIndirect(heightFieldVertexArray_.id(), list, firstCommand + fieldFirst,
                                fieldCount);
}

void GpuScene::drawOne(gl::Command& command, const gl::PassContext& context,
                       const Geometry& geometry, const ViewInstances& view, std::size_t index,
                       const gl::Buffer* commands, std::size_t firstCommand) const {
    command.storage("Instances", view.instances);
    const gl::Buffer& list = commands != nullptr ? *commands : commands_;
    const bool isHeightField = index >= heightFieldGroup_.kindBegin[0];
    if (isHeightField) {
        glVertexArrayVertexBuffer(heightFieldVertexArray_.id(), 0,
                                  context.buffer(geometry.heightFields, gl::Use::vertices).id(), 0,
                                  sizeof(VertexData));
    }
    command.drawIndexedIndirect(
        isHeightField ? heightFieldVertexArray_.id() : staticVertexArray_.id(), list,
        firstCommand + index, 1);
}

void GpuScene::bindTriangles(gl::Command& command, const Geometry& geometry) const {
    command.storage("SceneVertices", vertices_).storage("SceneIndices", indices_);
    if (geometry.heightFields.valid()) {
        command.storage("HeightFieldVertices", geometry.heightFields);
    } else {
        command.storage("HeightFieldVertices", vertices_);
    }
}

std::size_t GpuScene::bytes() const {
    return vertices_.bytes() + indices_.bytes() + commands_.bytes() + materials_.bytes() +
           images_.desc().bytes() + (bvh_ ? bvh_->bytes() : 0);
}

const SceneBvh& GpuScene::bvh() const {
    if (!bvh_) bvh_ = std::make_unique<SceneBvh>(scene_);
    return *bvh_;
}

}  // namespace kaustik::render
