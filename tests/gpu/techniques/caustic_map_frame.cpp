// SPDX-License-Identifier: MIT
#include "tests/gpu/techniques/caustic_map_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"

namespace kaustik::test {
namespace {

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

// Whether photons are counted in the map.
bool hasCounts(const std::string& technique, const Settings& settings) {
    bool has = technique == "multi_resolution";
    for (const auto& [name, value] : settings) {
        if (name == "reconstruct") has = value == "four_radii" || value == "levels";
    }
    return has;
}

numerics::FrameRequest request(const std::string& technique, const Settings& settings,
                               std::size_t lights, bool hasBeams, int width, int height) {
    numerics::FrameRequest request{width, height, settings};
    request.saved = {"eye.receiver", "eye.receiver_surface", "caustic.irradiance", "hits.position",
                     "hits.flux"};
    bool isInMap = true;
    for (const auto& [name, value] : settings)
        isInMap = isInMap && (name != "reconstruct.space" || value == "light");
    if (isInMap) request.saved.emplace_back("caustic.flux");
    for (std::size_t light = 1; isInMap && light < lights; ++light)
        request.saved.emplace_back(fmt::format("caustic.flux.light_{}", light + 1));
    if (hasCounts(technique, settings)) request.saved.emplace_back("caustic.flux_counts");
    if (hasBeams) request.saved.insert(request.saved.end(), {"photons.place_1", "photons.turn_1"});
    request.recordsTraces = true;
    return request;
}

}  // namespace

double MapPhoton::widthAfter(double distance) const {
    return std::sqrt(std::abs(glm::determinant(place + distance * turn)));
}

glm::dvec3 MapTexels::sum() const {
    glm::dvec3 total(0.0);
    for (const glm::dvec3& one : flux)
        total += one;
    return total;
}

MapFrame::MapFrame(const scene::Scene& scene, const std::string& technique,
                   const Settings& settings, bool hasBeams, int width, int height)
    : numerics::Frame(context(), registry(), scene, registry().findTechnique(technique),
                      request(technique, settings, scene.lights.size(), hasBeams, width, height)),
      hasBeams_(hasBeams) {}

std::vector<MapPhoton> MapFrame::photons() const {
    const Hits& hits = renderer().traces().front().hits;
    const std::vector<PhotonTexel> traced = readPhotons(renderer(), hits.incoming);
    const std::vector<HitTexel> found = readHits(renderer(), hits);
    const std::vector<float> before = read("hits.position").values;
    const std::vector<float> fluxBefore = read("hits.flux").values;
    std::vector<float> place;
    std::vector<float> turn;
    if (hasBeams_) {
        place = read("photons.place_1").values;
        turn = read("photons.turn_1").values;
    }
    const glm::dmat3 toWorldAxes = glm::transpose(glm::dmat3(view().worldToView));
    std::vector<MapPhoton> photons(traced.size());
    for (std::size_t i = 0; i < photons.size(); ++i) {
        MapPhoton& photon = photons[i];
        const std::size_t parent = 4 * std::size_t{traced[i].origin.parent};
        photon.cell = traced[i].origin.cell;
        photon.isReflected = (traced[i].origin.path & 1U) == 1U;
        photon.entry = toWorld(glm::vec3(before[parent], before[parent + 1], before[parent + 2]));
        photon.entryFlux = {fluxBefore[parent], fluxBefore[parent + 1], fluxBefore[parent + 2]};
        photon.position = toWorld(traced[i].position);
        photon.direction = toWorldAxes * glm::dvec3(traced[i].direction);
        photon.flux = traced[i].fluxWatts;
        photon.fate = traced[i].fate;
        photon.hitFate = found[i].fate;
        photon.hit = toWorld(found[i].position);
        photon.hitFlux = found[i].fluxWatts;
        if (!hasBeams_) continue;
        const std::size_t k = 4 * i;
        photon.place = {{place[k], place[k + 1]}, {place[k + 2], place[k + 3]}};
        photon.turn = {{turn[k], turn[k + 1]}, {turn[k + 2], turn[k + 3]}};
    }
    return photons;
}

const FluxMap& MapFrame::map(std::size_t light) const {
    return renderer().outputs().map.maps[light];
}

MapTexels MapFrame::filtered(int view, std::size_t light) const {
    const FluxMap& map = renderer().outputs().map.maps[light];
    const Texels read = this->read(map.filtered, view * map.filteredPerView());
    MapTexels texels{read.width, read.height, {}};
    for (int y = 0; y < read.height; ++y) {
        for (int x = 0; x < read.width; ++x)
            texels.flux.push_back(read.rgb(x, y));
    }
    return texels;
}

std::vector<std::uint32_t> MapFrame::counts(int set, std::size_t light) const {
    const FluxMap& map = this->map(light);
    const std::vector<std::uint32_t> all = renderer().texture(map.counts).readWords();
    const auto layer = static_cast<std::ptrdiff_t>(map.on.views->width()) * map.on.views->height();
    return {all.begin() + set * layer, all.begin() + (set + 1) * layer};
}

std::vector<std::uint32_t> MapFrame::words() const {
    std::vector<std::uint32_t> all;
    for (const FluxMap& map : renderer().outputs().map.maps) {
        const std::vector<std::uint32_t> words = renderer().texture(map.flux).readWords();
        all.insert(all.end(), words.begin(), words.end());
    }
    return all;
}

double MapFrame::watts(std::uint32_t account) const {
    return renderer().ledger().watts[account];
}

void MapFrame::expectBalance() const {
    using namespace transport;
    const EnergyLedger ledger = renderer().ledger();
    EXPECT_GT(ledger.watts[kAccountEmitted], 0.0);
    EXPECT_LE(std::abs(ledger.balance()), 1e-6);
    EXPECT_NEAR(ledger.watts[kAccountDeposited] + ledger.watts[kAccountOutsideMap] +
                    ledger.watts[kAccountHiddenInMap] + ledger.watts[kAccountEdgeOn] -
                    renderer().ledger(renderer().traces().front().after).watts[kAccountOutsideMap] -
                    renderer().ledger(renderer().traces().front().after).watts[kAccountHiddenInMap],
                ledger.watts[kAccountArrived], 1e-6 * ledger.watts[kAccountArrived]);
}

MapTexels storedIn(const numerics::Frame& frame, int set, int view, std::size_t light) {
    const FluxMap& map = frame.renderer().outputs().map.maps[light];
    const std::vector<std::uint32_t> words = frame.renderer().texture(map.flux).readWords();
    MapTexels texels{map.on.views->width(), map.on.views->height(), {}};
    const auto layer =
        static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height);
    const double unit = mapUnit(frame.renderer().scene());
    const auto first = static_cast<std::size_t>(static_cast<int>(transport::kFluxWords) *
                                                (view * map.sets.perView() + set));
    for (std::size_t i = 0; i < layer; ++i) {
        glm::dvec3 flux(0.0);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t low = (first + 2 * c) * layer + i;
            flux[static_cast<int>(c)] =
                (4294967296.0 * words[low + layer] + double(words[low])) * unit;
        }
        texels.flux.push_back(flux);
    }
    return texels;
}

const render::RasterView& mapViewOf(const numerics::Frame& frame, int view, std::size_t light) {
    return frame.renderer().outputs().map.maps[light].on.views->view(view);
}

glm::dvec2 texelOn(const render::RasterView& view, const glm::dvec3& world) {
    const glm::dvec3 point(view.worldToView * glm::dvec4(world, 1.0));
    const double depth = view.isOrthographic ? 1.0 : -point.z;
    const glm::dvec2 size(view.width, view.height);
    return (0.5 + 0.5 * glm::dvec2(point) / (depth * view.halfExtent)) * size;
}

glm::dvec3 placeBefore(const render::RasterView& view, const glm::dvec2& texel, double depth) {
    const glm::dvec2 size(view.width, view.height);
    const glm::dvec2 across =
        (2.0 * texel / size - 1.0) * view.halfExtent * (view.isOrthographic ? 1.0 : depth);
    return glm::dvec3(glm::inverse(view.worldToView) * glm::dvec4(across, -depth, 1.0));
}

double mapUnit(const scene::Scene& scene) {
    return double{ledgerQuantum(scene)};
}

double transmittance(double cosine, double from, double to) {
    const double sine = from / to * std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    if (sine >= 1.0) return 0.0;
    const double beyond = std::sqrt(1.0 - sine * sine);
    const double s = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    const double p = (to * cosine - from * beyond) / (to * cosine + from * beyond);
    return 1.0 - 0.5 * (s * s + p * p);
}

glm::dvec3 refractedBy(const glm::dvec3& direction, const glm::dvec3& normal, double from,
                       double to) {
    const double eta = from / to;
    const double cosine = -glm::dot(direction, normal);
    const double k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if (k < 0.0) return glm::dvec3(0.0);
    return eta * direction + (eta * cosine - std::sqrt(k)) * normal;
}

}  // namespace kaustik::test
