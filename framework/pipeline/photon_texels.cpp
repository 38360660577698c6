// SPDX-License-Identifier: MIT
#include "framework/pipeline/photon_texels.h"

namespace kaustik {
namespace {

struct Texels {
    std::vector<float> values;
    [[nodiscard]] glm::vec3 xyz(std::size_t i) const {
        return {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
    }
    [[nodiscard]] float w(std::size_t i) const { return values[4 * i + 3]; }
    [[nodiscard]] std::uint32_t word(std::size_t i) const {
        return w(i) >= 0.0f && w(i) < 4.2e9f ? static_cast<std::uint32_t>(w(i)) : kNoWord;
    }
};

Texels read(const Renderer& renderer, const graph::ResourceRef& handle) {
    return {renderer.texture(handle).read()};
}

std::size_t countOf(const Renderer& renderer, const Photons& photons) {
    return renderer.buffer(photons.list).read<transport::PhotonList>().front().count;
}

}  // namespace

std::vector<PhotonTexel> readPhotons(const Renderer& renderer, const Photons& photons) {
    const Texels position = read(renderer, photons.position);
    const Texels direction = read(renderer, photons.direction);
    const Texels flux = read(renderer, photons.flux);
    const std::vector<std::uint32_t> origin = renderer.texture(photons.origin).readWords();
    std::vector<PhotonTexel> list(countOf(renderer, photons));
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i] = {position.xyz(i),
                   position.w(i),
                   direction.xyz(i),
                   direction.word(i),
                   flux.xyz(i),
                   flux.word(i),
                   {origin[4 * i], origin[4 * i + 1] & 0xffffU, origin[4 * i + 2],
                    origin[4 * i + 3], origin[4 * i + 1] >> 16U}};
    }
    return list;
}

std::vector<HitTexel> readHits(const Renderer& renderer, const Hits& hits) {
    const Texels position = read(renderer, hits.position);
    const Texels surface = read(renderer, hits.surface);
    const Texels flux = read(renderer, hits.flux);
    std::vector<HitTexel> list(countOf(renderer, hits.incoming));
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i] = {position.xyz(i), position.w(i), surface.xyz(i),
                   surface.word(i), flux.xyz(i),   flux.word(i)};
    }
    return list;
}

}  // namespace kaustik
