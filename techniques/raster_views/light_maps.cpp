// SPDX-License-Identifier: MIT
#include "techniques/raster_views/light_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "techniques/raster_views/magnified_parts.h"
#include "techniques/raster_views/map_border.h"
#include "techniques/raster_views/map_params.h"
#include "techniques/raster_views/receivers.h"
#include "techniques/raster_views/seen_part.h"

namespace kaustik {
namespace {

std::vector<scene::Bounds> boundsOfReceivers(const scene::Scene& scene) {
    std::vector<scene::Bounds> bounds;
    for (const scene::Object& object : scene.objects) {
        if (!isReceiver(scene.materials[object.material].kind)) continue;
        bounds.push_back(objectBounds(scene, object));
    }
    return bounds;
}

void include(scene::Bounds& bounds, const scene::Bounds& more) {
    if (more.empty) return;
    bounds.include(more.minimum);
    bounds.include(more.maximum);
}

scene::Bounds receiverBounds(const scene::Scene& scene) {
    scene::Bounds bounds;
    for (const scene::Bounds& one : boundsOfReceivers(scene))
        include(bounds, one);
    return bounds;
}

scene::Bounds widened(scene::Bounds box, const glm::dvec3& margin) {
    box.minimum -= margin;
    box.maximum += margin;
    return box;
}

scene::Bounds coveredBounds(const FrameBuilder& frame, MapCover covers) {
    const scene::Bounds all = receiverBounds(frame.scene());
    if (covers == MapCover::scene || all.empty) return all;
    scene::Bounds seen = seenPartOf(all, frame.view()).bounds;
    if (seen.empty) return all;
    // Splats of what lies just next to the picture reach into it.
    seen = widened(
        seen, 0.02 * (seen.maximum - seen.minimum) + 1e-6 * glm::length(all.maximum - all.minimum));
    seen.minimum = glm::max(seen.minimum, all.minimum);
    seen.maximum = glm::min(seen.maximum, all.maximum);
    return seen;
}

// A further map goes beyond what the eye sees by its border, which is not looked up.
const double kBorder = double{kBorderOfPart};
const double kBorderOfSeen = kBorder / (1.0 - 2.0 * kBorder);
// Nothing is taken to be nearer than this share of the farthest: the box of a room that the eye is
// in begins at the eye.
constexpr double kNearestShare = 1.0 / 64.0;

// What of all receivers the eye sees, as their boxes tell, to a depth.
SeenPart seenOfReceivers(const FrameBuilder& frame, double farMeters = 1e30) {
    SeenPart seen;
    for (const scene::Bounds& bounds : boundsOfReceivers(frame.scene())) {
        if (bounds.empty) continue;
        const SeenPart part = seenPartOf(bounds, frame.view(), farMeters);
        if (part.bounds.empty) continue;
        const bool isFirst = seen.bounds.empty;
        seen.nearestMeters =
            isFirst ? part.nearestMeters : std::min(seen.nearestMeters, part.nearestMeters);
        seen.farthestMeters = std::max(seen.farthestMeters, part.farthestMeters);
        include(seen.bounds, part.bounds);
    }
    return seen;
}

// What further maps cover: each what is nearer than a depth, which fall by the same factor.
std::vector<scene::Bounds> nearerBounds(const FrameBuilder& frame, int cascades) {
    std::vector<scene::Bounds> nearer;
    if (cascades < 2) return nearer;
    const SeenPart seen = seenOfReceivers(frame);
    if (seen.bounds.empty) return nearer;
    const double farthest = seen.farthestMeters;
    const double nearest = std::max(seen.nearestMeters, kNearestShare * farthest);
    for (int i = 1; i < cascades; ++i) {
        const double depth =
            farthest * std::pow(nearest / farthest, i / static_cast<double>(cascades));
        const scene::Bounds part = seenOfReceivers(frame, depth).bounds;
        if (part.empty) continue;
        nearer.push_back(widened(part, kBorderOfSeen * (part.maximum - part.minimum)));
    }
    return nearer;
}

// A perspective view wider than this wastes most of its texels on its rim.
constexpr double kMaxTangent = 2.0;

bool needsCube(const render::RasterView& view) {
    return !view.isOrthographic &&
           (view.isClipped || std::max(view.halfExtent.x, view.halfExtent.y) > kMaxTangent);
}

// Six faces of half a map's side.
constexpr double kMapsOfCube = 6.0 / 4.0;

// Of flux in the most ways that it is stored in, counts, depth, normal and reflectance.
constexpr double kBytesPerTexel = 4.0 * 6.0 * 5.0 + 4.0 * 4.0 + 8.0 + 16.0 + 8.0;

// As asked for, or halved until all maps fit into the memory that they may take.
int sideOfMaps(FrameBuilder& frame, const ReconstructParams& params, int views) {
    int side = params.mapSize;
    const double maximum = static_cast<double>(params.memoryMebibytes) * 1048576.0;
    while (side > 16 && kBytesPerTexel * side * side * views > maximum)
        side /= 2;
    if (side < params.mapSize) {
        frame.warn(
            fmt::format("Caustic maps of {} texels a side do not fit into "
                        "reconstruct.map_memory = {} MiB; they have {}.",
                        params.mapSize, params.memoryMebibytes, side));
    }
    return side;
}

int sideOfFaces(int side) {
    return std::max(side / 2, 16);
}

// The views of all maps, before anything is drawn.
struct PlannedMaps {
    std::vector<render::RasterView> whole;                // by light
    std::vector<std::vector<render::RasterView>> nearer;  // by light, coarsest first
    std::vector<std::string> chosenBy;                    // by light, what its further maps are for
    int side = 0;
};

// A texel of a map of so many along a side, at a depth of 1 m or at any.
double texelArea(const render::RasterView& view) {
    const double side =
        needsCube(view) ? 4.0 : 2.0 * std::max(view.halfExtent.x, view.halfExtent.y);
    return side * side;
}

// Of a light: those that are finer than the map before.
std::vector<render::RasterView> finerViews(FrameBuilder& frame, const scene::Light& light,
                                           const render::RasterView& whole, int cascades) {
    std::vector<render::RasterView> views;
    double before = texelArea(whole);
    for (const scene::Bounds& bounds : nearerBounds(frame, cascades)) {
        const render::RasterView view =
            render::makeLightView(light, bounds, sceneBounds(frame.scene()));
        // Six faces around the light are what the whole map is already.
        if (needsCube(view) || texelArea(view) > 0.5 * before) continue;
        before = texelArea(view);
        views.push_back(view);
    }
    const auto requested = static_cast<std::size_t>(cascades - 1);
    if (views.size() < requested) {
        frame.warn(fmt::format(
            "reconstruct.map_cascades = {}: {} of the further maps of light '{}' would be hardly "
            "finer than those before, or none; they are left out.",
            cascades, requested - views.size(), light.name));
    }
    return views;
}

// The views of a light's whole map, with as many pixels as they have texels.
std::vector<render::RasterView> viewsOfWhole(const scene::Light& light,
                                             const render::RasterView& view, int side) {
    if (needsCube(view))
        return render::makeCube(light.position, view.nearMeters, sideOfFaces(side));
    return {render::inPixels(view, side, side)};
}

void addMagnifiedParts(FrameBuilder& frame, PlannedMaps& planned, int cascades) {
    const std::vector<SeenPlace> places = seenPlaces(frame.scene(), frame.view());
    for (std::size_t light = 0; light < planned.whole.size(); ++light) {
        const scene::Light& source = frame.scene().lights[light];
        const MagnifiedParts parts =
            magnifiedParts(places, viewsOfWhole(source, planned.whole[light], planned.side),
                           planned.side, cascades - 1);
        planned.nearer[light] = parts.views;
        planned.chosenBy[light] = fmt::format(
            "; along a side a texel of its map covers {:.3g} pixels (median; 95 %: {:.3g}), with "
            "{} further map{} {:.3g} ({:.3g})",
            parts.before.x, parts.before.y, parts.views.size(), parts.views.size() == 1 ? "" : "s",
            parts.after.x, parts.after.y);
        const auto requested = static_cast<std::size_t>(cascades - 1);
        if (parts.views.size() < requested) {
            frame.warn(fmt::format(
                "reconstruct.map_cascades = {}: {} of the further maps of light '{}' would make "
                "hardly a texel smaller on the screen; they are left out.",
                cascades, requested - parts.views.size(), source.name));
        }
    }
}

const PlannedMaps& plannedMaps(FrameBuilder& frame) {
    return *frame.once<PlannedMaps>("light.maps", [&] {
        const auto& params = frame.params<ReconstructParams>("reconstruct");
        const scene::Bounds target = coveredBounds(frame, params.covers);
        auto planned = std::make_shared<PlannedMaps>();
        const int cascades = params.space == StoreSpace::light ? params.cascades : 1;
        double maps = 0.0;  // in sides of the size asked for
        const bool isMeasured = params.cascadesBy == CascadeChoice::magnification;
        for (const scene::Light& light : frame.scene().lights) {
            if (light.band > 0) continue;
            planned->whole.push_back(
                render::makeLightView(light, target, sceneBounds(frame.scene())));
            maps += needsCube(planned->whole.back()) ? kMapsOfCube : 1.0;
            planned->chosenBy.emplace_back();
            planned->nearer.emplace_back();
            if (!isMeasured)
                planned->nearer.back() = finerViews(frame, light, planned->whole.back(), cascades);
            maps += isMeasured ? cascades - 1 : static_cast<double>(planned->nearer.back().size());
        }
        planned->side = sideOfMaps(frame, params, static_cast<int>(std::ceil(maps)));
        if (isMeasured && cascades > 1) addMagnifiedParts(frame, *planned, cascades);
        return planned;
    });
}

ReceiverView drawReceivers(FrameBuilder& frame, const Geometry& geometry, std::size_t light,
                           const Views& views, const std::string& suffix,
                           const std::string& chosenBy = "") {
    const std::string name = (light == 0 ? "light" : fmt::format("light.{}", light + 1)) + suffix;
    return renderReceivers(frame, geometry, views, name,
                           fmt::format("light '{}' stores caustics where it sees receivers{}",
                                       frame.scene().lights[light].name, chosenBy),
                           render::DrawSet::receivers)
        .receivers;
}

}  // namespace

int sideOfCubeMaps(FrameBuilder& frame, int cubes) {
    const auto& params = frame.params<ReconstructParams>("reconstruct");
    return sideOfFaces(sideOfMaps(frame, params, static_cast<int>(std::ceil(kMapsOfCube * cubes))));
}

const std::vector<ReceiverView>& lightReceivers(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<std::vector<ReceiverView>>("light.receivers", [&] {
        const PlannedMaps& planned = plannedMaps(frame);
        auto receivers = std::make_shared<std::vector<ReceiverView>>();
        for (std::size_t light = 0; light < planned.whole.size(); ++light) {
            const render::RasterView& view = planned.whole[light];
            const Views made =
                frame.makeViews(needsCube(view) ? render::Space::cube : render::Space::light,
                                viewsOfWhole(frame.scene().lights[light], view, planned.side));
            receivers->push_back(drawReceivers(frame, geometry, light, made, ""));
        }
        return receivers;
    });
}

const std::vector<std::vector<ReceiverView>>& nearerReceivers(FrameBuilder& frame,
                                                              const Geometry& geometry) {
    using All = std::vector<std::vector<ReceiverView>>;
    return *frame.once<All>("light.nearer_receivers", [&] {
        const PlannedMaps& planned = plannedMaps(frame);
        auto receivers = std::make_shared<All>(planned.nearer.size());
        for (std::size_t light = 0; light < planned.nearer.size(); ++light) {
            for (const render::RasterView& view : planned.nearer[light]) {
                const Views made = frame.makeViews(
                    render::Space::light, {render::inPixels(view, planned.side, planned.side)});
                std::vector<ReceiverView>& own = (*receivers)[light];
                own.push_back(drawReceivers(frame, geometry, light, made,
                                            fmt::format(".cascade_{}", own.size() + 2),
                                            planned.chosenBy[light]));
            }
        }
        return receivers;
    });
}

}  // namespace kaustik
