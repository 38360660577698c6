// SPDX-License-Identifier: MIT
// specular.two_interfaces: image-space refraction at two interfaces (W05) of photons, as light
// sends them: "specular.back_faces" draws the farthest back faces of the transmitting objects from
// each light, "specular.two_interfaces" estimates from them where a photon that has entered a body
// leaves it. One interaction at mirrors and sheets. Total reflection inside, more than two
// interfaces and light that has been bent before are not followed: they are in the ledger's
// internal_reflection_limit and bounce_limit. Eye view space, m and W.
//
// Beams: by ray differentials through both interfaces, or as WD08's lens does (section 4.2), round,
// of the mean curvatures of both surfaces. Eqs. 1 to 7 say the same in distances that may vanish;
// here a beam is its width w and its growth w', which a lens of power P turns into w' - P w, so
// that D = D0 |1 + d_bg (1/d_front - P)| stays finite with the receiver at the focus and the light
// at the focal length.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "techniques/photon_lists/next_photons.h"
#include "techniques/raster_views/back_faces.h"
#include "techniques/raster_views/light_sight.h"

namespace kaustik {
namespace {

enum class BeamModel : int { beam, thin, thick };
enum class FollowedBranch : int { refracted, reflected };

struct TwoInterfacesParams {
    int steps = 12;
    DistanceInside distance = DistanceInside::search;
    int size = 1024;
    BeamModel lens = BeamModel::beam;
    FollowedBranch branch = FollowedBranch::refracted;
    template <class R>
    void reflect(R& r) {
        reflectDistance(r, distance, steps);
        r.field(size, "size", "Side of each light's view of the back faces", "texels",
                params::range(16, 8192))
            .when(&whyNoBodies);
        r.choice(
             lens, "lens",
             "What makes of a photon's beam what it is beyond, where splats follow beams. beam: "
             "ray differentials; thin, thick: a lens of the surfaces' mean curvatures, "
             "half-way through, or both surfaces and the way between them",
             {"beam", "thin", "thick"})
            .when([](const FrameFacts& facts) {
                return facts.usesBeams() ? "" : "photons have no beams here";
            });
        r.choice(branch, "branch",
                 "Which photons of a dielectric's first interface go on; the others are in the "
                 "ledger's untraced_branch",
                 {"refracted", "reflected"})
            .when(&whyNoDielectric);
    }
};

// Paths that the scene has and this cannot form, in a sentence; "" where it has none.
std::string omittedPathsMessage(const FrameBuilder& frame, const TwoInterfacesParams& params) {
    const scene::SceneNeeds& needs = frame.needs();
    std::vector<std::string> paths;
    if (needs.reflectedLight && params.branch == FollowedBranch::refracted) {
        paths.push_back(fmt::format("of what '{}' reflects to '{}'", needs.reflectedLight->sheet,
                                    needs.reflectedLight->receiver));
    }
    if (needs.concaveBody) {
        paths.push_back(fmt::format("through more than two interfaces of '{}', which is not convex",
                                    *needs.concaveBody));
    }
    if (needs.reflectors > 0 && needs.repeatedHits.reflected)
        paths.emplace_back("from one mirror to another, or to itself");
    if (needs.reflectors + needs.refractors > 1 && needs.repeatedHits.transmitted)
        paths.emplace_back("from one specular object to another");
    if (paths.empty()) return "";
    return fmt::format(
        "specular=two_interfaces: this technique cannot form paths {}; specular=split with "
        "trace=hierarchical does.",
        fmt::join(paths, "; nor "));
}

// What one light sees of the backs of bodies; drawn once a frame.
BackFaces facesSeenFrom(FrameBuilder& frame, const TwoInterfacesParams& params,
                        const Surfaces& surfaces, const LightSight& sight, std::size_t light,
                        bool hasShape) {
    const std::string suffix = light == 0 ? "" : fmt::format("_{}", light + 1);
    return *frame.once<BackFaces>("specular.back_faces" + suffix, [&] {
        const Views views = frame.makeViews(
            render::Space::light, {render::inPixels(sight.view, params.size, params.size)});
        return std::make_shared<BackFaces>(drawBackFaces(
            frame, surfaces.geometry, views,
            {"specular.back_faces", "photons leave transmitting objects through their backs",
             "light" + suffix + ".", hasShape}));
    });
}

Photons interactTwoInterfaces(FrameBuilder& frame, const TwoInterfacesParams& params, Hits hits,
                              Surfaces surfaces) {
    const std::vector<LightSight> sights = *frame.once<std::vector<LightSight>>(
        "specular.sights",
        [&] { return std::make_shared<std::vector<LightSight>>(sightsOfSpecular(frame)); });
    if (frame.runsOf(SpecularStage::name) == 1) {
        const std::string sentence = omittedPathsMessage(frame, params);
        if (!sentence.empty()) frame.warn(sentence);
    }
    const NextPhotons next = allocateNext(frame, hits);
    Photons photons = next.photons;
    photons.ledger = hits.incoming.ledger;
    const bool hasBodies = frame.needs().closedDielectrics;
    if (!hasBodies) frame.skip("specular.back_faces", "no dielectric of the scene has an inside");
    for (std::size_t light = 0; light < sights.size(); ++light) {
        const BackFaces faces = hasBodies ? facesSeenFrom(frame, params, surfaces, sights[light],
                                                          light, hits.incoming.hasBeams())
                                          : BackFaces{};
        photons = frame.pass<Photons>(
            "specular.two_interfaces",
            "photons go through what the light sees the front and the back of",
            [&](graph::PassSetup& setup, Photons& data) {
                if (hasBodies) {
                    faces.sample(setup);
                    setup.define("BODIES");
                }
                NextPhotons chained = next;
                chained.photons = photons;
                Hits accounted = hits;
                accounted.incoming.ledger = photons.ledger;
                data = bindNextPhotons(setup, accounted, chained);
                const bool isRefracted = params.branch == FollowedBranch::refracted;
                data.paths.interactions = hits.incoming.paths.interactions + (isRefracted ? 2 : 1);
                data.paths.transmissionOnly = isRefracted;
                data.paths.reflectionOnly = !isRefracted;
                data.paths.end = true;
            },
            [params, light, account = totalReflectionAccount(frame, params.distance),
             list = hits.incoming, views = faces.views](const Photons&, gl::PassContext& context) {
                gl::Command command = context.compute("specular/two_interfaces.comp");
                if (views) views->bindTo(command);
                if (views) command.set("totalReflectionAccount", account);
                command.params("specular.two_interfaces", params)
                    .set("lightIndex", static_cast<int>(light));
                dispatchOver(command, list);
            });
    }
    return photons;
}

}  // namespace

void registerSpecularTwoInterfaces(Registry& registry) {
    registry.node<SpecularStage>(
        "two_interfaces",
        {"Refracts photons into a body and out of its back faces as the light sees "
         "them; reflects them at mirrors.",
         "Wyman 2005 (W05), as WD08 describes it",
         "It assumes bodies with one front and one back that the light sees. Total reflection "
         "inside, further interfaces, and light that has been bent before are not followed: they "
         "are in the ledger as internal_reflection_limit and bounce_limit, and a warning names the "
         "paths of the scene that it cannot form."},
        {.throughBodies = true}, &interactTwoInterfaces);
}

}  // namespace kaustik
