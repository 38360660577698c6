// SPDX-License-Identifier: MIT
#include "framework/gui/photon_probe.h"

#include <algorithm>

namespace kaustik::gui {
namespace {

using namespace transport;

struct TracedTexels {
    int height = 0;                // rows of the map
    std::vector<float> origin;     // xyz
    std::vector<float> direction;  // w: fate
    std::vector<float> hit;        // xyz
    std::vector<float> flux;       // rgb, w: fate
};

TracedTexels readTexels(const Renderer& renderer, const TraceRecord& record) {
    const Hits& hits = record.hits;
    return {hits.incoming.height, renderer.texture(hits.incoming.position).read(),
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

// Whence the light came to the point where the photon of that row first met a surface.
std::vector<glm::vec3> wayFromLight(const Renderer& renderer, int row, const glm::vec3& point) {
    const std::vector<scene::Light>& lights = renderer.scene().lights;
    const int rows = renderer.traces().front().hits.incoming.rowsPerLight;
    if (rows <= 0 || lights.empty()) return {};
    const auto index = static_cast<std::size_t>(row / rows) % lights.size();
    const LightData light = lightData(lights[index], renderer.view());
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

    // Photons are told by their texel of the last map. Where that has grown by copies of what came
    // before, the first part of a photon's way is its ancestor's.
    const std::size_t count = traced.back().hit.size() / 4;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::ivec2 photon(static_cast<int>(i) % width, static_cast<int>(i) / width);
        if (fateAt(traced.back().direction, i) == kFateNone) continue;
        const auto texelIn = [&](const TracedTexels& texels) {
            return static_cast<std::size_t>(photon.y % texels.height * width + photon.x);
        };
        PhotonPath path;
        // Where it ended its way: the last tracing that it took part in.
        unsigned fate = kFateNone;
        for (const TracedTexels& texels : traced) {
            const std::size_t texel = texelIn(texels);
            if (fateAt(texels.direction, texel) != kFateInFlight) continue;
            fate = fateAt(texels.flux, texel);
            if (fate != kFateReceiver) continue;
            const Projected landing = project(renderer.view(), vectorAt(texels.hit, texel));
            path.pixels = landing.visible ? glm::distance(landing.pixel, middle) : 1e9f;
            path.fluxWatts = vectorAt(texels.flux, texel);
        }
        if (fate != kFateReceiver || !(path.pixels <= radiusPixels)) continue;
        ++probe.landed;
        probe.fluxWatts += path.fluxWatts;
        path.photon = photon;
        for (const TracedTexels& texels : traced) {
            const std::size_t texel = texelIn(texels);
            if (fateAt(texels.direction, texel) != kFateInFlight) continue;
            const glm::vec3 origin = vectorAt(texels.origin, texel);
            if (path.points.empty()) path.points = wayFromLight(renderer, photon.y, origin);
            path.points.push_back(origin);
            const unsigned met = fateAt(texels.flux, texel);
            if (met == kFateReceiver || met == kFateSpecular)
                path.points.push_back(vectorAt(texels.hit, texel));
        }
        probe.paths.push_back(std::move(path));
    }
    std::sort(probe.paths.begin(), probe.paths.end(),
              [](const PhotonPath& a, const PhotonPath& b) { return a.pixels < b.pixels; });
    if (probe.paths.size() > PhotonProbe::kMostPaths) probe.paths.resize(PhotonProbe::kMostPaths);
    return probe;
}

}  // namespace kaustik::gui
