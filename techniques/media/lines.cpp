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
// (hard case 34): they are summed in fixed point, which no order and no batch changes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/pipeline/frame_builder.h"
#include "techniques/splats/clamped.h"

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
                params::range(0.1f, 100.0f))
            .when(width <= 0.0f, "media.lines.width is set");
        r.field(maximum, "maximum", "Largest width on the screen; lines shrink to it", "px",
                params::range(1, 256));
    }
};

// Columns of a line for one thread: Mesa's software rasteriser silently ends all loops of a thread,
// together with those that run in step with it, after 65,535 turns. Of `rows` each a column has,
// and a line of k columns 64 / k pieces in each.
int columnsOf(const GodRayParams& params) {
    const double widest = std::max(static_cast<double>(params.maximum), 1.0);
    const double rows = 1.4143 * widest + 4.0;
    int columns = 1;
    const auto turns = [&](double n) { return rows * (64.0 * (std::log(n) + 0.6) + 2.0 * n) + n; };
    while (columns < 128 && turns(columns + 1) < 58000.0)
        ++columns;
    return columns;
}

// The unit of the sums of radiance in units of the ledger's, a power of two: where all light passes
// through one pixel as far from the eye as the scene is wide, a 2⁻¹⁴th of what they hold.
float radianceScaleOf(const FrameBuilder& frame) {
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const double extent = bounds.empty ? 1.0 : glm::length(bounds.maximum - bounds.minimum);
    const double pixel = extent * frame.view().footprintPerMeter();
    return static_cast<float>(std::exp2(std::round(std::log2(1024.0 / (pixel * pixel)))));
}

// A node that takes photons through a body at once hands on no light inside of it.
void warnOfDarkBodies(FrameBuilder& frame) {
    if (!frame.needs().closedDielectrics || !frame.traits<SpecularStage>().throughBodies) return;
    frame.once<bool>("media.lines.dark_bodies", [&] {
        frame.warn(fmt::format(
            "media.lines scatters what photons have before them, and specular={} takes them "
            "through bodies at once: nothing is scattered inside of these; take "
            "specular=interface.",
            frame.inputs().params.choice(SpecularStage::name)));
        return std::make_shared<bool>(true);
    });
}

InScattered drawGodRays(FrameBuilder& frame, const GodRayParams& params, Hits hits, EyeBuffer eye,
                        InScattered before) {
    warnOfDarkBodies(frame);
    const bool isFirst = !before.sums.valid();
    const int run = frame.runsOf(MediaStage::name);
    const int w = frame.width();
    const int h = frame.height();
    struct Data {
        InScattered out;
        graph::Buffer<transport::Clamped> clamped;
    };
    const Data& drawn = frame.pass<Data>(
        "media.lines", "the medium scatters what photons carry",
        [&](graph::PassSetup& setup, Data& data) {
            hits.sample(setup);
            hits.incoming.sample(setup);
            setup.sample("receiver", eye.receiver);
            if (isFirst) {
                data.out.sums = setup.create<FluxWord>("media.sums", w, h,
                                                       static_cast<int>(transport::kFluxWords));
                setup.bypass(data.out.sums, {0, 0, 0, 0});
            } else {
                data.out.sums = setup.write(before.sums);
                setup.bypass(data.out.sums, before.sums);
            }
            setup.image("fluxSums", data.out.sums);
            data.clamped = setup.storage(
                "ClampedWidths",
                setup.createBuffer<transport::Clamped>(
                    run == 1 ? "media.clamped" : fmt::format("media.clamped_{}", run), 1));
            setup.bypass(data.clamped, {0, 0, 0, 0});
        },
        [params, isFirst, w, h, list = hits.incoming, scale = radianceScaleOf(frame)](
            const Data& data, gl::PassContext& context) {
            if (!context.isRepeated()) {
                if (isFirst) context.texture(data.out.sums).clear({0, 0, 0, 0});
                context.buffer(data.clamped).clear();
            }
            const int columns = columnsOf(params);
            for (int column = 0; column < std::max(w, h); column += columns) {
                dispatchOver(context.compute("media/lines.comp")
                                 .params("media.lines", params)
                                 .set("radianceScale", scale)
                                 .set("firstColumn", column)
                                 .set("columnCount", columns),
                             list);
            }
        });
    reportWidthLimit(
        frame,
        {"media.lines", "maximum", WidthBound::largest, static_cast<double>(params.maximum), "px",
         "lines are narrower than they were to be"},
        drawn.clamped, 0);
    InScattered out = drawn.out;
    out.radiance = frame.pass<graph::Texture<RadianceTexel>>(
        "media.sum", "what photons scatter becomes radiance",
        [&](graph::PassSetup& setup, graph::Texture<RadianceTexel>& radiance) {
            setup.sample("fluxSums", out.sums);
            radiance = isFirst ? setup.create<RadianceTexel>("media.in_scattered", w, h)
                               : setup.write(before.radiance);
            setup.bypass(radiance, {0, 0, 0, 0});
        },
        [scale = radianceScaleOf(frame)](const graph::Texture<RadianceTexel>& radiance,
                                         gl::PassContext& context) {
            context.fullscreen("media/lines_sum.frag")
                .set("radianceScale", scale)
                .target(radiance)
                .draw();
        });
    return out;
}

}  // namespace

void registerMediaLines(Registry& registry) {
    registry.node<MediaStage>(
        "lines",
        {"Draws each photon's path through the medium as a line of the light that is "
         "scattered towards the eye, as wide as its beam.",
         "K06, section 3.2",
         "Light is scattered once, towards the eye, by a homogeneous medium; lines are no wider "
         "than media.lines.maximum allows. It works on the screen: what light does beside it is "
         "not seen."},
        {.beams = true}, &drawGodRays);
}

}  // namespace kaustik
