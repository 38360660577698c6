// SPDX-License-Identifier: MIT
// The scene as Embree sees it, and exact hits in double precision.
//
// Space: "local" coordinates are the world's, in metres, less `center()`, the middle of the scene:
// 32-bit floats then lose nothing for a scene far from the world's origin. Positions of the
// vertices are floats (as on the GPU); a hit is refined in double on the plane of its triangle.
//
// No ray needs an epsilon to leave a surface. A ray names the triangle that it starts on, which it
// cannot hit again, and the dielectric that it is inside of: that one it hits only from within,
// any other only from outside (shaders/include/surfaces/side_rule.glsl, `isFacing`), so rounding at
// the seam to a neighbouring triangle does no harm either. Where dielectrics overlap, one farther
// out may end inside of the innermost.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/reference/appearance.h"
#include "framework/reference/embree.h"
#include "framework/reference/media_stack.h"
#include "framework/scene/scene.h"
#include "framework/transport/types.h"

namespace kaustik::reference {

// A triangle of an object; none where a ray starts in the open.
struct TriangleId {
    std::uint32_t object = RTC_INVALID_GEOMETRY_ID;
    std::uint32_t triangle = RTC_INVALID_GEOMETRY_ID;
    [[nodiscard]] bool exists() const { return object != RTC_INVALID_GEOMETRY_ID; }
};

// The sides from which specular surfaces are hit.
enum class SideRule : std::uint32_t {
    any,        // from a light: every surface from both sides
    transport,  // dielectrics by the medium, closed mirrors from outside, open ones from both sides
};

struct Ray {
    glm::dvec3 origin{0.0};     // local
    glm::dvec3 direction{0.0};  // unit
    TriangleId start;
    MediaStack media;
    SideRule sides = SideRule::transport;
    // These two are for rays that know no triangle to start on. `leftSide` is the side of an open
    // mirror that the ray has left (transport::kLeft…): within this height above the mirror, m, the
    // ray does not hit it from that side, nor does it hit the end of a dielectric that overlaps the
    // innermost.
    std::uint32_t leftSide = transport::kLeftNone;
    double reachMeters = 0.0;
    double fromMeters = 0.0;  // what is nearer is not hit
};

// A ray that starts in the open and meets all surfaces from all sides.
struct OpenRay {
    glm::vec3 origin{0.0f};     // local
    glm::vec3 direction{0.0f};  // of any length but 0
    float from = 0.0f;          // what is nearer, by the direction's length, is not hit
};
// A ray from a surface back to a light, in whose way all surfaces are from both sides but for those
// whose plane passes its origin nearer than what is known of that.
struct RayToLight {
    glm::vec3 origin{0.0f};     // local
    glm::vec3 direction{0.0f};  // unit
    float reachMeters = 0.0f;   // what lies farther is not in the way
    float resolvedMeters = 0.0f;
};
inline constexpr int kRaysTogether = 8;

struct SurfaceHit {
    double distance = 0.0;            // m
    glm::dvec3 position{0.0};         // local
    glm::dvec3 geometricNormal{0.0};  // unit, towards the side that the winding calls the outside
    glm::dvec3 shadingNormal{0.0};    // unit, never on the other side than the geometric one
    glm::dvec2 uv{0.0};
    std::uint32_t material = 0;  // index
    TriangleId triangle;
};

class EmbreeScene {
  public:
    // Builds the acceleration structures; height fields are those of Scene::timeSeconds. `scene`
    // must outlive this. Throws DeviceError when Embree has no memory, IoError for an image.
    // `Filters::none` is for measuring what the side rules cost: every surface counts from every
    // side.
    enum class Filters { sideRules, none };
    // Whether height fields are to be moved: what is found is the same, but for where triangles
    // meet, and found a little more slowly.
    enum class HeightFields { still, moving };
    explicit EmbreeScene(const scene::Scene& scene, Filters filters = Filters::sideRules,
                         HeightFields heightFields = HeightFields::still);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    // Moves the vertices of an object with a height field, which are in its mesh's space, to where
    // they are now; to be found there once refit() has been called, which fits the hierarchies
    // anew. False, and nothing moves, where they are no numbers. For scenes of
    // HeightFields::moving, while nobody traces; bounds() and specularVertices() stay.
    bool move(std::size_t object, std::span<const transport::VertexData> vertices);
    void refit();

    // The first surface that the ray hits by its side rule; false: none.
    [[nodiscard]] bool intersect(const Ray& ray, SurfaceHit& hit) const;

    // The first surface that is hit by light that leaves a point or spot light. A surface that the
    // light lies in, within the rounding of coordinates, does not stand in its way: it is lit at
    // grazing incidence, which is not at all, and throws no shadow.
    [[nodiscard]] bool intersectFromLight(const Ray& ray, SurfaceHit& hit) const;

    // The first triangle on each of the first `count` rays, from whichever side; none: nothing.
    // They are found together, and sooner where they lie next to each other.
    [[nodiscard]] std::array<TriangleId, kRaysTogether> firstTriangles(
        const std::array<OpenRay, kRaysTogether>& rays, int count) const;

    // Which of the first `count` rays something is in the way of, a bit each; as above.
    [[nodiscard]] std::uint32_t blockedRays(const std::array<RayToLight, kRaysTogether>& rays,
                                            int count) const;

    // The first receiver or mirror on the eye's straight ray, dielectrics being invisible to it.
    [[nodiscard]] bool intersectStraight(const glm::dvec3& origin, const glm::dvec3& direction,
                                         SurfaceHit& hit) const;

    // True when no receiver or mirror lies between `from`, a point of the triangle `start`, and
    // `to`, where the share `ignoredEnd` of the path before `to` does not count.
    [[nodiscard]] bool isVisible(const glm::dvec3& from, const TriangleId& start,
                                 const glm::dvec3& to, double ignoredEnd) const;

    // How the interpolated unit normal turns with the position on a triangle, at a point of it,
    // 1/m: maps directions along it, and what is at right angles to it to nothing.
    [[nodiscard]] glm::dmat3 normalTurning(const TriangleId& triangle,
                                           const glm::dvec3& position) const;

    // What uv differs by along the first side of a triangle, 1/m.
    [[nodiscard]] double uvPerMeter(const TriangleId& triangle) const;

    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    [[nodiscard]] const Appearance& appearance() const { return appearance_; }
    [[nodiscard]] const glm::dvec3& center() const { return center_; }
    // That local coordinates may be off by, as 32-bit floats, m.
    [[nodiscard]] double roundingMeters() const { return roundingMeters_; }
    // Local bounds of all meshes as they are now.
    [[nodiscard]] const scene::Bounds& bounds() const { return bounds_; }
    // Corners of all specular triangles, local: what emission aims at.
    [[nodiscard]] const std::vector<glm::dvec3>& specularVertices() const {
        return specularVertices_;
    }
    [[nodiscard]] RTCScene everything() const { return everything_; }

    // What Embree's filters see of an object.
    struct ObjectInfo {
        scene::MaterialKind kind = scene::MaterialKind::lambertian;
        std::uint32_t material = 0;  // index
        bool closed = false;
    };

  private:
    struct ObjectMesh {
        ObjectInfo info;
        bool hasNormalMap = false;
        glm::dmat4 toLocal{1.0};  // from the mesh's space
        glm::dmat3 normalToLocal{1.0};
        // Local; normals by the inverse transpose, not unit, as on the GPU.
        std::vector<transport::VertexData> vertices;
        std::vector<glm::uvec3> triangles;  // a copy: the scene may be read anew
        [[nodiscard]] transport::VertexData placed(const transport::VertexData& vertex) const;
    };
    void addObject(const scene::Object& object);
    void attach(Filters filters, HeightFields heightFields);
    // The normal that light is bent by at a point of a triangle: `weights` of its corners, which
    // add up to 1 and may lie outside of it.
    [[nodiscard]] glm::dvec3 shadingNormal(const ObjectMesh& mesh, const glm::uvec3& corners,
                                           const glm::dvec3& weights,
                                           const glm::dvec3& geometric) const;
    struct Sides;
    [[nodiscard]] static std::optional<Sides> sidesOf(const glm::dvec3& a, const glm::dvec3& b,
                                                      const glm::dvec3& c);
    // `fromFirst`: the point from the triangle's first corner.
    [[nodiscard]] glm::dmat3 mappedTurning(const ObjectMesh& mesh, const glm::uvec3& corners,
                                           const Sides& sides, const glm::dvec3& fromFirst) const;
    void refine(const glm::dvec3& origin, const glm::dvec3& direction, const RTCHit& found, float t,
                SurfaceHit& hit) const;

    const scene::Scene& scene_;
    Appearance appearance_;
    glm::dvec3 center_{0.0};
    scene::Bounds bounds_;
    double roundingMeters_ = 0.0;
    std::vector<std::unique_ptr<ObjectMesh>> objects_;  // addresses stay: Embree reads them
    std::vector<glm::dvec3> specularVertices_;
    RTCDevice device_ = nullptr;
    RTCScene everything_ = nullptr;
    RTCScene opaque_ = nullptr;  // receivers and mirrors
};

}  // namespace kaustik::reference
