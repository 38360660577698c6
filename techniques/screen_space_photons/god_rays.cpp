// SPDX-License-Identifier: MIT
// media.lines: god rays (K06, section 3.2). The path of each photon from its last specular surface
// to its hit as a line on the screen, added up to what the medium scatters once towards the eye
// along the straight eye ray. In: photons and hits in eye view space, m and W; out: in-scattered
// radiance, W/m²/sr, the mean over each pixel, with the losses to the medium (and to the dielectric
// around the photon) on the way and to the medium on the straight ray to the eye. What lies beyond
// the pixel's receiver does not count; a photon without a hit goes on to the end of the screen or
// the scene.
//
// The paper draws one-pixel lines. A photon stands for a beam that is as wide as its footprint, and
// where that is more than a pixel such lines leave stripes: by default they fall off over one and a
// half times the beam, which has the least error (experiments/krueger2006_god_rays.toml: a third of
// the one-pixel lines' for 64 x 64 photons, the same where beams are no wider than pixels). Where
// many photons cross a pixel, as at a focus or before an eye in the medium, a plain sum drifts
// (hard case 34): they come in batches whose sums are added up with compensation.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/batch_sum.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

struct GodRayParams {
    float width = 0.0f;
    float footprints = 1.5f;
    int maximum = 64;
    template <class R>
    void reflect(R& r) {
        r.field(width, "width",
                "Width of a photon's line, 1 at least (the paper's); 0: follows the photon's "
                "footprint",
                "px", params::range(0.0f, 64.0f));
        r.field(footprints, "footprints",
                "Width of a line in widths of its photon's beam, when no width is set", "",
                params::range(0.1f, 100.0f));
        r.field(maximum, "maximum", "Largest width on the screen; lines shrink to it", "px",
                params::range(1, 256));
    }
};

// Which lines are narrower than they were to be: their light is less spread, and none is lost.
void keepToWidth(FrameBuilder& frame, const GodRayParams& params,
                 const graph::Buffer<transport::Narrowed>& narrowed) {
    frame.keepsTo({"media.lines",
                   {narrowed},
                   [maximum = params.maximum,
                    narrowed](const gl::Executor& executor) -> std::optional<ReachedLimit> {
                       const transport::Narrowed found =
                           executor.buffer(narrowed).read<transport::Narrowed>().front();
                       if (found.count == 0) return {};
                       return ReachedLimit{
                           "media.lines.maximum",
                           "px",
                           static_cast<double>(maximum),
                           static_cast<double>(std::bit_cast<float>(found.widestBits)),
                           fmt::format("{} lines are narrower than they were to be; no flux is "
                                       "lost to it",
                                       found.count),
                           0.0};
                   }});
}

InScattered drawGodRays(FrameBuilder& frame, const GodRayParams& params, Hits hits, EyeBuffer eye,
                        InScattered before) {
    const int photons = hits.incoming.capacity();
    const bool isBatched = photons > kBatchPhotons;
    const bool isFirst = !before.radiance.valid();
    const int run = frame.runsOf(MediaStage::name);
    struct Data {
        InScattered out;
        BatchSum<RadianceTexel> parts;
        graph::Buffer<transport::Narrowed> narrowed;
    };
    const Data& drawn = frame.pass<Data>(
        "media.lines", "the medium scatters what photons carry",
        [&](graph::PassSetup& setup, Data& data) {
            hits.sample(setup);
            hits.incoming.sample(setup);
            setup.sample("receiver", eye.receiver);
            if (isFirst) {
                data.out.radiance = setup.create<RadianceTexel>("media.in_scattered", frame.width(),
                                                                frame.height());
                setup.bypass(data.out.radiance, {0, 0, 0, 0});
            } else {
                data.out.radiance = setup.write(before.radiance);
                setup.bypass(data.out.radiance, before.radiance);
            }
            data.narrowed = setup.createBuffer<transport::Narrowed>(
                run == 1 ? "media.narrowed" : fmt::format("media.narrowed_{}", run), 1);
            setup.bypass(data.narrowed, {0, 0, 0, 0});
            if (isBatched) {
                data.parts = createBatchSum<RadianceTexel>(
                    setup, frame, "media",
                    run == 1 ? "in_scattered" : fmt::format("in_scattered_{}", run));
            }
        },
        [&inputs = frame.inputs(), params, photons, isBatched, isFirst](const Data& data,
                                                                        gl::PassContext& context) {
            if (isFirst) context.texture(data.out.radiance).clear({0, 0, 0, 0});
            clear(context, data.parts);
            context.buffer(data.narrowed).clear();
            gl::Command command = context.shaders(
                {"screen_space_photons/god_rays.vert", "screen_space_photons/god_rays.frag"});
            command.params("media.lines", params)
                .storage("NarrowedLines", data.narrowed)
                .target(isBatched ? data.parts.batch : data.out.radiance)
                .blend(gl::Blend::add);
            for (int first = 0; first < photons; first += kBatchPhotons) {
                command.set("firstPhoton", first)
                    .drawArrays(GL_TRIANGLE_STRIP, 4, std::min(kBatchPhotons, photons - first));
                if (isBatched) addBatch(context, inputs, data.out.radiance, data.parts);
            }
        });
    keepToWidth(frame, params, drawn.narrowed);
    return drawn.out;
}

}  // namespace

void registerGodRays(Registry& registry) {
    registry.node<MediaStage>("lines",
                              {"Draws each photon's path through the medium as a line of the light "
                               "that is scattered towards the eye.",
                               "K06, section 3.2"},
                              &drawGodRays);
}

}  // namespace kaustik
