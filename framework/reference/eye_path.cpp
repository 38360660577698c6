// SPDX-License-Identifier: MIT
#include "framework/reference/eye_path.h"

#include "framework/reference/light_transport.h"

namespace kaustik::reference {
namespace {

struct PathSink : NullSink {
    void met(const SurfaceHit& hit, const PhotonState&) { length += hit.distance; }
    void arrived(const SurfaceHit& hit, const PhotonState& state) {
        path = {hit, state.direction, state.fluxWatts, length + hit.distance};
        medium = state.media.inner();
    }
    std::optional<EyePath> path;
    std::uint32_t medium = 0;  // around the receiver
    double length = 0.0;
};

}  // namespace

std::optional<EyePath> followEye(const EmbreeScene& scene, const glm::dvec3& origin,
                                 const glm::dvec3& direction, Random& random) {
    const auto indexOf = [&](std::uint32_t medium) {
        return medium == 0 ? 1.0 : static_cast<double>(scene.scene().materials[medium - 1].ior);
    };
    PhotonState state;
    state.origin = origin;
    state.direction = direction;
    state.fluxWatts = glm::dvec3(1.0);
    // An eye that looks at a dielectric from within is inside of it, as a light is.
    SurfaceHit first;
    if (!scene.intersect({origin, direction, {}, 0, SideRule::any}, first)) return std::nullopt;
    const bool isDielectric =
        scene.scene().materials[first.material].kind == scene::MaterialKind::dielectric;
    if (isDielectric && glm::dot(direction, first.geometricNormal) > 0.0)
        state.media.enter(first.material + 1);
    const double indexAtEye = indexOf(state.media.inner());
    PathFilter oneBranch;
    oneBranch.splitInteractions = 0;
    PathSink sink;
    LightTransport(scene, oneBranch).finish(state, nullptr, random, sink);
    if (!sink.path) return std::nullopt;
    // Flux is what a branch keeps; radiance changes by the square of the index too.
    const double ratio = indexAtEye / indexOf(sink.medium);
    sink.path->throughput *= ratio * ratio;
    return sink.path;
}

}  // namespace kaustik::reference
