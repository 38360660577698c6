// SPDX-License-Identifier: MIT
#include "framework/gui/panels/resource_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/gui/pass_graph.h"
#include "framework/gui/texture_reader.h"

namespace kaustik::gui {
namespace {

template <class Listed>
const Listed* findIn(const std::vector<Listed>& all, const std::string& name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Listed& one) { return one.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace

const ListedTexture* findTexture(const VariantResult& result, const std::string& name) {
    return findIn(result.textures, name);
}

std::string sizeAndFormat(const VariantResult& result, const std::string& resource) {
    if (const ListedTexture* texture = findTexture(result, resource)) {
        const graph::TextureDesc& desc = texture->desc;
        return fmt::format("{}x{}{} {}", desc.width, desc.height,
                           desc.layers > 0 ? fmt::format("x{}", desc.layers) : "",
                           graph::formatName(desc.format));
    }
    if (const ListedBuffer* buffer = findIn(result.buffers, resource))
        return fmt::format("{} bytes", buffer->bytes);
    return "";
}

std::string unitsOf(const VariantResult& result, const std::string& resource) {
    const ListedTexture* texture = findTexture(result, resource);
    if (texture == nullptr) return "";
    const TextureContent content = contentOf(resource, texture->desc);
    if (content.kind != ValueKind::single) return content.unit();
    std::vector<std::string> units;
    for (const ChannelContent& channel : content.channels) {
        const bool isNew = std::find(units.begin(), units.end(), channel.unit) == units.end();
        if (isNew && !channel.unit.empty()) units.push_back(channel.unit);
    }
    return fmt::format("{}", fmt::join(units, ", "));
}

std::string writersText(const VariantResult& result, const std::string& resource) {
    const std::vector<std::string> writers = writersOf(result.passes, resource);
    if (writers.empty()) return "nothing in this frame";
    return fmt::format("{}", fmt::join(writers, ", "));
}

std::vector<ViewedTexture::Region> partsOf(const VariantResult& result, const std::string& name) {
    const ListedTexture* pixels = findTexture(result, pixelsOfPyramid(name));
    if (pixels == nullptr) return {};
    return regionsOfPyramid(pixels->desc.width, pixels->desc.height);
}

void openTexture(Bench& bench, const std::string& name, const std::string& part) {
    if (bench.view.resource != name) bench.view.layer = 0;
    // A place in another grid is another place.
    const VariantResult& result = bench.editedResult();
    const auto extentOf = [&](const std::string& resource) {
        const ListedTexture* texture = findTexture(result, resource);
        return texture != nullptr ? params::Extent{texture->desc.width, texture->desc.height}
                                  : bench.document.size;
    };
    if (!(extentOf(name) == extentOf(bench.view.resource)) || bench.view.resource == name)
        bench.view.zoom = 0.0f;
    bench.view.resource = name;
    bench.view.soughtRegion = part;
    bench.view.flipped = -1;
    bench.panels.showsGraph = false;
}

}  // namespace kaustik::gui
