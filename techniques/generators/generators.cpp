// SPDX-License-Identifier: MIT
#include "techniques/generators/generators.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "framework/pipeline/stage_params.h"
#include "techniques/generators/reference_points.h"
#include "techniques/raster_views/light_maps.h"
#include "techniques/raster_views/receivers.h"

namespace kaustik {
namespace {

double radiusOf(const scene::Bounds& bounds) {
    return 0.5 * glm::length(bounds.maximum - bounds.minimum);
}

double distanceBetween(const scene::Bounds& a, const scene::Bounds& b) {
    const glm::dvec3 gap =
        glm::max(glm::max(a.minimum - b.maximum, b.minimum - a.maximum), glm::dvec3(0.0));
    return glm::length(gap);
}

void unite(Generator& one, const Generator& other) {
    one.name += fmt::format(", {}", other.name);
    one.bounds.include(other.bounds.minimum);
    one.bounds.include(other.bounds.maximum);
}

// How far beyond its part of a shared generator a point's map takes light, ever less of it, m.
double overlapOf(const Generator& part) {
    return 0.2 * radiusOf(part.bounds);
}

// Joins the two nearest until none overlap and there are no more than `maximum`.
void uniteNearest(std::vector<Generator>& all, std::size_t maximum) {
    while (all.size() > 1) {
        double nearest = std::numeric_limits<double>::infinity();
        std::pair<std::size_t, std::size_t> pair{0, 0};
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = i + 1; j < all.size(); ++j) {
                const double distance = distanceBetween(all[i].bounds, all[j].bounds);
                if (distance >= nearest) continue;
                nearest = distance;
                pair = {i, j};
            }
        }
        if (nearest > 0.0 && all.size() <= maximum) return;
        unite(all[pair.first], all[pair.second]);
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(pair.second));
    }
}

// More points than see so much of what a generator's light may reach are not taken.
constexpr double kSeenShare = 0.93;
constexpr int kMaxPoints = 16;

// The points of a generator: as many as asked for, or as see enough, if any do.
ReferencePoints pointsOf(FrameBuilder& frame, const Generator& whole, int wanted, int room) {
    const auto rays = frame.once<scene::SurfaceRays>("generators.receiver_rays", [&] {
        return std::make_shared<scene::SurfaceRays>(frame.scene(),
                                                    scene::receiversOf(frame.scene()));
    });
    const std::vector<ReachedPlace> reached = placesReached(frame.scene(), whole.bounds, *rays);
    const auto from = [&](int points) {
        return referencePoints(whole.bounds, reached, *rays, points);
    };
    ReferencePoints taken = from(std::min(std::max(wanted, 1), room));
    ReferencePoints best = taken;
    for (int points = 2; points <= kMaxPoints && best.seenShare < kSeenShare; points *= 2) {
        if (points <= wanted) continue;
        ReferencePoints more = from(points);
        // Twice the maps are to see a fourth of what is missing.
        if (more.seenShare > best.seenShare + 0.25 * (1.0 - best.seenShare)) best = std::move(more);
    }
    const auto count = static_cast<int>(best.parts.size());
    if (wanted == 0 && count <= room) return best;
    if (taken.seenShare < kSeenShare && best.seenShare > taken.seenShare) {
        frame.warn(fmt::format(
            "The {} reference point{} of caustic generator '{}' see{} {:.0f} % of what its light "
            "may reach; the rest is stored coarsely or lost (hidden_in_map). around.points = {} "
            "sees {:.0f} %.",
            taken.parts.size(), taken.parts.size() == 1 ? "" : "s", whole.name,
            taken.parts.size() == 1 ? "s" : "", 100.0 * taken.seenShare, count,
            100.0 * best.seenShare));
    }
    return taken;
}

// Where nothing is specular nothing leaves anything: rays are looked for from where the eye is.
Generator eyeOf(const scene::Scene& scene) {
    Generator eye{"the eye", {}};
    const glm::dvec3 reach(100.0 * static_cast<double>(scene.camera.nearMeters));
    eye.bounds.include(scene.camera.position - reach);
    eye.bounds.include(scene.camera.position + reach);
    return eye;
}

std::vector<Generator> findGenerators(FrameBuilder& frame, const GeneratorParams& params) {
    const scene::Scene& scene = frame.scene();
    const CulledObjects& culled = culledObjects(frame);
    const auto holds = [](const std::vector<std::size_t>& list, std::size_t object) {
        return std::find(list.begin(), list.end(), object) != list.end();
    };
    std::vector<Generator> lit;
    std::vector<Generator> all;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const scene::Object& object = scene.objects[i];
        const scene::Bounds bounds = objectBounds(scene, object);
        if (isReceiver(scene.materials[object.material].kind) || bounds.empty) continue;
        if (holds(culled.unseen, i)) continue;
        all.push_back({object.name, bounds});
        if (!holds(culled.unlit, i)) lit.push_back(all.back());
    }
    if (lit.empty()) lit = all;
    if (lit.empty()) lit.push_back(eyeOf(scene));
    uniteNearest(lit, static_cast<std::size_t>(params.maxGenerators));
    std::vector<Generator> generators;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        // Those that are still to come have one each.
        const std::size_t others = generators.size() + lit.size() - i - 1;
        const auto room = static_cast<int>(generators::kMaxGenerators - others);
        for (const GeneratorPart& part : pointsOf(frame, lit[i], params.points, room).parts)
            generators.push_back({lit[i].name, part.bounds, part.reference, i});
    }
    return generators;
}

std::vector<ReceiverView> drawReceivers(FrameBuilder& frame, const Geometry& geometry) {
    const std::vector<Generator>& generators = causticGenerators(frame);
    const int side = sideOfCubeMaps(frame, static_cast<int>(generators.size()));
    std::vector<ReceiverView> receivers;
    for (std::size_t i = 0; i < generators.size(); ++i) {
        const Views views = frame.makeViews(render::Space::cube, facesAround(generators[i], side));
        receivers.push_back(
            renderReceivers(frame, geometry, views, "generator" + suffixOfGenerator(i),
                            fmt::format("generator '{}' stores caustics where it sees receivers",
                                        generators[i].name),
                            render::DrawSet::receivers)
                .receivers);
    }
    return receivers;
}

}  // namespace

const std::vector<Generator>& causticGenerators(FrameBuilder& frame) {
    return *frame.once<std::vector<Generator>>("generators", [&] {
        return std::make_shared<std::vector<Generator>>(
            findGenerators(frame, frame.params<GeneratorParams>("around")));
    });
}

const std::vector<ReceiverView>& generatorReceivers(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<std::vector<ReceiverView>>("generators.receivers", [&] {
        return std::make_shared<std::vector<ReceiverView>>(drawReceivers(frame, geometry));
    });
}

const gl::Buffer& generatorsBlock(FrameBuilder& frame) {
    return *frame.once<gl::Buffer>("generators.block", [&] {
        const glm::dmat4 toWorld = glm::inverse(frame.view().worldToView);
        generators::GeneratorsData data{};
        data.eyeToWorld = glm::mat4(glm::mat3(toWorld));
        const std::vector<Generator>& generators = causticGenerators(frame);
        data.count.x = static_cast<unsigned>(generators.size());
        for (std::size_t i = 0; i < generators.size(); ++i) {
            const scene::Bounds& box = generators[i].bounds;
            const glm::dvec3 eye(toWorld[3]);
            const glm::dvec3 middle = 0.5 * (box.minimum + box.maximum);
            // The fourth numbers are the part's generator, and how far its map reaches beyond it,
            // m.
            data.centers[i] =
                glm::vec4(glm::vec3(middle - eye), static_cast<float>(generators[i].whole));
            data.references[i] = glm::vec4(glm::vec3(generators[i].reference - eye), 0.0f);
            data.halfExtents[i] = glm::vec4(glm::vec3(0.5 * (box.maximum - box.minimum)),
                                            static_cast<float>(overlapOf(generators[i])));
        }
        return std::make_shared<gl::Buffer>(std::vector<generators::GeneratorsData>{data},
                                            "generators");
    });
}

std::string suffixOfGenerator(std::size_t generator) {
    return generator == 0 ? "" : fmt::format(".cube_{}", generator + 1);
}

std::vector<render::RasterView> facesAround(const Generator& generator, int side) {
    return render::makeCube(generator.reference, 1e-3 * radiusOf(generator.bounds), side);
}

}  // namespace kaustik
