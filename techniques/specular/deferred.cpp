// SPDX-License-Identifier: MIT
// specular.deferred: photons through several bodies one behind the other, of each by the fronts and
// backs that their light sees of it (WN09, section 3.1.1, "Multi-Layer Deferred Refraction", for
// light). At the first body it is specular.two_interfaces (W05). The ray that leaves a body is
// searched in the fronts of the others, and refracted at both interfaces of the one that it meets:
// by its own direction, or, as the paper does, by that of light that was never bent. In: hits, eye
// view space; out: photons where they leave the last body, m, W.
//
// One interaction at mirrors and sheets. In the ledger: what is totally reflected inside
// (internal_reflection_limit), what has been bent before it comes here, or enters a body beyond
// `layers` (bounce_limit). What a medium scatters between two bodies is absorbed there.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "techniques/deferred_buffers/body_buffers.h"
#include "techniques/photon_lists/next_photons.h"
#include "techniques/raster_views/back_faces.h"
#include "techniques/raster_views/light_sight.h"

namespace kaustik {
namespace {

enum class Incidence : int { ray, light };

struct DeferredSpecularParams {
    int layers = 4;
    Incidence incidence = Incidence::ray;
    int steps = 12;
    DistanceInside distance = DistanceInside::search;
    BodySearchParams search;
    int size = 1024;
    DeferredGeometry geometry = DeferredGeometry::once;
    template <class R>
    void reflect(R& r) {
        r.field(layers, "layers",
                "Most bodies, those nearest to each light, that photons go through one after the "
                "other",
                "bodies", params::range(1, 8))
            .when(&whyNoOtherBody);
        r.choice(incidence, "incidence",
                 "How light comes to a body that it meets after another one. ray: as the photon's "
                 "ray does; light: as if it came from the light and had never been bent (WN09, "
                 "section 3.1.1)",
                 {"ray", "light"})
            .when(&whyNoOtherBody);
        reflectDistance(r, distance, steps);
        search.reflect(r);
        r.field(size, "size",
                "Side of each light's view of the fronts and backs of bodies; of a scene's only "
                "body, with emit=deferred, emit.deferred.size counts",
                "texels", params::range(16, 8192))
            .when(&whyNoBodies);
        reflectGeometry(r, geometry);
    }
};

// Paths that the scene has and this cannot form, in a sentence; "" where it has none.
std::string omittedPathsMessage(const FrameBuilder& frame) {
    const scene::SceneNeeds& needs = frame.needs();
    std::vector<std::string> paths;
    if (needs.reflectedLight) {
        paths.push_back(fmt::format("of what '{}' reflects to '{}'", needs.reflectedLight->sheet,
                                    needs.reflectedLight->receiver));
    }
    if (needs.concaveBody) {
        paths.push_back(fmt::format("through more than two interfaces of '{}', which is not convex",
                                    *needs.concaveBody));
    }
    int closed = 0;
    for (const Body& body : bodiesOf(frame)) {
        closed += static_cast<int>(body.objects.size());
        if (body.objects.size() > 1) {
            paths.push_back(
                fmt::format("from one to another of {}, which meet", quoted(body.names)));
        }
    }
    if (needs.reflectors > 0 && needs.repeatedHits.reflected)
        paths.emplace_back("from a mirror to another specular object, or to itself");
    if (needs.refractors > closed && needs.refractors + needs.reflectors > 1 &&
        needs.repeatedHits.transmitted)
        paths.emplace_back("from a sheet to another specular object");
    if (paths.empty()) return "";
    return fmt::format(
        "specular=deferred: this technique cannot form paths {}; specular=split with "
        "trace=hierarchical does.",
        fmt::join(paths, "; nor "));
}

void warnOmittedPaths(FrameBuilder& frame, const DeferredSpecularParams& params) {
    const std::string sentence = omittedPathsMessage(frame);
    if (!sentence.empty()) frame.warn(sentence);
    for (const scene::Light& light : frame.scene().lights) {
        if (light.band > 0) continue;
        const std::vector<Body> bodies = nearestFirst(bodiesOf(frame), light);
        const std::string names = omittedNames(bodies, params.layers);
        if (names.empty()) continue;
        frame.warn(fmt::format(
            "specular=deferred keeps {} of the {} bodies that light '{}' sees, the nearest ones: "
            "its light is not followed through {} (specular.deferred.layers).",
            params.layers, bodies.size(), light.name, names));
    }
}

// What one light sees of the bodies; drawn once a frame.
BodyBuffers bodiesSeenFrom(FrameBuilder& frame, const DeferredSpecularParams& params,
                           const Surfaces& surfaces, const LightSight& sight, std::size_t light,
                           bool hasShape) {
    const std::string suffix = light == 0 ? "" : fmt::format("_{}", light + 1);
    return *frame.once<BodyBuffers>("specular.body_buffers" + suffix, [&] {
        if (sharesBackFaces(frame)) {
            const DeferredBuffers& shared = deferredBuffers(frame, surfaces.geometry)[light];
            auto own = std::make_shared<BodyBuffers>();
            *own = {shared.depth, shared.surface, shared.shape, shared.views, 1};
            setBoxes(frame, bodiesOf(frame), "light" + suffix + ".", *own);
            return own;
        }
        const Views views = frame.makeViews(
            render::Space::light, {render::inPixels(sight.view, params.size, params.size)});
        const std::vector<Body> bodies = nearestFirst(bodiesOf(frame), frame.scene().lights[light]);
        const int drawn = std::min(static_cast<int>(bodies.size()), params.layers);
        return std::make_shared<BodyBuffers>(
            drawBodies(frame, surfaces.geometry, views, bodies,
                       {drawn, "specular.body_buffers",
                        fmt::format("photons go through {} bod{} of light '{}'", drawn,
                                    drawn == 1 ? "y" : "ies", frame.scene().lights[light].name),
                        "light" + suffix + ".", hasShape, params.geometry}));
    });
}

Photons interactDeferred(FrameBuilder& frame, const DeferredSpecularParams& params, Hits hits,
                         Surfaces surfaces) {
    const std::vector<LightSight> sights = *frame.once<std::vector<LightSight>>(
        "specular.sights",
        [&] { return std::make_shared<std::vector<LightSight>>(sightsOfSpecular(frame)); });
    if (frame.runsOf(SpecularStage::name) == 1) warnOmittedPaths(frame, params);
    const NextPhotons next = allocateNext(frame, hits);
    Photons photons = next.photons;
    photons.ledger = hits.incoming.ledger;
    const int bodies = std::min(static_cast<int>(bodiesOf(frame).size()), params.layers);
    if (bodies == 0)
        frame.skip("specular.body_buffers", "no dielectric of the scene has an inside");
    for (std::size_t light = 0; light < sights.size(); ++light) {
        const BodyBuffers seen = bodies > 0 ? bodiesSeenFrom(frame, params, surfaces, sights[light],
                                                             light, hits.incoming.hasBeams())
                                            : BodyBuffers{};
        photons = frame.pass<Photons>(
            "specular.deferred",
            "photons go from body to body through what the light sees of their fronts and backs",
            [&](graph::PassSetup& setup, Photons& data) {
                if (bodies > 0) seen.sample(setup);
                NextPhotons chained = next;
                chained.photons = photons;
                Hits accounted = hits;
                accounted.incoming.ledger = photons.ledger;
                data = bindNextPhotons(setup, accounted, chained);
                data.paths.interactions =
                    hits.incoming.paths.interactions + 2 * std::max(bodies, 1);
                data.paths.transmissionOnly = true;
                data.paths.end = true;
            },
            [params, light, account = totalReflectionAccount(frame, params.distance),
             list = hits.incoming, seen](const Photons&, gl::PassContext& context) {
                gl::Command command = context.compute("specular/deferred.comp");
                if (seen.views) {
                    seen.views->bindTo(command);
                    seen.bindTo(command);
                }
                if (seen.views) command.set("totalReflectionAccount", account);
                command.params("specular.deferred", params)
                    .set("lightIndex", static_cast<int>(light));
                dispatchOver(command, list);
            });
    }
    return photons;
}

}  // namespace

void registerSpecularDeferred(Registry& registry) {
    registry.node<SpecularStage>(
        "deferred",
        {"Refracts photons through several bodies in turn, of each by the fronts and "
         "backs that the light sees; reflects them at mirrors.",
         "WN09, section 3.1.1; W05",
         "It knows of each body the front and the back that the light sees, of no more than "
         "specular.deferred.layers bodies; objects that meet or lie in one another count as one. "
         "Total "
         "reflection inside is not followed, and what a medium scatters between two bodies is "
         "taken as absorbed. A warning names the paths of the scene that it cannot form."},
        {.throughBodies = true}, &interactDeferred);
}

}  // namespace kaustik
