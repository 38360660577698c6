// SPDX-License-Identifier: MIT
#include "framework/report/map_account.h"

#include <nlohmann/json.hpp>

#include "framework/render/raster_views.h"
#include "framework/transport/watts.h"

namespace kaustik::report {
namespace {

using nlohmann::json;

constexpr auto kColors = static_cast<std::size_t>(transport::kChannels);

// W that a filter has left, the mean of the channels.
double filteredWatts(const Renderer& renderer, const FluxMap& map) {
    const gl::Texture& texture = renderer.texture(map.filtered);
    const std::vector<float> texels = texture.read();
    const std::size_t layer = 4 * static_cast<std::size_t>(texture.desc().width) *
                              static_cast<std::size_t>(texture.desc().height);
    double sum = 0.0;
    for (int view = 0; view < map.on.views->count(); ++view) {
        const std::size_t begin = layer * static_cast<std::size_t>(view * map.filteredPerView());
        for (std::size_t i = begin; i < begin + layer; i += 4) {
            for (std::size_t c = 0; c < kColors; ++c)
                sum += static_cast<double>(texels[i + c]);
        }
    }
    return sum / static_cast<double>(transport::kChannels);
}

// W that the picture shows of it.
double seenWatts(const Renderer& renderer) {
    const std::vector<float> irradiance =
        renderer.texture(renderer.outputs().caustic.irradiance).read();
    const std::vector<float> receiver = renderer.texture(renderer.outputs().eye.receiver).read();
    double sum = 0.0;
    for (std::size_t pixel = 0; 4 * pixel + 3 < irradiance.size(); ++pixel) {
        const double area = static_cast<double>(receiver[2 * pixel + 1]);
        for (std::size_t c = 0; c < kColors; ++c)
            sum += static_cast<double>(irradiance[4 * pixel + c]) * area;
    }
    return sum / static_cast<double>(transport::kChannels);
}

}  // namespace

json mapAccount(const Renderer& renderer) {
    const std::vector<FluxMap>& maps = renderer.outputs().map.maps;
    if (maps.empty() || maps.front().on.views->isEyes()) return nullptr;
    const EnergyLedger ledger = renderer.ledger();
    const double deposited = ledger.watts[transport::kAccountDeposited];
    const double arrived = ledger.watts[transport::kAccountArrived];
    const bool isOfGenerators = maps.front().generator >= 0;
    json account{{"space", isOfGenerators ? "cube" : "light"}, {"maps", json::array()}};
    double filtered = 0.0;
    bool isFiltered = true;
    for (const FluxMap& map : maps) {
        const render::RasterViews& views = *map.on.views;
        account["maps"].push_back(
            {{isOfGenerators ? "generator" : "light", isOfGenerators ? map.generator : map.light},
             {"size", {views.width(), views.height()}},
             {"views", views.count()}});
        if (map.cascade > 0) {
            account["maps"].back()["cascade"] = map.cascade;
            continue;
        }
        isFiltered = isFiltered && map.filtered.valid();
        if (isFiltered) filtered += filteredWatts(renderer, map);
    }
    const auto ratio = [&](const char* key, double part, double whole, bool isThere,
                           const char* reason) {
        const bool has = isThere && whole > 0.0;
        account[key] = has ? json(part / whole) : json();
        if (!has) account["reasons"][key] = isThere ? "no light was stored" : reason;
    };
    ratio("flux_ratio", deposited, arrived, true, "");
    ratio("blend_energy_ratio", filtered, deposited, isFiltered, "no filter has changed the map");
    ratio("seen_ratio", seenWatts(renderer), deposited, true, "");
    return account;
}

json cellAccount(const Renderer& renderer) {
    const graph::Buffer<transport::CellCounts>& cells = renderer.outputs().cells;
    if (!cells.valid()) return nullptr;
    const transport::CellCounts counts =
        renderer.buffer(cells).read<transport::CellCounts>().front();
    return {{"probes", counts.probes},         {"photons", counts.emitted},
            {"merged", counts.merged},         {"discarded", counts.discarded},
            {"deepest_level", counts.deepest}, {"rounds", counts.rounds},
            {"batches", counts.batches}};
}

}  // namespace kaustik::report
