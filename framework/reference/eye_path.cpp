// SPDX-License-Identifier: MIT
#include "framework/reference/eye_path.h"

namespace kaustik::reference {
namespace {

struct PathSink : NullSink {
    void hitSurface(const SurfaceHit& hit, const PhotonState&) { length += hit.distance; }
    void arrived(const SurfaceHit& hit, const PhotonState& state) {
        path = {hit, state.direction, state.fluxWatts, length + hit.distance};
        medium = state.media.inner();
    }
    std::optional<EyePath> path;
    std::uint32_t medium = 0;  // around the receiver
    double length = 0.0;
};

}  // namespace

double mediumIndex(const scene::Scene& scene, std::uint32_t medium) {
    return medium == 0 ? 1.0 : static_cast<double>(scene.materials[medium - 1].ior);
}

std::optional<PhotonState> startAtEye(const EmbreeScene& scene, const glm::dvec3& origin,
                                      const glm::dvec3& direction) {
    SurfaceHit first;
    if (!scene.intersect({origin, direction, {}, {}, SideRule::any}, first)) return std::nullopt;
    PhotonState state;
    state.origin = origin;
    state.direction = direction;
    state.fluxWatts = glm::dvec3(1.0);
    const bool isDielectric =
        scene.scene().materials[first.material].kind == scene::MaterialKind::dielectric;
    if (isDielectric && glm::dot(direction, first.geometricNormal) > 0.0)
        state.media.enter(first.material + 1);
    return state;
}

std::optional<EyePath> followEye(const EmbreeScene& scene, const glm::dvec3& origin,
                                 const glm::dvec3& direction, Random& random) {
    const std::optional<PhotonState> state = startAtEye(scene, origin, direction);
    if (!state) return std::nullopt;
    PathFilter oneBranch;
    oneBranch.splitInteractions = 0;
    PathSink sink;
    LightTransport(scene, oneBranch).finish(*state, nullptr, random, sink);
    if (!sink.path) return std::nullopt;
    // Flux is what a branch keeps; radiance changes by the square of the index too.
    const double ratio =
        mediumIndex(scene.scene(), state->media.inner()) / mediumIndex(scene.scene(), sink.medium);
    sink.path->throughput *= ratio * ratio;
    return sink.path;
}

}  // namespace kaustik::reference
