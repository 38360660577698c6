// SPDX-License-Identifier: MIT
// blur.gaussian: a Gaussian of constant size on the screen over in-scattered light (K06, section
// 3.2), along rows and then along columns. The paper means it for the scattering along the rays,
// which media.lines has in physical units. What is left for it is to even out the stripes of few
// photons; there it does what lines as wide as their beams do better, and it carries light over
// outlines, so that it is not the default (experiments/krueger2006_god_rays.toml: against the
// reference one-pixel lines of 64 x 64 photons gain by it, up to a sigma of 1 pixel at 200 x 150;
// beams lose, and more photons too). At the borders the picture is mirrored, so that every pixel's
// light stays on the screen and an even picture stays even. In, out: radiance, W/m²/sr.
#include <cmath>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {
namespace {

struct GaussianBlurParams {
    float sigma = 2.0f;
    template <class R>
    void reflect(R& r) {
        r.field(sigma, "sigma", "Standard deviation of the Gaussian", "px",
                params::range(0.1f, 64.0f));
    }
};

InScattered blurAlong(FrameBuilder& frame, const GaussianBlurParams& params, InScattered sharp,
                      const std::string& name, glm::ivec2 step) {
    return frame.pass<InScattered>(
        "blur.gaussian", "few photons make stripes",
        [&](graph::PassSetup& setup, InScattered& out) {
            setup.sample("source", sharp.radiance);
            out.radiance = setup.create<RadianceTexel>(name, frame.width(), frame.height());
            setup.bypass(out.radiance, sharp.radiance);
        },
        [sigma = params.sigma, step](const InScattered& out, gl::PassContext& context) {
            context.fullscreen("blur/gaussian.frag")
                .set("sigma", sigma)
                .set("reach", static_cast<int>(std::ceil(3.0f * sigma)))
                .set("along", step)
                .target(out.radiance)
                .draw();
        });
}

InScattered blurGaussian(FrameBuilder& frame, const GaussianBlurParams& params, InScattered sharp) {
    if (!sharp.radiance.valid()) {
        frame.skip("blur.gaussian", "no in-scattered light is made");
        return sharp;
    }
    const InScattered rows = blurAlong(frame, params, sharp, "blur.rows", {1, 0});
    return blurAlong(frame, params, rows, "blur.in_scattered", {0, 1});
}

}  // namespace

void registerBlurGaussian(Registry& registry) {
    registry.node<BlurStage>(
        "gaussian",
        {"Smooths in-scattered light with a Gaussian of constant size on the "
         "screen.",
         "K06, section 3.2",
         "It does not know the scene: it carries light over the outlines of objects. It keeps the "
         "sum over the picture, not the light of each object."},
        &blurGaussian);
}

}  // namespace kaustik
