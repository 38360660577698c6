// SPDX-License-Identifier: MIT
#include "framework/scene/light_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>

#include "framework/scene/connected_bodies.h"
#include "framework/scene/meshes/winding_number.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::scene {
namespace {

// How far a plane's corners may lie next to it, in its sizes: a float's rounding.
constexpr double kFlat = 1e-6;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// A sheet that is a graph over a plane.
struct Slopes {
    glm::dvec3 up{0.0, 1.0, 0.0};  // unit, in the world: the plane's normal, outwards
    double steepestRadians = 0.0;  // of its normals against that, at any time
};

// Steps along the rows and columns of the grid rise by no more than the sum of the waves' slopes
// there, and so do the triangles that lie between them.
Slopes slopesOf(const HeightField& field, const glm::dmat3& normalToWorld) {
    glm::dvec2 slope(0.0);
    for (const Wave& wave : field.waves) {
        slope += std::abs(static_cast<double>(wave.amplitudeMeters)) * glm::abs(waveVector(wave));
    }
    Slopes slopes;
    slopes.up = glm::normalize(normalToWorld * glm::dvec3(0, 1, 0));
    for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec3 normal((corner & 1) ? slope.x : -slope.x, 1.0,
                                (corner & 2) ? slope.y : -slope.y);
        slopes.steepestRadians =
            std::max(slopes.steepestRadians, angleBetween(normalToWorld * normal, slopes.up));
    }
    return slopes;
}

// Of a mesh whose triangles lie in one plane and face the same way; nothing for any other.
std::optional<Slopes> slopesOf(const Mesh& mesh, const glm::dmat3& normalToWorld) {
    std::optional<glm::dvec3> up;
    glm::dvec3 on(0.0);
    double size = 0.0;
    for (const glm::vec3& position : mesh.positions)
        size = std::max(size, static_cast<double>(glm::length(position - mesh.positions.front())));
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle.x]);
        const glm::dvec3 b(mesh.positions[triangle.y]);
        const glm::dvec3 c(mesh.positions[triangle.z]);
        const glm::dvec3 area = glm::cross(b - a, c - a);
        if (!(glm::length(area) > kFlat * kFlat * size * size)) continue;
        const glm::dvec3 normal = glm::normalize(area);
        if (!up) {
            up = normal;
            on = a;
        }
        if (glm::dot(normal, *up) <= 0.0) return std::nullopt;
        for (const glm::dvec3& corner : {a, b, c}) {
            if (std::abs(glm::dot(corner - on, *up)) > kFlat * size) return std::nullopt;
        }
    }
    if (!up) return std::nullopt;
    return Slopes{glm::normalize(normalToWorld * *up), 0.0};
}

// The largest angle of a light's rays, where they hit the sheet, against straight down on it.
double largestIncidence(const Scene& scene, const Object& object, const glm::dvec3& up,
                        const Light& light) {
    if (light.kind == LightKind::directional) return angleBetween(light.direction, -up);
    const Bounds bounds = objectBounds(scene, object);
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1) ? bounds.maximum.x : bounds.minimum.x,
                            (corner & 2) ? bounds.maximum.y : bounds.minimum.y,
                            (corner & 4) ? bounds.maximum.z : bounds.minimum.z);
        largest = std::max(largest, angleBetween(at - light.position, -up));
    }
    return largest;
}

// The sheet's mean normal, outwards, in the world.
glm::dvec3 meanNormal(const Scene& scene, const Object& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const glm::dmat3 normalToWorld = glm::transpose(glm::inverse(glm::dmat3(object.toWorld)));
    glm::dvec3 mean(0.0, 1.0, 0.0);
    if (!mesh.heightField) {
        mean = glm::dvec3(0.0);
        for (const glm::vec3& normal : mesh.normals)
            mean += glm::dvec3(normal);
    }
    return glm::normalize(normalToWorld * mean);
}

// Unpolarised reflectance from vacuum into a medium of this index.
double reflectance(double cosine, double index) {
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (index * cosine - inside) / (index * cosine + inside);
    return 0.5 * (s * s + p * p);
}

// Whether a box that moves along `direction` comes upon another one, which it does not touch yet.
bool canReach(const Bounds& moving, const Bounds& there, const glm::dvec3& direction) {
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = there.minimum[axis] - moving.maximum[axis];
        const double high = there.maximum[axis] - moving.minimum[axis];
        if (std::abs(direction[axis]) < 1e-12) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double a = low / direction[axis];
        const double b = high / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first > 0.0 && first < last;
}

// A receiver that a box comes upon as it moves along a unit `direction`: by its box or, of what
// that is within, as it is in a room, by rays from nine points of it; null: there is none.
const Object* receiverReached(const Scene& scene, const SurfaceRays& rays, const Bounds& from,
                              const glm::dvec3& direction) {
    for (const Object& receiver : scene.objects) {
        if (!isReceiver(scene.materials[receiver.material].kind)) continue;
        const Bounds to = objectBounds(scene, receiver);
        if (!to.empty && canReach(from, to, direction)) return &receiver;
    }
    const glm::dvec3 middle = 0.5 * (from.minimum + from.maximum);
    const glm::dvec3 reach = 0.25 * (from.maximum - from.minimum);
    for (int i = 0; i < 9; ++i) {
        const glm::dvec3 step(i % 3 - 1, 0, i / 3 - 1);
        if (const auto hit = rays.first(middle + step * reach, direction))
            return &scene.objects[hit->object];
    }
    return nullptr;
}

bool isConvexBySamples(const Mesh& mesh) {
    constexpr std::size_t kTriangles = 64;
    constexpr std::size_t kCorners = 4096;
    constexpr double kNoise = 1e-3;  // of the mesh's size
    double size = 0.0;
    for (const glm::vec3& position : mesh.positions)
        size = std::max(size, static_cast<double>(glm::length(position - mesh.positions.front())));
    const std::size_t triangleStep = std::max<std::size_t>(mesh.triangles.size() / kTriangles, 1);
    const std::size_t cornerStep = std::max<std::size_t>(mesh.positions.size() / kCorners, 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += triangleStep) {
        const glm::uvec3& triangle = mesh.triangles[t];
        const glm::dvec3 a(mesh.positions[triangle.x]);
        const glm::dvec3 area = glm::cross(glm::dvec3(mesh.positions[triangle.y]) - a,
                                           glm::dvec3(mesh.positions[triangle.z]) - a);
        if (!(glm::length(area) > kFlat * kFlat * size * size)) continue;
        const glm::dvec3 normal = glm::normalize(area);
        for (std::size_t c = 0; c < mesh.positions.size(); c += cornerStep) {
            if (glm::dot(normal, glm::dvec3(mesh.positions[c]) - a) > kNoise * size) return false;
        }
    }
    return true;
}

bool areNested(const Scene& scene) {
    std::vector<const Object*> bodies;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        if (!mesh.triangles.empty() && mesh.hasInside) bodies.push_back(&object);
    }
    for (const Object* outer : bodies) {
        if (scene.materials[outer->material].kind != MaterialKind::dielectric) continue;
        const Bounds box = objectBounds(scene, *outer);
        for (const Object* other : bodies) {
            if (other != outer && overlap(objectBounds(scene, *other), box)) return true;
        }
    }
    return false;
}

// By its vertices, as they stand in the world.
bool isBall(const Mesh& mesh, const glm::dmat4& toWorld) {
    constexpr double kRound = 1e-3;
    if (!mesh.closed) return false;
    const auto placeOf = [&](const glm::vec3& position) {
        return glm::dvec3(toWorld * glm::dvec4(glm::dvec3(position), 1.0));
    };
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, placeOf(position));
        high = glm::max(high, placeOf(position));
    }
    const glm::dvec3 middle = 0.5 * (low + high);
    const double radius = 0.5 * (high.y - low.y);
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const glm::vec3& p) {
        return std::abs(glm::length(placeOf(p) - middle) - radius) <= kRound * radius;
    });
}

}  // namespace

bool isOpen(const Scene& scene, std::size_t material) {
    const bool isDielectric = scene.materials[material].kind == MaterialKind::dielectric;
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        const Mesh& mesh = scene.meshes[object.mesh];
        return object.material == material && !(isDielectric ? mesh.hasInside : mesh.closed);
    });
}

std::vector<bool> openMaterials(const Scene& scene) {
    std::vector<bool> open;
    for (std::size_t material = 0; material < scene.materials.size(); ++material)
        open.push_back(isOpen(scene, material));
    return open;
}

const SurfaceRays& SceneShapes::receivers() {
    const std::vector<std::size_t> objects = receiversOf(scene_);
    const bool isStill = std::none_of(objects.begin(), objects.end(), [&](std::size_t object) {
        return scene_.meshes[scene_.objects[object].mesh].heightField.has_value();
    });
    if (!receivers_ || !isStill) receivers_.emplace(scene_, objects);
    return *receivers_;
}

bool SceneShapes::isConvex(std::uint32_t mesh) {
    const auto found = convex_.find(mesh);
    if (found != convex_.end()) return found->second;
    return convex_.emplace(mesh, isConvexBySamples(scene_.meshes[mesh])).first->second;
}

bool SceneShapes::turnsBack(std::uint32_t mesh) {
    const auto found = turnsBack_.find(mesh);
    if (found != turnsBack_.end()) return found->second;
    return turnsBack_.emplace(mesh, kaustik::scene::turnsBack(scene_.meshes[mesh])).first->second;
}

const std::vector<std::vector<std::size_t>>& SceneShapes::bodies() {
    if (!bodies_) bodies_ = connectedBodies(scene_);
    return *bodies_;
}

bool SceneShapes::hasNestedBodies() {
    if (!hasNestedBodies_) hasNestedBodies_ = areNested(scene_);
    return *hasNestedBodies_;
}

RepeatedHits repeatedHits(const Scene& scene) {
    SceneShapes shapes(scene);
    return repeatedHits(shapes);
}

RepeatedHits repeatedHits(SceneShapes& shapes) {
    const Scene& scene = shapes.scene();
    const Object* sheet = nullptr;
    for (const Object& object : scene.objects) {
        const MaterialKind kind = scene.materials[object.material].kind;
        const Mesh& mesh = scene.meshes[object.mesh];
        if (isReceiver(kind) || mesh.triangles.empty()) continue;
        if (sheet != nullptr) return {true, true};
        sheet = &object;
    }
    if (sheet == nullptr) return {};
    if (const Mesh& body = scene.meshes[sheet->mesh]; body.hasInside)
        return {true, true, !body.closed || !shapes.isConvex(sheet->mesh)};
    const Mesh& mesh = scene.meshes[sheet->mesh];
    const glm::dmat3 normalToWorld = glm::transpose(glm::inverse(glm::dmat3(sheet->toWorld)));
    const std::optional<Slopes> slopes = mesh.heightField
                                             ? slopesOf(*mesh.heightField, normalToWorld)
                                             : slopesOf(mesh, normalToWorld);
    if (!slopes) return {true, true};
    if (slopes->steepestRadians == 0.0) return {};
    const double steepest = slopes->steepestRadians;
    const double right = glm::half_pi<double>();
    const bool isDielectric = scene.materials[sheet->material].kind == MaterialKind::dielectric;
    RepeatedHits again;
    for (const Light& light : scene.lights) {
        const double incidence = largestIncidence(scene, *sheet, slopes->up, light);
        // Light that enters is bent towards the normal: it goes on between its old direction and
        // the normal's. From within, it is bent away, or reflected. A reflected direction is turned
        // by twice the slope.
        const bool isFromInside = incidence + steepest >= right;
        const double onward = std::max(incidence, steepest);
        const double back = incidence + 2.0 * steepest;
        const bool reflected = isFromInside || back + steepest >= right;
        again.reflected = again.reflected || reflected;
        again.transmitted = again.transmitted ||
                            (isDielectric ? isFromInside || onward + steepest >= right : reflected);
    }
    return again;
}

std::optional<ReflectedLight> reflectedLight(const Scene& scene) {
    SceneShapes shapes(scene);
    return reflectedLight(shapes);
}

std::optional<ReflectedLight> reflectedLight(SceneShapes& shapes) {
    const Scene& scene = shapes.scene();
    // Still water reflects 2 % of what comes straight down: in a room that is all of the ceiling's
    // light (results/defaults.md).
    constexpr double kMinShare = 0.01;
    std::optional<ReflectedLight> largest;
    const SurfaceRays* rays = nullptr;  // where a sheet reflects enough
    for (const Object& sheet : scene.objects) {
        const Material& material = scene.materials[sheet.material];
        const Mesh& mesh = scene.meshes[sheet.mesh];
        if (material.kind != MaterialKind::dielectric || mesh.triangles.empty() || mesh.hasInside)
            continue;
        const Bounds from = objectBounds(scene, sheet);
        const glm::dvec3 up = meanNormal(scene, sheet);
        for (const Light& light : scene.lights) {
            const glm::dvec3 direction =
                light.kind == LightKind::directional
                    ? light.direction
                    : glm::normalize(0.5 * (from.minimum + from.maximum) - light.position);
            const double cosine = -glm::dot(direction, up);
            if (!(cosine > 0.0)) continue;  // from within: what is reflected stays there
            const double share = reflectance(cosine, static_cast<double>(material.ior));
            if (share <= std::max(kMinShare, largest ? largest->share : 0.0)) continue;
            const glm::dvec3 reflected = direction + 2.0 * cosine * up;
            if (rays == nullptr) rays = &shapes.receivers();
            if (const Object* receiver = receiverReached(scene, *rays, from, reflected))
                largest = ReflectedLight{sheet.name, receiver->name, share};
        }
    }
    return largest;
}

std::optional<std::string> concaveBody(const Scene& scene) {
    SceneShapes shapes(scene);
    return concaveBody(shapes);
}

std::optional<std::string> concaveBody(SceneShapes& shapes) {
    const Scene& scene = shapes.scene();
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        const bool isDielectric = scene.materials[object.material].kind == MaterialKind::dielectric;
        if (!isDielectric || mesh.triangles.empty() || !mesh.hasInside) continue;
        if (!shapes.isConvex(object.mesh)) return object.name;
    }
    return std::nullopt;
}

bool hasBallsAlone(const Scene& scene) {
    std::vector<Bounds> balls;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        const bool isDielectric = scene.materials[object.material].kind == MaterialKind::dielectric;
        if (!isDielectric || mesh.triangles.empty() || !mesh.hasInside) continue;
        if (!isBall(mesh, object.toWorld)) return false;
        const Bounds bounds = objectBounds(scene, object);
        for (const Bounds& other : balls) {
            const bool isApart = glm::any(glm::lessThan(bounds.maximum, other.minimum)) ||
                                 glm::any(glm::lessThan(other.maximum, bounds.minimum));
            if (!isApart) return false;
        }
        balls.push_back(bounds);
    }
    return !balls.empty();
}

}  // namespace kaustik::scene
