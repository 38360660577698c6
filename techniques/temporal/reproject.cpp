// SPDX-License-Identifier: MIT
// temporal.reproject: a running mean of irradiance (W/m²) and, of glossy receivers, radiance
// (W/m²/sr) over frames, each pixel's with what the frame before had where it saw the same place of
// the same receiver. The camera may move, receivers stand still. In and out: the same textures, so
// that all later stages see the mean; "temporal.unfiltered" is what came in.
#include "framework/pipeline/frame_builder.h"
#include "techniques/temporal/reproject_views.h"

namespace kaustik {
namespace {

using temporal::PastViews;

struct ReprojectParams {
    float weight = 0.2f;
    template <class R>
    void reflect(R& r) {
        r.field(weight, "weight",
                "Share of the newest frame in the mean once it is of 1/weight frames or more; "
                "until then all of them count alike; 1: no filter",
                "", params::range(0.001f, 1.0f));
    }
};

// What the frame before saw (reproject.comp, seenHistory).
struct SeenTexel {
    static constexpr Format format = Format::rgba32f;
};

graph::Buffer<PastViews> storePastViews(FrameBuilder& frame) {
    struct Data {
        graph::Buffer<PastViews> views;
    };
    return frame
        .pass<Data>(
            "temporal.views", "the frame before is looked up where it saw the same receivers",
            [&](graph::PassSetup& setup, Data& data) {
                data.views = setup.storage(
                    "Views", setup.createPersistentBuffer<PastViews>("temporal.views", 1));
            },
            [&inputs = frame.inputs()](const Data&, gl::PassContext& context) {
                const glm::dmat4& worldToView = inputs.view.worldToView;
                const glm::dvec3 eye =
                    -(glm::transpose(glm::dmat3(worldToView)) * glm::dvec3(worldToView[3]));
                const glm::dvec3 wholeMeters = glm::floor(eye);
                context.compute("temporal/reproject_views.comp")
                    .set("eyeWholeMeters", glm::vec3(wholeMeters))
                    .set("eyeRest", glm::vec3(eye - wholeMeters))
                    .dispatch(1);
            })
        .views;
}

// For whoever asks for it by its name.
void storeUnfiltered(FrameBuilder& frame, const graph::Texture<IrradianceTexel>& irradiance) {
    struct Data {
        graph::Texture<IrradianceTexel> from;
        graph::Texture<IrradianceTexel> to;
    };
    frame.pass<Data>(
        "temporal.unfiltered", "what the filter is given is asked for",
        [&](graph::PassSetup& setup, Data& data) {
            data.from = setup.read(irradiance);
            data.to =
                setup.create<IrradianceTexel>("temporal.unfiltered", frame.width(), frame.height());
        },
        [](const Data& data, gl::PassContext& context) {
            context.texture(data.from).copyTo(context.texture(data.to));
        });
}

IrradianceMap reproject(FrameBuilder& frame, const ReprojectParams& params,
                        IrradianceMap irradiance, EyeBuffer eye) {
    if (params.weight == 1.0f) {
        frame.skip("temporal.reproject", "the newest frame's weight is 1, which is no filter");
        return irradiance;
    }
    const int width = frame.width();
    const int height = frame.height();
    storeUnfiltered(frame, irradiance.irradiance);
    const graph::Buffer<PastViews> views = storePastViews(frame);
    return frame.pass<IrradianceMap>(
        "temporal.reproject", "irradiance is a mean over frames",
        [&](graph::PassSetup& setup, IrradianceMap& data) {
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            setup.storage("Views", views);
            data.ledger = irradiance.ledger;
            // Of a frame without the filter nothing is remembered either.
            const auto remember = [&](const char* shaderName, const auto& history) {
                setup.image(shaderName, history);
                setup.bypass(history, {0, 0, 0, 0});
            };
            const auto filter = [&](const char* shaderName, const auto& unfiltered) {
                const auto filtered = setup.image(shaderName, setup.write(unfiltered));
                setup.bypass(filtered, unfiltered);
                return filtered;
            };
            remember("seenHistory",
                     setup.createPersistent<SeenTexel>("temporal.seen", width, height, 2));
            remember("irradianceHistory", setup.createPersistent<IrradianceTexel>(
                                              "temporal.irradiance", width, height, 2));
            data.irradiance = filter("irradiance", irradiance.irradiance);
            if (!irradiance.radiance.valid()) return;
            setup.define("HAS_RADIANCE");
            remember("radianceHistory",
                     setup.createPersistent<RadianceTexel>("temporal.radiance", width, height, 2));
            data.radiance = filter("radiance", irradiance.radiance);
        },
        [params, width, height](const IrradianceMap&, gl::PassContext& context) {
            context.compute("temporal/reproject.comp")
                .params("temporal.reproject", params)
                .dispatchOver(width, 8, height, 8);
        });
}

}  // namespace

void registerTemporalReproject(Registry& registry) {
    registry.node<TemporalStage>(
        "reproject",
        {"A running mean over frames, looked up where each receiver was seen before.",
         "WD06; WD08, section 5",
         "The camera may move, but receivers are taken to stand still: where light moves faster "
         "than the mean forgets, it is blurred and late. Each lookup between pixels blurs a "
         "little."},
        &reproject);
}

}  // namespace kaustik
