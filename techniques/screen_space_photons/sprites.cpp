// SPDX-License-Identifier: MIT
// reconstruct.sprites: oriented, ray-cast sprites (K06, section 3.1, Eq. 1). Each photon lights a
// disc in the tangent plane of its receiver, or what its beam cuts out of it, falling off to the
// edge. Its weights are first summed over the receivers that the pixels see, so that the flux
// deposited is the photon's flux. A compute thread a photon does one and then the other. In: hits
// (eye view space, W) and the eye buffer; out: flux a pixel, W, and where a receiver is glossy
// radiant intensity towards the eye, W/sr: each splat by the BRDF at each pixel, with the pixel's
// normal and reflectance.
#include <fmt/format.h>

#include <bit>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

// What a splat covers of its receiver's tangent plane.
enum class SpriteShape : int { beam, disc, screen };

// How a splat falls off from its middle to its radius.
enum class SpriteKernel : int { gaussian, linear, epanechnikov };

struct SpritesParams {
    SpriteShape shape = SpriteShape::beam;
    SpriteKernel kernel = SpriteKernel::gaussian;
    float radiusMeters = 0.0f;
    float footprints = 2.5f;
    int maximumPixels = 64;
    int reachPixels = 120;
    template <class R>
    void reflect(R& r) {
        r.choice(
            shape, "shape",
            "beam: what a round beam along the photon's path cuts out of the tangent plane, "
            "longer where light grazes; disc: the paper's circle in that plane; screen: a circle "
            "on the screen, the paper's comparison (Fig. 6)",
            {"beam", "disc", "screen"});
        r.choice(kernel, "kernel",
                 "gaussian: cut off at 3 sigma, evens out the photons' grid best; linear: the "
                 "paper's; epanechnikov: a parabola",
                 {"gaussian", "linear", "epanechnikov"});
        r.field(radiusMeters, "radius",
                "Radius of a photon's splat; 0: follows the photon's footprint", "m",
                params::range(0.0f, 1e6f));
        r.field(footprints, "footprints",
                "Radius of a splat in widths of its photon's beam, when no radius is set", "",
                params::range(0.1f, 100.0f));
        r.field(maximumPixels, "maximum", "Largest radius on the screen; splats shrink to it", "px",
                params::range(1, 100));
        // Mesa's software rasteriser silently ends a shader's loops after 65,535 turns, and a
        // splat's weights are summed in one of (2 reach + 1)².
        r.field(reachPixels, "reach",
                "Farthest from its middle that a splat goes on the screen where perspective or "
                "grazing light stretch it; it is cut off there, and keeps its flux",
                "px", params::range(1, 127));
    }
};

// Splats that a parameter has cut off, and those that one has made smaller.
using CutSplats = graph::Buffer<transport::Narrowed>;
constexpr std::size_t kCutOff = 0;
constexpr std::size_t kShrunk = 1;

void keepToLimit(FrameBuilder& frame, const CutSplats& cut, std::size_t which,
                 const std::string& parameter, int pixels, const std::string& sentence) {
    frame.keepsTo(
        {"reconstruct.sprites",
         {cut},
         [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const transport::Narrowed found =
                 executor.buffer(cut).read<transport::Narrowed>()[which];
             if (found.count == 0) return {};
             return ReachedLimit{
                 parameter,
                 "px",
                 static_cast<double>(pixels),
                 static_cast<double>(std::bit_cast<float>(found.widestBits)),
                 fmt::format("{} splats are {}; no flux is lost to it", found.count, sentence),
                 0.0};
         }});
}

CausticMap splatSprites(FrameBuilder& frame, const SpritesParams& params, Hits hits,
                        Surfaces surfaces, CausticMap before) {
    const bool isGlossy = frame.needs().glossyReceivers;
    const bool isFirst = !before.flux.valid();
    struct Data {
        CutSplats cut;
        CausticMap map;
    };
    const Data& splatted = frame.pass<Data>(
        "reconstruct.sprites",
        isGlossy ? "photons deposit flux at the receivers, and, since some are glossy, how it "
                   "goes to the eye"
                 : "photons deposit flux at the receivers",
        [&](graph::PassSetup& setup, Data& data) {
            const EyeBuffer& eye = surfaces.eye;
            hits.sample(setup);
            hits.incoming.sample(setup);
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            if (isGlossy) setup.sample("receiverAlbedo", eye.receiverAlbedo);
            data.cut = setup.storage("CutSplats", setup.createBuffer<transport::Narrowed>(
                                                      "reconstruct.cut" + hits.incoming.suffix, 2));
            setup.bypass(data.cut, {0, 0, 0, 0});
            setup.bypass(setup.storage("SplatTotals",
                                       setup.createBuffer<float>(
                                           "reconstruct.totals" + hits.incoming.suffix,
                                           static_cast<std::size_t>(hits.incoming.capacity()))),
                         {0, 0, 0, 0});
            data.map = CausticMap::deposit(setup, before, frame.width(), frame.height(), isGlossy,
                                           "caustic.flux");
            data.map.ledger = setup.storage("LedgerEntries", setup.write(hits.incoming.ledger));
            setup.bypass(data.map.ledger, hits.incoming.ledger);
        },
        [params, isGlossy, isFirst, list = hits.incoming](const Data& data,
                                                          gl::PassContext& context) {
            context.buffer(data.cut).clear();
            if (isFirst) context.texture(data.map.flux).clear({0, 0, 0, 0});
            dispatchOver(context.compute("screen_space_photons/sprite_totals.comp")
                             .params("reconstruct.sprites", params),
                         list);
            gl::Command command = context.compute("screen_space_photons/sprites.comp");
            command.params("reconstruct.sprites", params);
            if (isGlossy) command.define("GLOSSY_RECEIVERS");
            dispatchOver(command, list);
        });
    keepToLimit(frame, splatted.cut, kCutOff, "reconstruct.sprites.reach", params.reachPixels,
                "cut off");
    keepToLimit(frame, splatted.cut, kShrunk, "reconstruct.sprites.maximum", params.maximumPixels,
                "smaller than they were to be");
    return splatted.map;
}

}  // namespace

void registerSprites(Registry& registry) {
    registry.node<ReconstructStage>("sprites",
                                    {"Splats each photon as a disc in its receiver's tangent "
                                     "plane, ray-cast per pixel; the flux is kept exactly.",
                                     "K06, section 3.1, Eq. 1"},
                                    &splatSprites);
}

}  // namespace kaustik
