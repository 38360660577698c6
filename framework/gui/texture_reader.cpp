// SPDX-License-Identifier: MIT
#include "framework/gui/texture_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "framework/gl/objects.h"
#include "framework/pipeline/ledger.h"
#include "framework/render/raster_views.h"
#include "framework/run/output.h"

namespace kaustik::gui {
namespace {

constexpr int kFaces = 6;

// By face, where it is in the cross, in faces.
struct Face {
    const char* name;
    int column;
    int row;
};
constexpr std::array<Face, kFaces> kCross = {
    {{"+x", 2, 1}, {"-x", 0, 1}, {"+y", 3, 0}, {"-y", 1, 2}, {"+z", 3, 1}, {"-z", 1, 1}}};

// What is known of a map of light from the frame's outputs; null for other textures.
const FluxMap* mapOf(const Renderer& renderer, const std::string& name) {
    const auto has = [&](const auto& handle) {
        return handle.valid() && renderer.graph().nameOf(handle) == name;
    };
    for (const FluxMap& map : renderer.outputs().map.maps) {
        if (has(map.flux) || has(map.counts) || has(map.filtered)) return &map;
    }
    return nullptr;
}

std::vector<std::string> lightNames(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const scene::Light& light : scene.lights) {
        if (light.band == 0) names.push_back(light.name);
    }
    return names;
}

std::string nameOfLight(const std::vector<std::string>& lights, int index) {
    const auto place = static_cast<std::size_t>(index);
    return place < lights.size() ? fmt::format("light '{}'", lights[place])
                                 : fmt::format("light {}", index + 1);
}

// The light that a texture's name ends in, as ".light_2"; the first one's has no such end.
int lightOfName(const std::string& name) {
    const std::size_t at = name.find(".light_");
    return at == std::string::npos ? 0 : std::max(std::atoi(name.c_str() + at + 7) - 1, 0);
}

// What is in one set of a map.
std::string nameOfSet(const FluxSets& sets, int set) {
    const int flux = sets.flux();
    const std::string which =
        sets.layout == SetLayout::sizes ? fmt::format("splats of size {}", set % flux + 1)
        : sets.layout == SetLayout::levels
            ? (set % flux == 0 ? "the finest level" : "coarser levels")
        : sets.layout == SetLayout::sharedLevels
            ? (set % flux == 0 ? "light of the finest level" : "light of coarser levels")
            : "all light";
    if (set < flux) return which;
    return which + (sets.hasIntensity() ? ", intensity to the eye" : ", directions");
}

// How the layers of an array are shared out.
struct Layering {
    int faces = 1;
    int words = 1;  // of a sum
    int shown = 1;  // layers that can be chosen
    [[nodiscard]] int stored(int face, int layer, int word) const {
        return (face * shown + layer) * words + word;
    }
};

Layering layeringOf(const TextureContent& content, const FluxMap* map,
                    const graph::TextureDesc& desc, bool isCube) {
    Layering layering;
    const int all = std::max(desc.layers, 1);
    const int views = map != nullptr ? map->on.views->count() : isCube ? kFaces : 1;
    layering.faces = views == kFaces && all % kFaces == 0 ? kFaces : 1;
    constexpr auto kWords = static_cast<int>(transport::kFluxWords);
    if (content.kind == ValueKind::sums && all % (kWords * layering.faces) == 0)
        layering.words = kWords;
    layering.shown = all / (layering.faces * layering.words);
    return layering;
}

std::vector<std::string> namesOfLayers(const Renderer& renderer, const std::string& name,
                                       const FluxMap* map, const Layering& layering) {
    const std::vector<std::string> lights = lightNames(renderer.scene());
    std::vector<std::string> names;
    if (layering.shown < 2) return names;
    const bool isByLight =
        name == "shadow.visibility" ||
        (name == "shadow.maps" && layering.shown == static_cast<int>(lights.size()));
    for (int layer = 0; layer < layering.shown; ++layer) {
        if (map != nullptr && name.find("filtered") == std::string::npos) {
            names.push_back(nameOfSet(map->sets, layer));
        } else if (map != nullptr) {
            names.push_back(layer == 0                 ? "flux"
                            : map->sets.hasIntensity() ? "intensity to the eye, W/sr"
                                                       : "directions");
        } else if (isByLight) {
            names.push_back(nameOfLight(lights, layer));
        } else if (name.ends_with(".depth") || name.ends_with(".surface")) {
            names.push_back(fmt::format("surface {} from the front", layer + 1));
        } else {
            names.push_back(fmt::format("layer {}", layer));
        }
    }
    return names;
}

std::string placeOf(const Renderer& renderer, const std::string& name, const FluxMap* map,
                    const TextureContent& content) {
    const std::vector<std::string> lights = lightNames(renderer.scene());
    if (content.space == TextureSpace::light && name != "shadow.maps") {
        const int light = map != nullptr && map->light >= 0 ? map->light : lightOfName(name);
        const std::string part = map != nullptr && map->cascade > 0
                                     ? fmt::format(", nearer map {}", map->cascade + 1)
                                     : "";
        return fmt::format("the view of {}{}", nameOfLight(lights, light), part);
    }
    if (content.space == TextureSpace::cube && map != nullptr && map->generator >= 0)
        return fmt::format("a cube around body {}", map->generator + 1);
    return describe(content.space);
}

}  // namespace

ViewedTexture reducedTo(ViewedTexture viewed, int side) {
    const Image& all = viewed.values;
    const int step = (std::max(all.width, all.height) + side - 1) / side;
    if (step <= 1) return viewed;
    Image few((all.width + step - 1) / step, (all.height + step - 1) / step, all.channels);
    for (int y = 0; y < few.height; ++y) {
        for (int x = 0; x < few.width; ++x) {
            for (int c = 0; c < few.channels; ++c)
                few.at(x, y, c) = all.at(x * step, y * step, c);
        }
    }
    viewed.values = std::move(few);
    viewed.histograms = std::make_shared<Histograms>();
    viewed.regions.clear();
    return viewed;
}

Image unfoldCube(const std::vector<Image>& faces) {
    const int side = faces.front().width;
    const int channels = faces.front().channels;
    Image cross(4 * side, 3 * side, channels);
    for (std::size_t face = 0; face < faces.size(); ++face) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                for (int c = 0; c < channels; ++c) {
                    cross.at(kCross[face].column * side + x, kCross[face].row * side + y, c) =
                        faces[face].at(x, y, c);
                }
            }
        }
    }
    return cross;
}

std::vector<ViewedTexture::Region> regionsOfCube(int side) {
    std::vector<ViewedTexture::Region> regions;
    for (const Face& face : kCross)
        regions.push_back({face.name, face.column * side, face.row * side, side, side});
    return regions;
}

std::vector<ViewedTexture::Region> regionsOfPyramid(int width, int height) {
    const auto squares = [](int pixels, int side) { return (pixels + side - 1) / side; };
    std::vector<ViewedTexture::Region> regions;
    int y = 0;
    for (const int side : {4, 16, 64}) {
        const int columns = squares(width, side);
        const int rows = squares(height, side);
        regions.push_back({fmt::format("squares of {} pixels", side),
                           side == 4 ? 0 : squares(width, 4), y, columns, rows});
        if (side > 4) y += rows;
    }
    return regions;
}

std::string pixelsOfPyramid(const std::string& name) {
    static constexpr std::string_view kEnd = ".pyramid";
    if (!name.ends_with(kEnd)) return "";
    return name.substr(0, name.size() - kEnd.size()) + ".depth";
}

Image lightOfSums(const std::vector<Image>& words, double unit) {
    constexpr double kHighWord = 4294967296.0;
    Image light(words.front().width, words.front().height, 3);
    for (int y = 0; y < light.height; ++y) {
        for (int x = 0; x < light.width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto low = static_cast<double>(words[2 * c].at(x, y, 0));
                const auto high = static_cast<double>(words[2 * c + 1].at(x, y, 0));
                light.at(x, y, static_cast<int>(c)) =
                    static_cast<float>((low + kHighWord * high) * unit);
            }
        }
    }
    return light;
}

ViewedTexture readPicture(const Renderer& renderer) {
    const Picture& picture = renderer.outputs().picture;
    ViewedTexture viewed;
    viewed.isEncoded = true;
    viewed.content = pictureContent();
    viewed.place = describe(viewed.content.space);
    viewed.values = run::readTexture(renderer.texture(picture.display), 0, 3);
    // What is no number is black in a picture, and no other black.
    viewed.checked = renderer.graph().nameOf(picture.radiance);
    viewed.notFinite =
        measure::findNotFinite(run::readTexture(renderer.texture(picture.radiance), 0, 3));
    return viewed;
}

ViewedTexture readViewed(const Renderer& renderer, const std::string& name, int layer) {
    if (name.empty()) return readPicture(renderer);
    if (!run::isTexture(renderer, name)) {
        ViewedTexture picture = readPicture(renderer);
        picture.missing = ViewedTexture::Missing::texture;
        return picture;
    }
    const gl::Texture& texture = renderer.texture(renderer.graph().find(name));
    const graph::TextureDesc& desc = texture.desc();
    ViewedTexture viewed;
    viewed.name = name;
    viewed.layer = layer;
    viewed.checked = name;
    viewed.content = contentOf(name, desc);
    const FluxMap* map = mapOf(renderer, name);
    if (map != nullptr) {
        const render::Space space = map->on.views->space();
        viewed.content.space = space == render::Space::screen  ? TextureSpace::eye
                               : space == render::Space::light ? TextureSpace::light
                                                               : TextureSpace::cube;
    }
    const Layering layering =
        layeringOf(viewed.content, map, desc, viewed.content.space == TextureSpace::cube);
    if (viewed.content.kind == ValueKind::sums) {
        viewed.content.kind = ValueKind::color;
        if (map != nullptr && map->sets.isGlossy() && layer >= map->sets.flux()) {
            viewed.content.quantity = map->sets.hasIntensity()
                                          ? "intensity to the eye of flux that has arrived"
                                          : "flux times 1 + the direction in which it arrives";
            for (ChannelContent& channel : viewed.content.channels)
                channel.unit = map->sets.hasIntensity() ? "W/sr" : "W";
        }
    }
    viewed.place = placeOf(renderer, name, map, viewed.content);
    viewed.layers = layering.shown;
    viewed.layerNames = namesOfLayers(renderer, name, map, layering);
    if (layer >= layering.shown) {
        viewed.missing = ViewedTexture::Missing::layer;
        return viewed;
    }
    const int channels = gl::formatInfo(desc.format).channels;
    std::vector<Image> faces;
    for (int face = 0; face < layering.faces; ++face) {
        std::vector<Image> words;
        for (int word = 0; word < layering.words; ++word)
            words.push_back(
                run::readTexture(texture, layering.stored(face, layer, word), channels));
        const double unit =
            map != nullptr ? static_cast<double>(ledgerQuantum(renderer.scene())) : 1.0;
        faces.push_back(layering.words > 1 ? lightOfSums(words, unit) : std::move(words.front()));
    }
    if (faces.size() == 1) {
        viewed.values = std::move(faces.front());
    } else {
        viewed.values = unfoldCube(faces);
        viewed.regions = regionsOfCube(faces.front().width);
    }
    if (const std::string pixels = pixelsOfPyramid(name); run::isTexture(renderer, pixels)) {
        const graph::ResourceDesc& view = renderer.graph().descOf(renderer.graph().find(pixels));
        const auto& size = std::get<graph::TextureDesc>(view);
        viewed.regions = regionsOfPyramid(size.width, size.height);
    }
    viewed.content.channels.resize(static_cast<std::size_t>(viewed.values.channels));
    viewed.notFinite = measure::findNotFinite(viewed.values);
    return viewed;
}

}  // namespace kaustik::gui
