// SPDX-License-Identifier: MIT
#include "framework/report/map_account.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "framework/core/json_schema.h"
#include "framework/render/raster_views.h"
#include "framework/report/seen_receivers.h"
#include "framework/transport/primitives.h"
#include "framework/transport/watts.h"

namespace kaustik::report {

using nlohmann::json;

struct StoredMap {
    std::optional<int> generator;
    std::optional<int> light;
    std::array<int, 2> size{};
    int views = 0;
    std::optional<int> cascade;
};
template <class F>
void reflect(F& f, const StoredMap& map) {
    f.field("generator", map.generator, "The caustic generator that it lies around");
    f.field("light", map.light, "The light whose view it is in");
    f.field("size", map.size, "Width and height in texels");
    f.field("views", map.views, "Pictures that it has, such as a cube's six faces");
    f.field("cascade", map.cascade,
            "Of a further map of a part of the light's view, which of them it is");
}

struct MapTable {
    std::string space;
    std::vector<StoredMap> maps;
    double depositedWatts = 0.0;
    double arrivedWatts = 0.0;
    double storedWatts = 0.0;             // in the maps
    std::optional<double> filteredWatts;  // none without a filter
    double seenWatts = 0.0;
};
template <class F>
void reflect(F& f, const MapTable& table) {
    f.choice("space", table.space, {"screen", "light", "cube"}, "reconstruct.space");
    f.field("maps", table.maps, "By light or generator; of the screen one");
    const auto ratio = [&](const char* key, std::optional<double> part, double whole,
                           const char* sentence) {
        f.fieldOrNull(key, part && whole > 0.0 ? std::optional(*part / whole) : std::nullopt,
                      part ? "no light was stored" : "no filter has changed the map", sentence);
    };
    ratio("flux_ratio", table.depositedWatts, table.arrivedWatts, "Deposited over arrived flux");
    ratio("blend_energy_ratio", table.filteredWatts, table.storedWatts,
          "What a filter left, over the stored flux");
    ratio("seen_ratio", table.seenWatts, table.storedWatts,
          "What the picture shows, over the stored flux");
}

struct CellTable {
    transport::CellCounts counts{};
    std::optional<std::vector<unsigned>> squares;  // where a driver walks over them
};
template <class F>
void reflect(F& f, const CellTable& table) {
    const transport::CellCounts& counts = table.counts;
    f.field("probes", counts.probes, "That were looked at; of `hierarchical` photons that arrived");
    f.field("photons", counts.emitted, "That were emitted, or stored");
    f.field("merged", counts.merged, "Of them those that stand for several cells");
    f.field("discarded", counts.discarded, "Cells that hold nothing specular");
    f.field("deepest_level", counts.deepest, "Of a photon's cell");
    f.field("rounds", counts.rounds, "In which cells were split");
    f.field("batches", counts.batches, "In which photons were followed");
    f.field(
        "squares", table.squares,
        "Of `hierarchical`: squares of 2^i by 2^i cells that the walk from the top of the mip map "
        "has looked at, by i; the first are cells by themselves");
}

namespace {

// Of the flux, that a filter may take or add before a run says so.
constexpr double kMaxBlendLoss = 0.1;

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
    const std::vector<float> receiver =
        seenReceivers(renderer.texture(renderer.outputs().eye.receiver).read(),
                      renderer.view().width, renderer.samplesPerSide());
    double sum = 0.0;
    for (std::size_t pixel = 0; 4 * pixel + 3 < irradiance.size(); ++pixel) {
        const double area = static_cast<double>(receiver[2 * pixel + 1]);
        for (std::size_t c = 0; c < kColors; ++c)
            sum += static_cast<double>(irradiance[4 * pixel + c]) * area;
    }
    return sum / static_cast<double>(transport::kChannels);
}

// Of a sum next to the ledger's accounts (framework/transport/primitives.h).
double wattsOfSum(const Renderer& renderer, unsigned entry) {
    const auto entries = renderer.buffer(renderer.outputs().ledger).read<transport::LedgerEntry>();
    if (entry >= entries.size()) return 0.0;
    const double units = std::ldexp(static_cast<double>(entries[entry].high), 32) +
                         static_cast<double>(entries[entry].low);
    return units * static_cast<double>(ledgerQuantum(renderer.scene())) / transport::kChannels;
}

}  // namespace

json mapAccount(const Renderer& renderer) {
    const std::vector<FluxMap>& maps = renderer.outputs().map.maps;
    if (maps.empty()) return nullptr;
    const bool isOnScreen = maps.front().on.views->isEyeView();
    if (isOnScreen && !maps.front().filtered.valid()) return nullptr;
    const EnergyLedger ledger = renderer.ledger();
    MapTable table;
    table.depositedWatts = ledger.watts[transport::kAccountDeposited];
    table.storedWatts = table.depositedWatts + wattsOfSum(renderer, transport::kSumMapExcess) -
                        wattsOfSum(renderer, transport::kSumMapDeficit);
    table.arrivedWatts = ledger.watts[transport::kAccountArrived];
    const bool isOfGenerators = maps.front().generator >= 0;
    table.space = isOnScreen ? "screen" : isOfGenerators ? "cube" : "light";
    table.filteredWatts = 0.0;
    for (const FluxMap& map : maps) {
        const render::RasterViews& views = *map.on.views;
        StoredMap& stored = table.maps.emplace_back();
        if (!isOnScreen)
            (isOfGenerators ? stored.generator : stored.light) =
                isOfGenerators ? map.generator : map.light;
        stored.size = {views.width(), views.height()};
        stored.views = views.count();
        if (map.cascade > 0) {
            stored.cascade = map.cascade;
        } else if (!map.filtered.valid()) {
            table.filteredWatts.reset();
        } else if (table.filteredWatts) {
            *table.filteredWatts += filteredWatts(renderer, map);
        }
    }
    table.seenWatts = seenWatts(renderer);
    return jsonOf(table);
}

std::optional<std::string> mapWarning(const json& account, const std::string& filter) {
    if (!account.is_object() || !account.at("blend_energy_ratio").is_number()) return {};
    const double ratio = account.at("blend_energy_ratio").get<double>();
    if (std::abs(ratio - 1.0) < kMaxBlendLoss) return {};
    return fmt::format(
        "filter.{} has made {:.3g} of the flux that was deposited (map.blend_energy_ratio): what "
        "it takes from sizes or levels of splats, texel by texel, need not add up to all; take "
        "reconstruct=fixed and filter=none, which keep it.",
        filter, ratio);
}

json mapSchema() {
    return jsonSchemaOf<MapTable>();
}

json cellAccount(const Renderer& renderer) {
    const graph::Buffer<transport::CellCounts>& cells = renderer.outputs().cells;
    if (!cells.valid()) return nullptr;
    CellTable table{renderer.buffer(cells).read<transport::CellCounts>().front(), {}};
    std::vector<unsigned> squares(std::begin(table.counts.squares), std::end(table.counts.squares));
    while (!squares.empty() && squares.back() == 0)
        squares.pop_back();
    if (!squares.empty()) table.squares = std::move(squares);
    return jsonOf(table);
}

json cellSchema() {
    return jsonSchemaOf<CellTable>();
}

PrimitiveFlux primitiveFlux(const Renderer& renderer) {
    return {wattsOfSum(renderer, transport::kSumTriangles),
            wattsOfSum(renderer, transport::kSumBeams)};
}

}  // namespace kaustik::report
