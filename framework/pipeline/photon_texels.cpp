// SPDX-License-Identifier: MIT
#include "framework/pipeline/photon_texels.h"

namespace kaustik {
namespace {

struct Texels {
    std::vector<glm::vec4> values;
    [[nodiscard]] glm::vec3 xyz(std::size_t i) const { return values[i]; }
    [[nodiscard]] float w(std::size_t i) const { return values[i].w; }
    [[nodiscard]] std::uint32_t word(std::size_t i) const {
        return w(i) >= 0.0f && w(i) < 4.2e9f ? static_cast<std::uint32_t>(w(i)) : kNoWord;
    }
};

// The rows that hold the first `count` texels. A Source is a renderer or the context of a pass.
template <class Source>
Texels read(const Source& source, const graph::ResourceRef& handle, std::size_t count) {
    const gl::Texture& texture = source.texture(handle);
    const auto width = static_cast<std::size_t>(texture.desc().width);
    return {texture.readRows(static_cast<int>((count + width - 1) / width))};
}

template <class Source>
std::size_t countOf(const Source& source, const Photons& photons) {
    return source.buffer(photons.list).template read<transport::PhotonList>().front().count;
}

template <class Source>
std::vector<PhotonTexel> photonsFrom(const Source& source, const Photons& photons) {
    std::vector<PhotonTexel> list(countOf(source, photons));
    const Texels position = read(source, photons.position, list.size());
    const Texels direction = read(source, photons.direction, list.size());
    const Texels flux = read(source, photons.flux, list.size());
    const std::vector<std::uint32_t> origin = source.texture(photons.origin).readWords();
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

template <class Source>
std::vector<HitTexel> hitsFrom(const Source& source, const Hits& hits) {
    std::vector<HitTexel> list(countOf(source, hits.incoming));
    const Texels position = read(source, hits.position, list.size());
    const Texels surface = read(source, hits.surface, list.size());
    const Texels flux = read(source, hits.flux, list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i] = {position.xyz(i), position.w(i), surface.xyz(i),
                   surface.word(i), flux.xyz(i),   flux.word(i)};
    }
    return list;
}

}  // namespace

std::vector<PhotonTexel> readPhotons(const Renderer& renderer, const Photons& photons) {
    return photonsFrom(renderer, photons);
}

std::vector<PhotonTexel> readPhotons(const gl::PassContext& context, const Photons& photons) {
    return photonsFrom(context, photons);
}

std::vector<HitTexel> readHits(const Renderer& renderer, const Hits& hits) {
    return hitsFrom(renderer, hits);
}

std::vector<HitTexel> readHits(const gl::PassContext& context, const Hits& hits) {
    return hitsFrom(context, hits);
}

std::vector<graph::ResourceRef> texelsOf(const Hits& hits) {
    const Photons& photons = hits.incoming;
    return {hits.position,     hits.surface, hits.flux,      photons.position,
            photons.direction, photons.flux, photons.origin, photons.list};
}

}  // namespace kaustik
