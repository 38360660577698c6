// SPDX-License-Identifier: MIT
#include "framework/reference/embree_scene.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

#include "framework/core/error.h"
#include "framework/reference/embree_filters.h"
#include "framework/transport/normal_map.h"

namespace kaustik::reference {
namespace {

// Of a normal of any length the unit one that lies on the triangle's side.
glm::dvec3 onItsSide(const glm::dvec3& normal, const glm::dvec3& geometric) {
    const double size2 = glm::dot(normal, normal);
    if (!(size2 > 1e-24)) return geometric;
    const glm::dvec3 unit = normal * (1.0 / std::sqrt(size2));
    const double side = glm::dot(unit, geometric);
    return side > 0.0 ? unit : glm::normalize(unit + (1e-3 - side) * geometric);
}

glm::dvec2 uvOf(const transport::VertexData& vertex) {
    return {vertex.u, vertex.v};
}

using scene::MaterialKind;

void setRay(RTCRay& ray, const glm::dvec3& origin, const glm::dvec3& direction) {
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0.0f;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.time = 0.0f;
    ray.mask = 0xffffffffu;
    ray.id = 0;
    ray.flags = 0;
}

// The ray `i` of eight; what is nearer than `from` or farther than `to`, by the direction's length,
// is not hit.
void setRay(RTCRay8& rays, int i, const glm::vec3& origin, const glm::vec3& direction, float from,
            float to) {
    rays.org_x[i] = origin.x;
    rays.org_y[i] = origin.y;
    rays.org_z[i] = origin.z;
    rays.dir_x[i] = direction.x;
    rays.dir_y[i] = direction.y;
    rays.dir_z[i] = direction.z;
    rays.tnear[i] = from;
    rays.tfar[i] = to;
    rays.mask[i] = 0xffffffffu;
    rays.id[i] = static_cast<unsigned>(i);
}

void checkDevice(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw DeviceError(fmt::format(
        "Embree could not build the scene ({}); it may be too large for this machine's memory.",
        error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory"
                                         : fmt::format("error {}", static_cast<int>(error))));
}

}  // namespace

// The sides of a triangle from its first corner; none where it has no area.
struct EmbreeScene::Sides {
    glm::dvec3 normal;  // unit, by the winding
    // What tells how far along each side a step is: 1 over all of it, 0 along the other.
    glm::dvec3 acrossFirst;
    glm::dvec3 acrossSecond;
};

std::optional<EmbreeScene::Sides> EmbreeScene::sidesOf(const glm::dvec3& a, const glm::dvec3& b,
                                                       const glm::dvec3& c) {
    const glm::dvec3 area = glm::cross(b - a, c - a);
    const double area2 = glm::dot(area, area);
    if (!(area2 > 0.0)) return std::nullopt;
    return Sides{area / std::sqrt(area2), glm::cross(c - a, area) / area2,
                 glm::cross(area, b - a) / area2};
}

EmbreeScene::EmbreeScene(const scene::Scene& scene, Filters filters, HeightFields heightFields)
    : scene_(scene), appearance_(scene) {
    const scene::Bounds world = sceneBounds(scene);
    if (!world.empty) center_ = 0.5 * (world.minimum + world.maximum);
    device_ = rtcNewDevice(nullptr);
    if (device_ == nullptr) throw DeviceError("Embree could not be started.");
    try {
        for (const scene::Object& object : scene.objects)
            addObject(object);
        attach(filters, heightFields);
        const glm::dvec3 farthest = glm::max(glm::abs(bounds_.minimum), glm::abs(bounds_.maximum));
        roundingMeters_ = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                          std::max({farthest.x, farthest.y, farthest.z});
    } catch (...) {
        rtcReleaseScene(everything_);
        rtcReleaseScene(opaque_);
        rtcReleaseDevice(device_);
        throw;
    }
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(everything_);
    rtcReleaseScene(opaque_);
    rtcReleaseDevice(device_);
}

// In double up to here, so that what is left is small.
transport::VertexData EmbreeScene::ObjectMesh::placed(const transport::VertexData& vertex) const {
    return {glm::vec3(toLocal * glm::dvec4(vertex.position, 1.0)), vertex.u,
            glm::vec3(normalToLocal * glm::dvec3(vertex.normal)), vertex.v};
}

void EmbreeScene::addObject(const scene::Object& object) {
    const scene::Mesh& mesh = scene_.meshes[object.mesh];
    auto placed = std::make_unique<ObjectMesh>();
    placed->info = {scene_.materials[object.material].kind, object.material, mesh.closed};
    placed->triangles = mesh.triangles;
    placed->hasNormalMap = scene_.materials[object.material].normalMap >= 0;
    placed->toLocal = glm::translate(glm::dmat4(1.0), -center_) * object.toWorld *
                      glm::translate(glm::dmat4(1.0), mesh.origin);
    placed->normalToLocal = glm::transpose(glm::inverse(glm::dmat3(placed->toLocal)));
    const bool isSpecular = !isReceiver(placed->info.kind);
    placed->vertices.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        placed->vertices.push_back(
            placed->placed({mesh.positions[i], mesh.uvs[i].x, mesh.normals[i], mesh.uvs[i].y}));
        const glm::vec3& position = placed->vertices.back().position;
        bounds_.include(position);
        if (isSpecular) specularVertices_.emplace_back(position);
    }
    objects_.push_back(std::move(placed));
}

bool EmbreeScene::move(std::size_t object, std::span<const transport::VertexData> vertices) {
    const bool areNumbers =
        std::all_of(vertices.begin(), vertices.end(), [](const transport::VertexData& vertex) {
            return std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z);
        });
    if (!areNumbers) return false;  // Embree has no answer to these
    ObjectMesh& mesh = *objects_[object];
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.vertices.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              mesh.vertices[i] = mesh.placed(vertices[i]);
                      });
    if (mesh.triangles.empty()) return true;
    RTCGeometry geometry = rtcGetGeometry(everything_, static_cast<unsigned>(object));
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry);
    return true;
}

void EmbreeScene::refit() {
    rtcCommitScene(everything_);
    rtcCommitScene(opaque_);
    checkDevice(device_);
}

void EmbreeScene::attach(Filters filters, HeightFields heightFields) {
    // Of what moves there is a hierarchy an object, and one over these.
    const bool isMoving = heightFields == HeightFields::moving;
    for (RTCScene* target : {&everything_, &opaque_}) {
        *target = rtcNewScene(device_);
        const int flags =
            RTC_SCENE_FLAG_ROBUST | (isMoving ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
        rtcSetSceneFlags(*target, static_cast<RTCSceneFlags>(flags));
        // By any other quality than "low" all that moves is built anew instead of fitted, which
        // takes twenty times as long; each object's own hierarchy is as good.
        rtcSetSceneBuildQuality(*target, isMoving ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH);
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        ObjectMesh& mesh = *objects_[i];
        if (mesh.triangles.empty()) continue;
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        if (isMoving && scene_.meshes[scene_.objects[i].mesh].heightField)
            rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.vertices.data(), offsetof(transport::VertexData, position),
                                   sizeof(transport::VertexData), mesh.vertices.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles.data(), 0, sizeof(glm::uvec3),
                                   mesh.triangles.size());
        rtcSetGeometryUserData(geometry, &mesh.info);
        // A photon's path ends at receivers, so only specular surfaces can be hit again.
        if (filters == Filters::sideRules) {
            if (!isReceiver(mesh.info.kind))
                rtcSetGeometryIntersectFilterFunction(geometry, rejectWrongSide);
            rtcSetGeometryOccludedFilterFunction(geometry, rejectStart);
        }
        rtcCommitGeometry(geometry);
        const auto id = static_cast<unsigned>(i);
        rtcAttachGeometryByID(everything_, geometry, id);
        if (mesh.info.kind != MaterialKind::dielectric)
            rtcAttachGeometryByID(opaque_, geometry, id);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(everything_);
    rtcCommitScene(opaque_);
    checkDevice(device_);
}

glm::dvec3 EmbreeScene::shadingNormal(const ObjectMesh& mesh, const glm::uvec3& corners,
                                      const glm::dvec3& weights,
                                      const glm::dvec3& geometric) const {
    const std::array<const transport::VertexData*, 3> at{
        &mesh.vertices[corners.x], &mesh.vertices[corners.y], &mesh.vertices[corners.z]};
    const glm::dvec3 interpolated = weights.x * glm::dvec3(at[0]->normal) +
                                    weights.y * glm::dvec3(at[1]->normal) +
                                    weights.z * glm::dvec3(at[2]->normal);
    const glm::dvec3 normal = onItsSide(interpolated, geometric);
    if (!mesh.hasNormalMap) return normal;
    const std::array<glm::dvec2, 3> uvs{uvOf(*at[0]), uvOf(*at[1]), uvOf(*at[2])};
    const glm::dvec2 uv = weights.x * uvs[0] + weights.y * uvs[1] + weights.z * uvs[2];
    const glm::dvec3 a = at[0]->position;
    return onItsSide(
        transport::mappedNormal(normal, glm::dvec3(at[1]->position) - a,
                                glm::dvec3(at[2]->position) - a, uvs[1] - uvs[0], uvs[2] - uvs[0],
                                appearance_.mappedVector(mesh.info.material, uv)),
        geometric);
}

// Only the triangle is Embree's word; the point on it is computed again in double.
void EmbreeScene::refine(const glm::dvec3& origin, const glm::dvec3& direction, const RTCHit& found,
                         float t, SurfaceHit& hit) const {
    const ObjectMesh& mesh = *objects_[found.geomID];
    const glm::uvec3 corners = mesh.triangles[found.primID];
    const transport::VertexData& cornerA = mesh.vertices[corners.x];
    const transport::VertexData& cornerB = mesh.vertices[corners.y];
    const transport::VertexData& cornerC = mesh.vertices[corners.z];
    const glm::dvec3 a = cornerA.position;
    const glm::dvec3 ab = glm::dvec3(cornerB.position) - a;
    const glm::dvec3 ac = glm::dvec3(cornerC.position) - a;
    const glm::dvec3 area = glm::cross(ab, ac);
    const glm::dvec3 toA = a - origin;
    const double closing = glm::dot(direction, area);
    const glm::dvec3 across = glm::cross(direction, toA);
    const double inverse = 1.0 / closing;
    double distance = glm::dot(toA, area) * inverse;
    double u = -glm::dot(ac, across) * inverse;
    double v = glm::dot(ab, across) * inverse;
    // Seen edge-on the division means nothing: then Embree's word is as good as any.
    const double margin = 1e-3;
    if (!(u > -margin && v > -margin && u + v < 1.0 + margin)) {
        u = static_cast<double>(found.u);
        v = static_cast<double>(found.v);
        distance = static_cast<double>(t);
    }
    hit.distance = std::max(distance, 0.0);
    hit.position = origin + hit.distance * direction;
    hit.geometricNormal = area * (1.0 / std::sqrt(glm::dot(area, area)));
    const double w = 1.0 - u - v;
    hit.shadingNormal = shadingNormal(mesh, corners, {w, u, v}, hit.geometricNormal);
    hit.uv = {w * static_cast<double>(cornerA.u) + u * static_cast<double>(cornerB.u) +
                  v * static_cast<double>(cornerC.u),
              w * static_cast<double>(cornerA.v) + u * static_cast<double>(cornerB.v) +
                  v * static_cast<double>(cornerC.v)};
    hit.material = mesh.info.material;
    hit.triangle = {found.geomID, found.primID};
}

double EmbreeScene::uvPerMeter(const TriangleId& triangle) const {
    const ObjectMesh& mesh = *objects_[triangle.object];
    const glm::uvec3& corners = mesh.triangles[triangle.triangle];
    const transport::VertexData& a = mesh.vertices[corners.x];
    const transport::VertexData& b = mesh.vertices[corners.y];
    const double side = glm::distance(glm::dvec3(a.position), glm::dvec3(b.position));
    return glm::distance(uvOf(a), uvOf(b)) / std::max(side, 1e-12);
}

// By differences over a texel: the map is linear between two.
glm::dmat3 EmbreeScene::mappedTurning(const ObjectMesh& mesh, const glm::uvec3& corners,
                                      const Sides& sides, const glm::dvec3& fromFirst) const {
    const std::array<glm::dvec2, 3> uvs{uvOf(mesh.vertices[corners.x]),
                                        uvOf(mesh.vertices[corners.y]),
                                        uvOf(mesh.vertices[corners.z])};
    const double u = glm::dot(fromFirst, sides.acrossFirst);
    const double v = glm::dot(fromFirst, sides.acrossSecond);
    const glm::dvec3 weights(1.0 - u - v, u, v);
    const auto change = [&](const glm::dvec3& step, const glm::dvec2& uvStep) {
        const double texels = glm::length(appearance_.normalTexels(mesh.info.material, uvStep));
        const double reach = 0.5 / std::max(texels, 1.0);
        return (shadingNormal(mesh, corners, weights + reach * step, sides.normal) -
                shadingNormal(mesh, corners, weights - reach * step, sides.normal)) /
               (2.0 * reach);
    };
    return glm::outerProduct(change({-1.0, 1.0, 0.0}, uvs[1] - uvs[0]), sides.acrossFirst) +
           glm::outerProduct(change({-1.0, 0.0, 1.0}, uvs[2] - uvs[0]), sides.acrossSecond);
}

glm::dmat3 EmbreeScene::normalTurning(const TriangleId& triangle,
                                      const glm::dvec3& position) const {
    const ObjectMesh& mesh = *objects_[triangle.object];
    const glm::uvec3 corners = mesh.triangles[triangle.triangle];
    const transport::VertexData& a = mesh.vertices[corners.x];
    const transport::VertexData& b = mesh.vertices[corners.y];
    const transport::VertexData& c = mesh.vertices[corners.z];
    const std::optional<Sides> sides = sidesOf(a.position, b.position, c.position);
    if (!sides) return glm::dmat3(0.0);
    const glm::dvec3 fromFirst = position - glm::dvec3(a.position);
    if (mesh.hasNormalMap) return mappedTurning(mesh, corners, *sides, fromFirst);
    const glm::dmat3 turning =
        glm::outerProduct(glm::dvec3(b.normal) - glm::dvec3(a.normal), sides->acrossFirst) +
        glm::outerProduct(glm::dvec3(c.normal) - glm::dvec3(a.normal), sides->acrossSecond);
    const glm::dvec3 normal = glm::dvec3(a.normal) + turning * fromFirst;
    const double size = glm::length(normal);
    if (!(size > 1e-12)) return glm::dmat3(0.0);
    const glm::dvec3 unit = normal / size;
    return (turning - glm::outerProduct(unit, unit * turning)) / size;
}

bool EmbreeScene::intersect(const Ray& ray, SurfaceHit& hit) const {
    FilterContext context = makeContext(ray.start, ray.media, ray.sides);
    context.leftSide = ray.leftSide;
    context.reachMeters = static_cast<float>(ray.reachMeters);
    RTCRayHit query;
    setRay(query.ray, ray.origin, ray.direction);
    query.ray.tnear = static_cast<float>(ray.fromMeters);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    findFirstHit(everything_, context.embree, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    refine(ray.origin, ray.direction, query.hit, query.ray.tfar, hit);
    return true;
}

bool EmbreeScene::intersectFromLight(const Ray& ray, SurfaceHit& hit) const {
    // More planes than that through one light are no accident of rounding.
    constexpr int kMaxPlanes = 16;
    Ray onward = ray;
    for (int plane = 0; plane < kMaxPlanes; ++plane) {
        if (!intersect(onward, hit)) return false;
        const double height = std::abs(glm::dot(hit.position - ray.origin, hit.geometricNormal));
        if (height > roundingMeters_) return true;
        onward.fromMeters = hit.distance + roundingMeters_;
    }
    return false;
}

std::array<TriangleId, kRaysTogether> EmbreeScene::firstTriangles(
    const std::array<OpenRay, kRaysTogether>& rays, int count) const {
    const MediaStack none;
    FilterContext context = makeContext({}, none, SideRule::any);
    alignas(32) std::array<int, kRaysTogether> valid{};
    RTCRayHit8 query{};
    for (int i = 0; i < count; ++i) {
        const OpenRay& ray = rays[static_cast<std::size_t>(i)];
        valid[static_cast<std::size_t>(i)] = -1;
        setRay(query.ray, i, ray.origin, ray.direction, ray.from,
               std::numeric_limits<float>::infinity());
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    findFirstHits(everything_, context.embree, valid.data(), query);
    std::array<TriangleId, kRaysTogether> found;
    for (int i = 0; i < count; ++i) {
        if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        found[static_cast<std::size_t>(i)] = {query.hit.geomID[i], query.hit.primID[i]};
    }
    return found;
}

bool EmbreeScene::intersectStraight(const glm::dvec3& origin, const glm::dvec3& direction,
                                    SurfaceHit& hit) const {
    const MediaStack none;
    FilterContext context = makeContext({}, none, SideRule::any);
    RTCRayHit query;
    setRay(query.ray, origin, direction);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    findFirstHit(opaque_, context.embree, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    refine(origin, direction, query.hit, query.ray.tfar, hit);
    return true;
}

std::uint32_t EmbreeScene::blockedRays(const std::array<RayToLight, kRaysTogether>& rays,
                                       int count) const {
    const MediaStack none;
    FilterContext context = makeContext({}, none, SideRule::any);
    std::array<float, kRaysTogether> resolved{};
    context.resolvedMeters = resolved.data();
    alignas(32) std::array<int, kRaysTogether> valid{};
    RTCRay8 query{};
    for (int i = 0; i < count; ++i) {
        const RayToLight& ray = rays[static_cast<std::size_t>(i)];
        valid[static_cast<std::size_t>(i)] = -1;
        resolved[static_cast<std::size_t>(i)] = ray.resolvedMeters;
        setRay(query, i, ray.origin, ray.direction, 0.0f, ray.reachMeters);
    }
    findAnyHits(everything_, context.embree, valid.data(), query);
    std::uint32_t blocked = 0;
    for (int i = 0; i < count; ++i)
        blocked |= query.tfar[i] < 0.0f ? std::uint32_t{1} << i : 0u;
    return blocked;
}

bool EmbreeScene::isVisible(const glm::dvec3& from, const TriangleId& start, const glm::dvec3& to,
                            double ignoredEnd) const {
    const MediaStack none;
    FilterContext context = makeContext(start, none, SideRule::any);
    RTCRay ray;
    setRay(ray, from, to - from);
    // Neighbours of the triangle may lie before `from` by the rounding of coordinates, no farther.
    const glm::dvec3 size = glm::abs(from);
    const double rounding = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                            std::max({size.x, size.y, size.z});
    ray.tnear = static_cast<float>(rounding / glm::length(to - from));
    ray.tfar = static_cast<float>(1.0 - ignoredEnd);
    findAnyHit(opaque_, context.embree, ray);
    return ray.tfar >= 0.0f;
}

}  // namespace kaustik::reference
