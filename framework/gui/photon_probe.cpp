// SPDX-License-Identifier: MIT
#include "framework/gui/photon_probe.h"

#include <algorithm>

#include "framework/pipeline/photon_texels.h"
#include "framework/pipeline/tracing_log.h"

namespace kaustik::gui {
namespace {

using namespace transport;

struct Tracing {
    std::vector<PhotonTexel> photons;
    std::vector<HitTexel> hits;
};

// Whence the light came to the point where the photon first hit a surface.
std::vector<glm::vec3> pathFromLight(const Renderer& renderer, const PhotonTexel& photon) {
    const std::vector<scene::Light>& lights = renderer.scene().lights;
    if (photon.origin.light >= lights.size()) return {};
    const LightData light = lightData(lights[photon.origin.light], renderer.view());
    if (light.positionVs.w != static_cast<float>(kLightDirectional))
        return {glm::vec3(light.positionVs)};
    const scene::Bounds bounds = sceneBounds(renderer.scene());
    const auto reach = static_cast<float>(glm::length(bounds.maximum - bounds.minimum));
    return {photon.position - 0.5f * reach * glm::vec3(light.directionVs)};
}

// From the light to where photon `index` of tracing `last` landed: each list says which photon of
// the one before its photons come from.
std::vector<glm::vec3> pathOf(const Renderer& renderer, const std::vector<Tracing>& tracings,
                              std::size_t last, std::size_t index) {
    std::vector<glm::vec3> back = {tracings[last].hits[index].position};
    for (std::size_t i = last + 1; i-- > 0;) {
        const PhotonTexel& photon = tracings[i].photons[index];
        back.push_back(photon.position);
        if (i == 0) {
            for (const glm::vec3& point : pathFromLight(renderer, photon))
                back.push_back(point);
        }
        index = photon.origin.parent;
        if (i > 0 && index >= tracings[i - 1].photons.size()) break;
    }
    return {back.rbegin(), back.rend()};
}

}  // namespace

Projected project(const render::RasterView& view, const glm::vec3& pointVs) {
    if (!(-double(pointVs.z) >= view.nearMeters)) return {};
    const glm::dvec2 pixel = pixelOf(view, pointVs).value();
    return {glm::vec2(pixel.x, view.height - pixel.y), true};
}

PhotonProbe probePhotons(const Renderer& renderer, glm::ivec2 pixel, float radiusPixels) {
    PhotonProbe probe;
    probe.pixel = pixel;
    probe.radiusPixels = radiusPixels;
    std::vector<Tracing> tracings;
    for (const TraceRecord& record : renderer.traces()) {
        tracings.push_back(
            {readPhotons(renderer, record.hits.incoming), readHits(renderer, record.hits)});
        if (record.log) probe.overwritten += record.log->beforeLast;
    }
    const glm::vec2 middle = glm::vec2(pixel) + 0.5f;
    const render::RasterView view = renderer.pictureView();
    for (std::size_t tracing = 0; tracing < tracings.size(); ++tracing) {
        const Tracing& traced = tracings[tracing];
        for (std::size_t i = 0; i < traced.hits.size(); ++i) {
            const HitTexel& hit = traced.hits[i];
            if (traced.photons[i].fate != kFateInFlight || hit.fate != kFateReceiver) continue;
            const Projected landing = project(view, hit.position);
            PhotonPath path;
            path.pixels = landing.visible ? glm::distance(landing.pixel, middle) : 1e9f;
            if (!(path.pixels <= radiusPixels)) continue;
            path.origin = traced.photons[i].origin;
            path.fluxWatts = hit.fluxWatts;
            path.points = pathOf(renderer, tracings, tracing, i);
            ++probe.landed;
            probe.fluxWatts += path.fluxWatts;
            probe.paths.push_back(std::move(path));
        }
    }
    std::sort(probe.paths.begin(), probe.paths.end(),
              [](const PhotonPath& a, const PhotonPath& b) { return a.pixels < b.pixels; });
    if (probe.paths.size() > PhotonProbe::kMaxPaths) probe.paths.resize(PhotonProbe::kMaxPaths);
    return probe;
}

}  // namespace kaustik::gui
