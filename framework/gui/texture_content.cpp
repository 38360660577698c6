// SPDX-License-Identifier: MIT
#include "framework/gui/texture_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace kaustik::gui {
namespace {

using enum ValueKind;
using enum TextureSpace;

// A texture's name without what tells one list, light or body from another: "photons.flux_1.medium"
// is of the room "photons" and has the leaf "flux".
struct PlainName {
    std::string room;
    std::string leaf;
};

bool isNumber(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string withoutNumbers(std::string part) {
    for (;;) {
        const std::size_t line = part.rfind('_');
        if (line == std::string::npos) return part;
        const std::string_view end = std::string_view(part).substr(line + 1);
        if (!isNumber(end) && end != "shadow") return part;
        part.resize(line);
    }
}

PlainName plainNameOf(const std::string& name) {
    static constexpr std::array<std::string_view, 7> kTellsApart = {
        "cube", "light", "cascade", "probes", "stored", "medium", "refined"};
    PlainName plain;
    std::size_t begin = 0;
    while (begin <= name.size()) {
        const std::size_t end = std::min(name.find('.', begin), name.size());
        const std::string part = withoutNumbers(name.substr(begin, end - begin));
        const bool tellsApart = isNumber(part) || std::find(kTellsApart.begin(), kTellsApart.end(),
                                                            part) != kTellsApart.end();
        if (begin == 0) {
            plain.room = part;
            plain.leaf = part;
        } else if (!tellsApart) {
            plain.leaf = part;
        }
        begin = end + 1;
    }
    return plain;
}

std::vector<ChannelContent> rgb(const std::string& unit, const std::string& alpha = "") {
    std::vector<ChannelContent> channels = {{"red", unit}, {"green", unit}, {"blue", unit}};
    if (!alpha.empty()) channels.push_back({alpha, ""});
    return channels;
}

std::vector<ChannelContent> xyz(const std::string& unit, const std::string& last,
                                const std::string& lastUnit = "") {
    return {{"x", unit}, {"y", unit}, {"z", unit}, {last, lastUnit}};
}

struct Row {
    const char* room;  // "": any
    const char* leaf;
    const char* quantity;
    ValueKind kind;
    std::vector<ChannelContent> channels;
};

// Channels of textures of which nothing is a colour or a vector.
const std::vector<ChannelContent> kDepthAndNormal = {
    {"depth", "m"}, {"normal u", ""}, {"normal v", ""}, {"material + 1", ""}};
const std::vector<ChannelContent> kDepthAndGrowth = {
    {"depth", "m"}, {"growth along u", "share"}, {"growth along v", "share"}, {"unused", ""}};
const std::vector<ChannelContent> kDepthAndExtent = {{"depth", "m"}, {"half of its extent", "m"}};
const std::vector<ChannelContent> kDepthAndArea = {{"depth", "m"}, {"area seen", "m²"}};
const std::vector<ChannelContent> kDepthAreaAndEdge = {
    {"depth", "m"}, {"area seen", "m²"}, {"number + 1", ""}, {"unused", ""}};
const std::vector<ChannelContent> kEdgeSample = {
    {"depth", "m"}, {"area seen", "m²"}, {"octahedral normal x", ""}, {"octahedral normal y", ""}};
const std::vector<ChannelContent> kDepthBuffer = {{"depth", ""}};
const std::vector<ChannelContent> kFlux = {{"flux", "W"}};
const std::vector<ChannelContent> kNormalChange = {
    {"across x", "1/m"}, {"across y", "1/m"}, {"between", "1/m"}, {"unused", ""}};
const std::vector<ChannelContent> kPlaceChange = {{"along u, x", "m a cell"},
                                                  {"along u, y", "m a cell"},
                                                  {"along v, x", "m a cell"},
                                                  {"along v, y", "m a cell"}};
const std::vector<ChannelContent> kDirectionChange = {{"along u, x", "rad a cell"},
                                                      {"along u, y", "rad a cell"},
                                                      {"along v, x", "rad a cell"},
                                                      {"along v, y", "rad a cell"}};
const std::vector<ChannelContent> kPhotonOrigin = {
    {"cell", ""}, {"light", ""}, {"path", ""}, {"parent", ""}};
const std::vector<ChannelContent> kPhotonExtents = {{"first word", ""}, {"second word", ""}};
const std::vector<ChannelContent> kSearchOrder = {
    {"order", ""}, {"step", ""}, {"steps", ""}, {"squares", ""}};
const std::vector<ChannelContent> kTriangleId = {{"object + 1", ""}, {"triangle", ""}};
const std::vector<ChannelContent> kRayHit = {{"ray parameter", "m"}, {"step and layer", ""}};
const std::vector<ChannelContent> kPlane = {{"1/depth", "1/m"},
                                            {"growth along x", "1/m a pixel"},
                                            {"growth along y", "1/m a pixel"},
                                            {"reach", "1/m"}};
const std::vector<ChannelContent> kSurfaceCounts = {
    {"most", ""}, {"all", ""}, {"skipped", ""}, {"pixels", ""}};
const std::vector<ChannelContent> kFormerSurfaces = {
    {"first", ""}, {"second", ""}, {"third", ""}, {"fourth", ""}};

// The first that fits; as the texels are declared where the passes create them.
const std::vector<Row>& rows() {
    static const std::vector<Row> all = {
        {"", "display", "picture, display-encoded", color, rgb("", "alpha")},
        {"photons", "position", "where photons start, in the eye's space", vector,
         xyz("m", "footprint", "m")},
        {"photons", "direction", "directions of photons, in the eye's space", vector,
         xyz("", "fate")},
        {"photons", "flux", "flux of photons", color, rgb("W", "media")},
        {"photons", "origin", "where photons come from", single, kPhotonOrigin},
        {"photons", "place", "how the place of the next cell's ray differs", single, kPlaceChange},
        {"photons", "turn", "how the direction of the next cell's ray differs", single,
         kDirectionChange},
        {"photons", "extents", "what a photon stands for at a border", single, kPhotonExtents},
        {"hits", "position", "where photons arrive, in the eye's space", vector,
         xyz("m", "distance", "m")},
        {"hits", "surface", "normals where photons arrive", vector, xyz("", "material + 1")},
        {"hits", "flux", "flux that arrives", color, rgb("W", "fate")},
        {"hits", "kept", "flux that is kept", color, rgb("W", "fate")},
        {"hits", "shape", "how the normal turns", single, kNormalChange},
        {"hits", "turning", "how the normal turns", single, kNormalChange},
        {"hits", "ahead_shape", "how the normal of the next specular surface turns", single,
         kNormalChange},
        {"hits", "shading", "shading normals that rays found", vector, xyz("", "material + 1")},
        {"hits", "geometric", "triangles' normals that rays found", vector,
         xyz("", "distance", "m")},
        {"hits", "ahead_surface", "shading normals of the next specular surface", vector,
         xyz("", "material")},
        {"hits", "ahead_triangle", "triangles' normals of the next specular surface", vector,
         xyz("", "distance", "m")},
        {"hits", "order", "what the search of a ray says", single, kSearchOrder},
        {"emit", "sight", "triangles that the light sees", single, kTriangleId},
        {"deferred", "triangle", "triangles that the light sees", single, kTriangleId},
        {"emit", "light_depths", "depth from the light", single, kDepthAndGrowth},
        {"shadow", "maps", "depth from the light", single, kDepthAndGrowth},
        {"shadow", "visibility", "share of a light that arrives", single, {{"share", ""}}},
        {"trace", "rows", "hits along the rows of rays", single, kRayHit},
        {"trace", "rows_half", "hits along the rows of rays", single, kRayHit},
        {"trace", "rows_quarter", "hits along the rows of rays", single, kRayHit},
        {"around", "order", "order of the layers, four bits each", single, {{"order", ""}}},
        {"layers", "object_depth", "depth of an object's surfaces", single, kDepthAndNormal},
        {"layers", "object_surface", "normals of an object", vector, xyz("", "material + 1")},
        {"layers", "depth", "depth of the surfaces along a pixel's ray", single, kDepthAndNormal},
        {"view", "depth", "depth of specular surfaces along a pixel's ray", single,
         kDepthAndNormal},
        {"around", "depth", "depth of the surfaces around a body", single, kDepthAndNormal},
        {"trace", "depth", "depth of specular surfaces from the light", single, kDepthAndNormal},
        {"", "pyramid", "planes of the layers over squares of pixels", single, kPlane},
        {"", "object_counts", "fragments of an object in a pixel", single, {{"fragments", ""}}},
        {"", "counts", "surfaces along a pixel's ray", single, {{"surfaces", ""}}},
        {"", "counts_half", "surfaces along the rays of four pixels", single, kSurfaceCounts},
        {"", "counts_quarter", "surfaces along the rays of sixteen pixels", single, kSurfaceCounts},
        {"", "heads", "first fragment of a pixel + 1", single, {{"fragment + 1", ""}}},
        {"edges", "receiver", "first diffuse or glossy surface, and pixels at edges", single,
         kDepthAreaAndEdge},
        {"edges", "samples", "what is seen at four places of pixels at edges", single, kEdgeSample},
        {"", "receiver", "first diffuse or glossy surface", single, kDepthAndArea},
        {"view", "map_receiver", "first diffuse or glossy surface", single, kDepthAndArea},
        {"", "receiver_surface", "normals of receivers", vector, xyz("", "material + 1")},
        {"", "receiver_albedo", "reflectance of receivers", color, rgb("", "alpha")},
        {"eye", "interface", "first specular surface", single, kDepthAndExtent},
        {"eye", "interface_surface", "normals of the first specular surface", vector,
         xyz("", "material + 1")},
        {"", "back_depth", "depth of back faces", single, kDepthAndExtent},
        {"", "body_depth", "depth of bodies", single, kDepthAndExtent},
        {"deferred", "depth", "depth from the light", single, kDepthAndExtent},
        {"", "back_shape", "how the normals of back faces turn", single, kNormalChange},
        {"", "body_shape", "how the normals of bodies turn", single, kNormalChange},
        {"deferred", "shape", "how the normal turns", single, kNormalChange},
        {"caustic", "flux", "flux that has arrived", sums, rgb("W")},
        {"caustic", "flux_counts", "photons that have arrived", single, {{"photons", ""}}},
        {"caustic", "filtered", "flux that has arrived, filtered", color, rgb("W", "alpha")},
        {"view", "map_flux", "flux around bodies", color, rgb("W", "alpha")},
        {"view", "map_surface", "normals around bodies", vector, xyz("", "material + 1")},
        {"media", "sums", "sums of what the medium scatters, in fixed point", sums, rgb("units")},
        {"media", "in_scattered", "in-scattered radiance", color, rgb("W/m²/sr", "alpha")},
        {"caustic", "irradiance", "caustic irradiance", color, rgb("W/m²", "alpha")},
        {"caustic", "radiance", "caustic radiance to the eye", color, rgb("W/m²/sr", "alpha")},
        {"direct", "irradiance", "direct irradiance", color, rgb("W/m²", "alpha")},
        {"direct", "radiance", "direct radiance to the eye", color, rgb("W/m²/sr", "alpha")},
        {"temporal", "unfiltered", "caustic irradiance of this frame alone", color,
         rgb("W/m²", "alpha")},
        {"temporal", "seen", "what the frame before saw", single, kFormerSurfaces},
        {"view", "sight", "what a ray next to the pixel's middle sees", single, kDepthAndNormal},
        {"view", "sight_surface", "normals next to the pixel's middle", vector,
         xyz("", "material + 1")},
        {"view", "path_ending", "how the eye's rays end", single, {{"how, from 1; 0: none", ""}}},
        {"view", "exit_position", "where the eye's rays leave, in the eye's space", vector,
         xyz("m", "surfaces")},
        {"view", "exit_direction", "directions in which the eye's rays leave", vector,
         xyz("", "how the path ended")},
        {"view", "marks", "which pixels see specular surfaces", single, {{"mark", ""}}},
        {"ledger", "emittable", "flux that the light sends to specular surfaces", single, kFlux},
        {"ledger", "emittable_depth", "depth buffer, 1 near to 0 far", single, kDepthBuffer},
        {"", "irradiance", "irradiance", color, rgb("W/m²", "alpha")},
        {"", "caustic", "mean of the caustic's irradiance over a pixel", color,
         rgb("W/m²", "alpha")},
        {"", "radiance", "radiance", color, rgb("W/m²/sr", "alpha")},
        {"", "receiver_radiance", "radiance of receivers", color, rgb("W/m²/sr", "alpha")},
        {"", "in_scattered", "in-scattered radiance", color, rgb("W/m²/sr", "alpha")},
        {"", "depth_buffer", "depth buffer, 1 near to 0 far", single, kDepthBuffer},
        {"", "body_depth_buffer", "depth buffer, 1 near to 0 far", single, kDepthBuffer},
        {"", "back_depth_buffer", "depth buffer, 1 near to 0 far", single, kDepthBuffer},
        {"", "sight_depth_buffer", "depth buffer, 1 near to 0 far", single, kDepthBuffer},
        {"", "light_depth_buffer", "depth buffer, 1 near to 0 far", single, kDepthBuffer},
        {"", "surface", "normals", vector, xyz("", "material + 1")},
        {"", "back_surface", "normals of back faces", vector, xyz("", "material + 1")},
        {"", "body_surface", "normals of bodies", vector, xyz("", "material + 1")},
    };
    return all;
}

TextureSpace spaceOf(const PlainName& name) {
    const auto isOf = [&](std::initializer_list<std::string_view> rooms) {
        return std::find(rooms.begin(), rooms.end(), name.room) != rooms.end();
    };
    if (name.leaf == "pyramid" || name.leaf == "counts_half" || name.leaf == "counts_quarter")
        return other;
    if (isOf({"photons", "hits"})) return list;
    if (isOf({"around", "generator"}) || name.leaf.starts_with("map_")) return cube;
    if (isOf({"light", "deferred", "emit", "ledger"})) return light;
    if (name.room == "edges") return name.leaf == "receiver" ? eye : other;
    if (name.room == "shadow") return name.leaf == "visibility" ? eye : light;
    if (name.room == "trace") return name.leaf.starts_with("rows") ? other : light;
    if (isOf({"eye", "layers", "direct", "compose", "view", "display", "temporal", "media",
              "caustic", "bench"})) {
        return eye;
    }
    return other;
}

std::size_t channelsOf(graph::Format format) {
    switch (format) {
        case graph::Format::r32f:
        case graph::Format::r32ui:
        case graph::Format::depth32f:
            return 1;
        case graph::Format::rg32f:
        case graph::Format::rg32ui:
            return 2;
        default:
            return 4;
    }
}

}  // namespace

const char* describe(TextureSpace space) {
    switch (space) {
        case eye:
            return "the eye's view";
        case light:
            return "a light's view";
        case cube:
            return "a cube around a body";
        case list:
            return "a list, a texel a photon";
        case other:
            break;
    }
    return "a grid of its own";
}

const std::string& TextureContent::unit() const {
    static const std::string none;
    return channels.empty() ? none : channels.front().unit;
}

TextureContent contentOf(const std::string& name, const graph::TextureDesc& desc) {
    const PlainName plain = plainNameOf(name);
    TextureContent content;
    content.space = spaceOf(plain);
    const auto row = std::find_if(rows().begin(), rows().end(), [&](const Row& candidate) {
        const std::string_view room = candidate.room;
        return (room.empty() || room == plain.room) && candidate.leaf == plain.leaf;
    });
    const std::size_t count = channelsOf(desc.format);
    if (row == rows().end()) {
        content.isKnown = false;
        content.quantity = "values";
        for (std::size_t i = 0; i < count; ++i)
            content.channels.push_back({std::string(1, "xyzw"[i]), ""});
        return content;
    }
    content.quantity = row->quantity;
    content.kind = row->kind;
    content.channels = row->channels;
    if (row->kind != sums) content.channels.resize(count);
    return content;
}

TextureContent pictureContent() {
    TextureContent content;
    content.quantity = "picture, display-encoded";
    content.kind = color;
    content.space = eye;
    content.channels = rgb("");
    return content;
}

std::string labelOf(const ChannelContent& channel) {
    return channel.unit.empty() ? channel.name : fmt::format("{}, {}", channel.name, channel.unit);
}

}  // namespace kaustik::gui
