// SPDX-License-Identifier: MIT
// reconstruct.sprites: oriented, ray-cast sprites (K06, section 3.1, Eq. 1). Each photon lights a
// disc in the tangent plane of its receiver, or what its beam cuts out of it, falling off to
// the edge. `reconstruct.weights` first sums each splat's weights over the receivers that the
// pixels see, so that the flux deposited is the photon's flux. In: hits (eye view space, W) and the
// eye buffer; out: irradiance, W/m², and where a receiver is glossy radiance towards the eye,
// W/m²/sr: each splat by the BRDF at each pixel, with the pixel's normal and reflectance.
//
// A pixel at a focus takes a great many deposits, and a plain 32-bit sum drifts: 2^25 of 0.1 are 15
// % off. Photons are therefore drawn in batches, whose sums are added up with compensation.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/batch_sum.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

struct SpriteWeight {  // x: 1 / weighted area, 1/m²; y: radius, m; z: share that is seen; w: the
                       // radius that it was to have, px, where that is above the maximum, else 0
    static constexpr Format format = Format::rgba32f;
};

struct Weights {
    graph::Texture<SpriteWeight> weights;
    graph::Buffer<transport::Narrowed> cut;
    Hits hits;
    EyeBuffer eye;
    Ledger ledger;
};

Weights sumWeights(FrameBuilder& frame, const SpritesParams& params, Hits hits, EyeBuffer eye) {
    return frame.pass<Weights>(
        "reconstruct.weights", "splats keep their photons' flux",
        [&](graph::PassSetup& setup, Weights& data) {
            data.hits = hits;
            data.eye = eye;
            setup.read(hits.position);
            setup.read(hits.surface);
            setup.read(hits.flux);
            setup.read(hits.incoming.position);
            setup.read(hits.incoming.direction);
            setup.read(eye.receiver);
            setup.read(eye.receiverSurface);
            data.ledger = setup.write(hits.incoming.ledger);
            data.weights = setup.create<SpriteWeight>("reconstruct.weights", hits.incoming.width,
                                                      hits.incoming.height);
            data.cut = setup.createBuffer<transport::Narrowed>("reconstruct.cut", 1);
        },
        [&inputs = frame.inputs(), params](const Weights& data, gl::PassContext& context) {
            context.buffer(data.cut).clear();
            gl::Command command = context.compute("screen_space_photons/sprite_weights.comp");
            inputs.bindView(command);
            inputs.bindLedger(command, data.ledger)
                .params("reconstruct.sprites", params)
                .storage("Materials", inputs.gpuScene.materials())
                .image("spriteWeights", data.weights)
                .storage("CutSprites", data.cut)
                .texture("receiver", data.eye.receiver)
                .texture("receiverSurface", data.eye.receiverSurface)
                .texture("photonPosition", data.hits.incoming.position)
                .texture("photonDirection", data.hits.incoming.direction)
                .texture("hitPosition", data.hits.position)
                .texture("hitSurface", data.hits.surface)
                .texture("hitFlux", data.hits.flux)
                .dispatchOver(data.hits.incoming.width, 8, data.hits.incoming.height, 8);
        });
}

// Which splats are cut off, or smaller than they were to be: their light is less spread, and none
// is lost.
void keepToLimits(FrameBuilder& frame, const SpritesParams& params, const Weights& weights) {
    frame.keepsTo({"reconstruct.sprites", weights.cut,
                   [reach = params.reachPixels, handle = weights.cut](
                       const gl::Executor& executor) -> std::optional<ReachedLimit> {
                       const transport::Narrowed found =
                           executor.buffer(handle).read<transport::Narrowed>().front();
                       if (found.count == 0) return {};
                       return ReachedLimit{
                           "reconstruct.sprites.reach",
                           "px",
                           static_cast<double>(reach),
                           static_cast<double>(std::bit_cast<float>(found.widestBits)),
                           fmt::format("{} splats are cut off; no flux is lost to it", found.count),
                           0.0};
                   }});
    frame.keepsTo({"reconstruct.sprites", weights.weights,
                   [maximum = params.maximumPixels, handle = weights.weights](
                       const gl::Executor& executor) -> std::optional<ReachedLimit> {
                       const std::vector<float> texels = executor.texture(handle).read();
                       std::size_t shrunk = 0;
                       float largest = 0.0f;
                       for (std::size_t i = 3; i < texels.size(); i += 4) {
                           shrunk += texels[i] > 0.0f ? 1 : 0;
                           largest = std::max(largest, texels[i]);
                       }
                       if (shrunk == 0) return {};
                       return ReachedLimit{
                           "reconstruct.sprites.maximum",
                           "px",
                           static_cast<double>(maximum),
                           static_cast<double>(largest),
                           fmt::format("{} splats are smaller than they were to be; no flux is "
                                       "lost to it",
                                       shrunk),
                           0.0};
                   }});
}

}  // namespace

IrradianceMap splatSprites(FrameBuilder& frame, const SpritesParams& params, Hits hits,
                           EyeBuffer eye) {
    const Weights weights = sumWeights(frame, params, hits, eye);
    keepToLimits(frame, params, weights);
    const bool isGlossy = frame.needs().glossyReceivers;
    const int photons = hits.incoming.count();
    const bool isBatched = photons > kBatchPhotons;
    struct Data : Weights {
        IrradianceMap map;
        BatchSum<IrradianceTexel> irradiance;
        BatchSum<RadianceTexel> radiance;
    };
    return frame
        .pass<Data>(
            "reconstruct.sprites",
            isGlossy ? "photons become irradiance at the receivers, and radiance: some are glossy"
                     : "photons become irradiance at the receivers",
            [&](graph::PassSetup& setup, Data& data) {
                static_cast<Weights&>(data) = weights;
                setup.read(weights.weights);
                setup.read(hits.position);
                setup.read(hits.surface);
                setup.read(hits.flux);
                setup.read(hits.incoming.direction);
                setup.read(eye.receiver);
                setup.read(eye.receiverSurface);
                data.map.irradiance = setup.create<IrradianceTexel>("caustic.irradiance",
                                                                    frame.width(), frame.height());
                data.map.ledger = setup.read(weights.ledger);
                setup.bypass(data.map.irradiance, {0, 0, 0, 0});
                if (isBatched) {
                    data.irradiance =
                        createBatchSum<IrradianceTexel>(setup, frame, "reconstruct", "irradiance");
                }
                if (!isGlossy) return;
                setup.read(eye.receiverAlbedo);
                data.map.radiance =
                    setup.create<RadianceTexel>("caustic.radiance", frame.width(), frame.height());
                setup.bypass(data.map.radiance, {0, 0, 0, 0});
                if (isBatched) {
                    data.radiance =
                        createBatchSum<RadianceTexel>(setup, frame, "reconstruct", "radiance");
                }
            },
            [&inputs = frame.inputs(), params, photons, isBatched](const Data& data,
                                                                   gl::PassContext& context) {
                const bool isGlossyToo = data.map.radiance.valid();
                context.texture(data.map.irradiance).clear({0, 0, 0, 0});
                clear(context, data.irradiance);
                if (isGlossyToo) {
                    context.texture(data.map.radiance).clear({0, 0, 0, 0});
                    clear(context, data.radiance);
                }
                gl::Command command = context.shaders(
                    {"screen_space_photons/sprites.vert", "screen_space_photons/sprites.frag"});
                inputs.bindView(command)
                    .params("reconstruct.sprites", params)
                    .texture("photonDirection", data.hits.incoming.direction)
                    .texture("spriteWeights", data.weights)
                    .texture("receiver", data.eye.receiver)
                    .texture("receiverSurface", data.eye.receiverSurface)
                    .texture("hitPosition", data.hits.position)
                    .texture("hitSurface", data.hits.surface)
                    .texture("hitFlux", data.hits.flux)
                    .target(isBatched ? data.irradiance.batch : data.map.irradiance);
                if (isGlossyToo) {
                    command.define("GLOSSY_RECEIVERS")
                        .storage("Materials", inputs.gpuScene.materials())
                        .texture("receiverAlbedo", data.eye.receiverAlbedo)
                        .target(isBatched ? data.radiance.batch : data.map.radiance);
                }
                command.blend(gl::Blend::add);
                for (int first = 0; first < photons; first += kBatchPhotons) {
                    command.set("firstPhoton", first)
                        .drawArrays(GL_TRIANGLE_STRIP, 4, std::min(kBatchPhotons, photons - first));
                    if (!isBatched) continue;
                    addBatch(context, inputs, data.map.irradiance, data.irradiance);
                    if (isGlossyToo) addBatch(context, inputs, data.map.radiance, data.radiance);
                }
            })
        .map;
}

}  // namespace kaustik
