// SPDX-License-Identifier: MIT
// A resource may outlive the frame: a node that takes the mean of all frames so far.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/image/image.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/renderer.h"
#include "framework/run/output.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"
#include "techniques/register_all.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

IrradianceMap meanOfFrames(FrameBuilder& frame, const params::NoParams&, CausticMap map,
                           Surfaces surfaces) {
    struct Data {
        graph::Texture<IrradianceTexel> sum;
        IrradianceMap mean;
    };
    return frame
        .pass<Data>(
            "gather.mean", "a test",
            [&](graph::PassSetup& setup, Data& data) {
                setup.sample("fluxSums", map.maps.front().flux);
                setup.sample("receiver", surfaces.eye.receiver);
                data.sum =
                    setup.image("sumAndCount", setup.createPersistent<IrradianceTexel>(
                                                   "mean.sum", frame.width(), frame.height()));
                data.mean.irradiance =
                    setup.image("mean", setup.create<IrradianceTexel>(
                                            "caustic.irradiance", frame.width(), frame.height()));
                data.mean.ledger = map.ledger;
            },
            [w = frame.width(), h = frame.height()](const Data&, gl::PassContext& context) {
                context.compute("tests/gpu/shaders/mean_of_frames.comp").dispatchOver(w, 8, h, 8);
            })
        .mean;
}

struct Rendered {
    std::vector<float> values;
    int width = 0;
};

Rendered irradianceOf(const Renderer& renderer) {
    const gl::Texture& texture = renderer.texture(renderer.outputs().caustic.irradiance);
    const Image image = run::readTexture(texture, 0, 3);
    return {image.values, image.width};
}

TEST(WhatLasts, IsThereInTheNextFrameAndInAGraphBuiltAnew) {
    Registry registry = registerAll();
    registry.node<GatherStage>("mean", {"Of all frames.", "a test", "For this test."},
                               &meanOfFrames);
    registry.technique({"mean", "Of all frames.", "a test", {{"gather", "mean"}}, {}});
    scene::Scene scene = scene::loadScene("pool");
    const auto settingsOf = [&](const std::string& technique) {
        RenderSettings settings;
        settings.technique = registry.findTechnique(technique);
        settings.params = registry.makeParams(settings.technique);
        settings.params.set("emit.photons", "64x64", "a test");
        settings.width = 80;
        settings.height = 60;
        return settings;
    };
    gl::PassTimer timer(gl::TimerMode::finish);
    Renderer mean(context(), registry, scene, settingsOf("mean"));
    std::vector<double> sum;
    std::vector<double> first;
    for (int frame = 0; frame < 3; ++frame) {
        scene::setTime(scene, 0.25 * frame);
        // The same memory, though the graph is another.
        mean.update(settingsOf("mean"));
        mean.build(frame == 1 ? Purpose::measurement : Purpose::picture);
        mean.renderFrame(timer);
        Renderer single(context(), registry, scene, settingsOf("screen_space_photons"));
        single.build(Purpose::picture);
        single.renderFrame(timer);
        const Rendered one = irradianceOf(single);
        sum.resize(one.values.size(), 0.0);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += static_cast<double>(one.values[i]);
        if (frame == 0) first = sum;
    }
    const Rendered found = irradianceOf(mean);
    double largest = 0.0;
    double moved = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double expected = sum[i] / 3.0;
        largest = std::max(largest, std::abs(static_cast<double>(found.values[i]) - expected) /
                                        std::max(expected, 1.0));
        moved = std::max(moved, std::abs(first[i] - expected));
    }
    EXPECT_LT(largest, 1e-5);
    EXPECT_GT(moved, 10.0);  // W/m²: the frames differ
    // A new renderer remembers nothing.
    scene::setTime(scene, 0.0);
    Renderer fresh(context(), registry, scene, settingsOf("mean"));
    fresh.build(Purpose::picture);
    fresh.renderFrame(timer);
    const Rendered again = irradianceOf(fresh);
    for (std::size_t i = 0; i < first.size(); i += 97)
        EXPECT_NEAR(again.values[i], first[i], 1e-5 * std::max(first[i], 1.0));
}

}  // namespace
}  // namespace kaustik::test
