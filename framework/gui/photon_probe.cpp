// SPDX-License-Identifier: MIT
#include "framework/gui/photon_probe.h"

#include <algorithm>

namespace kaustik::gui {
namespace {

using namespace transport;

struct TracedTexels {
    std::vector<float> origin;     // xyz
    std::vector<float> direction;  // w: fate
    std::vector<float> hit;        // xyz
    std::vector<float> flux;       // rgb, w: fate
};

TracedTexels readTexels(const Renderer& renderer, const TraceRecord& record) {
    const Hits& hits = record.hits;
    return {renderer.texture(hits.incoming.position).read(),
            renderer.texture(hits.incoming.direction).read(),
            renderer.texture(hits.position).read(), renderer.texture(hits.flux).read()};
}

glm::vec3 vectorAt(const std::vector<float>& texels, std::size_t i) {
    return {texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]};
}
unsigned fateAt(const std::vector<float>& texels, std::size_t i) {
    const float fate = texels[4 * i + 3];
    return fate >= 0.0f && fate < 16.0f ? static_cast<unsigned>(fate) : kFateNone;
}

// Whence the light came to a point: only a single light's way is known.
std::vector<glm::vec3> wayFromLight(const Renderer& renderer, const glm::vec3& point) {
    const std::vector<scene::Light>& lights = renderer.scene().lights;
    if (lights.size() != 1) return {};
    const LightData light = lightData(lights.front(), renderer.view());
    if (light.positionVs.w != static_cast<float>(kLightDirectional))
        return {glm::vec3(light.positionVs)};
    const scene::Bounds bounds = sceneBounds(renderer.scene());
    const auto reach = static_cast<float>(glm::length(bounds.maximum - bounds.minimum));
    return {point - 0.5f * reach * glm::vec3(light.directionVs)};
}

}  // namespace

Projected project(const render::EyeView& view, const glm::vec3& pointVs) {
    if (!(-double(pointVs.z) >= view.nearMeters)) return {};
    const glm::dvec2 pixel = pixelOf(view, pointVs).value();
    return {glm::vec2(pixel.x, view.height - pixel.y), true};
}

PhotonProbe probePhotons(const Renderer& renderer, glm::ivec2 pixel, float radiusPixels) {
    PhotonProbe probe;
    probe.pixel = pixel;
    probe.radiusPixels = radiusPixels;
    if (renderer.traces().empty()) return probe;
    std::vector<TracedTexels> traced;
    for (const TraceRecord& record : renderer.traces())
        traced.push_back(readTexels(renderer, record));
    const int width = renderer.traces().front().hits.incoming.width;
    const glm::vec2 middle = glm::vec2(pixel) + 0.5f;

    // Where each photon ended its way: the last tracing that it took part in.
    const std::size_t count = traced.front().hit.size() / 4;
    for (std::size_t i = 0; i < count; ++i) {
        PhotonPath path;
        unsigned fate = kFateNone;
        for (const TracedTexels& texels : traced) {
            if (fateAt(texels.direction, i) != kFateInFlight) continue;
            fate = fateAt(texels.flux, i);
            if (fate != kFateReceiver) continue;
            const Projected landing = project(renderer.view(), vectorAt(texels.hit, i));
            path.pixels = landing.visible ? glm::distance(landing.pixel, middle) : 1e9f;
            path.fluxWatts = vectorAt(texels.flux, i);
        }
        if (fate != kFateReceiver || !(path.pixels <= radiusPixels)) continue;
        ++probe.landed;
        probe.fluxWatts += path.fluxWatts;
        path.photon = {static_cast<int>(i) % width, static_cast<int>(i) / width};
        for (const TracedTexels& texels : traced) {
            if (fateAt(texels.direction, i) != kFateInFlight) continue;
            const glm::vec3 origin = vectorAt(texels.origin, i);
            if (path.points.empty()) path.points = wayFromLight(renderer, origin);
            path.points.push_back(origin);
            const unsigned met = fateAt(texels.flux, i);
            if (met == kFateReceiver || met == kFateSpecular)
                path.points.push_back(vectorAt(texels.hit, i));
        }
        probe.paths.push_back(std::move(path));
    }
    std::sort(probe.paths.begin(), probe.paths.end(),
              [](const PhotonPath& a, const PhotonPath& b) { return a.pixels < b.pixels; });
    if (probe.paths.size() > PhotonProbe::kMostPaths) probe.paths.resize(PhotonProbe::kMostPaths);
    return probe;
}

}  // namespace kaustik::gui
