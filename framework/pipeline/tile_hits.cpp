// SPDX-License-Identifier: MIT
#include "framework/pipeline/tile_hits.h"

#include <fmt/format.h>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/pipeline/renderer.h"

namespace kaustik {
namespace {

// The rows of a list's textures that hold photons.
int rowsOf(std::size_t count, int width) {
    const auto length = static_cast<std::size_t>(width);
    return static_cast<int>((count + length - 1) / length);
}

// The same where a list holds the same photons, to the bit.
std::string raysOf(std::size_t count, const std::vector<std::vector<glm::vec4>>& texels) {
    ContentHash hash;
    for (const std::vector<glm::vec4>& rows : texels)
        hash.addAll(std::vector<glm::vec4>(rows.begin(),
                                           rows.begin() + static_cast<std::ptrdiff_t>(count)));
    return hash.hex();
}

void requireSameRays(const Photons& photons, const FirstHits& known, std::size_t count,
                     gl::PassContext& context, int rows) {
    if (count == 0 && known.photons == 0) return;
    const std::string rays = raysOf(count, {context.texture(photons.position).readRows(rows),
                                            context.texture(photons.direction).readRows(rows),
                                            context.texture(photons.flux).readRows(rows)});
    if (count == known.photons && rays == known.rays) return;
    throw IoError(fmt::format(
        "--tiles: the tiles' hits are of {} photons, and these {} are others; trace the tiles "
        "again, on the device that makes the picture.",
        known.photons, count));
}

void writeHits(const Hits& hits, const FirstHits& known, gl::PassContext& context) {
    const Photons& photons = hits.incoming;
    const auto count = static_cast<std::size_t>(
        context.buffer(photons.list).read<transport::PhotonList>().front().count);
    const int rows = rowsOf(count, photons.width);
    requireSameRays(photons, known, count, context, rows);
    const std::size_t texels =
        static_cast<std::size_t>(rows) * static_cast<std::size_t>(photons.width);
    std::vector<glm::vec4> position(texels, glm::vec4(0.0f));
    std::vector<glm::vec4> surface = position;
    std::vector<glm::vec4> shape = position;
    const glm::vec4 nothing(0.0f, 0.0f, 0.0f, static_cast<float>(transport::kFateEnded));
    std::vector<glm::vec4> flux(texels, nothing);
    for (const FirstHitTexels& hit : known.hits) {
        position[hit.photon] = hit.position;
        surface[hit.photon] = hit.surface;
        flux[hit.photon] = hit.flux;
        shape[hit.photon] = hit.shape;
    }
    context.texture(hits.position).writeRows(position);
    context.texture(hits.surface).writeRows(surface);
    context.texture(hits.flux).writeRows(flux);
    if (hits.shape.valid()) context.texture(hits.shape).writeRows(shape);
}

}  // namespace

Hits loadHits(FrameBuilder& frame, const Photons& photons, const FirstHits& known) {
    return frame.pass<Hits>(
        "trace.tiles", "first hits that were found on tiles of the screen",
        [&](graph::PassSetup& setup, Hits& hits) {
            photons.sample(setup);
            hits = Hits::create(setup, photons);
            hits.incoming.account(setup);
            hits.store(setup);
        },
        [known](const Hits& hits, gl::PassContext& context) {
            writeHits(hits, known, context);
            dispatchOver(context.compute("framework/tile_hits.comp"), hits.incoming);
        });
}

FirstHits readFirstHits(const Renderer& renderer, const Hits& hits) {
    const Photons& photons = hits.incoming;
    FirstHits found;
    found.photons = renderer.buffer(photons.list).read<transport::PhotonList>().front().count;
    const int rows = rowsOf(found.photons, photons.width);
    const auto read = [&](const graph::ResourceRef& handle) {
        return renderer.texture(handle).readRows(rows);
    };
    found.rays = raysOf(found.photons,
                        {read(photons.position), read(photons.direction), read(photons.flux)});
    const std::vector<std::uint32_t> orders = renderer.texture(hits.order).readWords();
    const std::vector<glm::vec4> position = read(hits.position);
    const std::vector<glm::vec4> surface = read(hits.surface);
    const std::vector<glm::vec4> flux = read(hits.flux);
    const std::vector<glm::vec4> shape =
        hits.shape.valid() ? read(hits.shape) : std::vector<glm::vec4>(position.size());
    for (std::uint32_t i = 0; i < found.photons; ++i) {
        const std::uint32_t order = orders[4 * std::size_t{i}];
        if (order == 0) continue;
        const std::uint32_t step = orders[4 * std::size_t{i} + 1] & ~transport::kStrayed;
        found.hits.push_back({i, order, step, position[i], surface[i], flux[i], shape[i]});
    }
    return found;
}

TileSearch readTileSearch(const Renderer& renderer, const Hits& hits) {
    TileSearch search;
    const auto count =
        renderer.buffer(hits.incoming.list).read<transport::PhotonList>().front().count;
    const std::vector<std::uint32_t> orders = renderer.texture(hits.order).readWords();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t* const words = &orders[4 * i];
        search.photons += words[2] + words[3] > 0 ? 1 : 0;
        search.steps += words[2];
        search.squares += words[3];
        search.strayed += (words[1] & transport::kStrayed) != 0 ? 1 : 0;
    }
    return search;
}

}  // namespace kaustik
