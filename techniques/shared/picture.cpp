// SPDX-License-Identifier: MIT
// compose.picture: direct light of all lights, the radiance of the receivers with the caustic on
// them, what the eye sees through specular surfaces (stage `view`), the medium in front of all of
// it, and the display image. Irradiance in W/m², radiance in W/m²/sr.
#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

struct PictureParams {
    float exposure = 0.0f;
    template <class R>
    void reflect(R& r) {
        r.field(
            exposure, "exposure",
            "Brightness of the display image; 0: from the irradiance at the middle of the scene",
            "1/(W/m²/sr)", params::range(0.0f, 1e6f));
    }
};

// What makes a half-reflecting receiver in the middle of the scene a middle grey.
float automaticExposure(const scene::Scene& scene) {
    const scene::Bounds bounds = sceneBounds(scene);
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    double irradiance = static_cast<double>(scene.ambientIrradiance.g);
    for (const scene::Light& light : scene.lights) {
        const glm::dvec3 offset = middle - light.position;
        const double spread = light.kind == scene::LightKind::directional
                                  ? 1.0
                                  : std::max(glm::dot(offset, offset), 1e-6);
        irradiance +=
            static_cast<double>(std::max({light.power.r, light.power.g, light.power.b})) / spread;
    }
    return irradiance > 0.0 ? static_cast<float>(0.45 * 3.14159265 / (0.5 * irradiance)) : 1.0f;
}

struct DirectLight {
    graph::Texture<IrradianceTexel> irradiance;
    graph::Texture<RadianceTexel> radiance;  // towards the eye; invalid where no receiver is glossy
};

DirectLight lightDirectly(FrameBuilder& frame, const Shadows& shadows, EyeBuffer eye) {
    const bool isGlossy = frame.needs().glossyReceivers;
    const int lights = frame.needs().lights;
    return frame.pass<DirectLight>(
        "compose.direct", "receivers are lit directly too",
        [&](graph::PassSetup& setup, DirectLight& direct) {
            if (lights > 0) setup.sample("visibility", shadows.visibility);
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            direct.irradiance =
                setup.create<IrradianceTexel>("direct.irradiance", frame.width(), frame.height());
            setup.bypass(direct.irradiance, {0, 0, 0, 0});
            if (!isGlossy) return;
            setup.sample("receiverAlbedo", eye.receiverAlbedo);
            direct.radiance =
                setup.create<RadianceTexel>("direct.radiance", frame.width(), frame.height());
            setup.bypass(direct.radiance, {0, 0, 0, 0});
        },
        [lights](const DirectLight& direct, gl::PassContext& context) {
            context.texture(direct.irradiance).clear({0, 0, 0, 0});
            if (direct.radiance.valid()) context.texture(direct.radiance).clear({0, 0, 0, 0});
            for (int light = 0; light < lights; ++light) {
                gl::Command command = context.fullscreen("shared/direct.frag");
                command.set("lightIndex", light).target(direct.irradiance);
                if (direct.radiance.valid())
                    command.define("GLOSSY_RECEIVERS").target(direct.radiance);
                command.blend(gl::Blend::add).draw();
            }
        });
}

Radiance shadeReceivers(FrameBuilder& frame, EyeBuffer eye, const DirectLight& direct,
                        const IrradianceMap& caustic) {
    const bool isGlossy = direct.radiance.valid();
    const bool isCausticGlossy = caustic.radiance.valid();
    return frame.pass<Radiance>(
        "compose.radiance", "the picture shows the receivers",
        [&](graph::PassSetup& setup, Radiance& out) {
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverAlbedo", eye.receiverAlbedo);
            if (isGlossy) {
                setup.sample("directRadiance", direct.radiance);
                setup.sample("receiverSurface", eye.receiverSurface);
            } else {
                setup.sample("directIrradiance", direct.irradiance);
            }
            if (isCausticGlossy) {
                setup.sample("causticRadiance", caustic.radiance);
            } else {
                setup.sample("causticIrradiance", caustic.irradiance);
            }
            out.radiance = setup.create<RadianceTexel>("compose.receiver_radiance", frame.width(),
                                                       frame.height());
        },
        [isGlossy, isCausticGlossy](const Radiance& out, gl::PassContext& context) {
            gl::Command command = context.fullscreen("shared/radiance.frag");
            if (isGlossy) command.define("GLOSSY_RECEIVERS");
            if (isCausticGlossy) command.define("CAUSTIC_RADIANCE");
            command.target(out.radiance).draw();
        });
}

// What the eye sees is weakened along the straight eye ray, and what the medium scatters on it
// comes on top: after the view stage, since much of it is scattered in front of any specular
// surface and must not get lost there. What is scattered beyond one is shown unrefracted.
Radiance lookThroughMedium(FrameBuilder& frame, EyeBuffer eye, Radiance seen,
                           const InScattered& inScattered) {
    if (!frame.needs().medium) {
        frame.skip("compose.medium", "the scene has no medium");
        return seen;
    }
    const bool scatters = inScattered.radiance.valid();
    return frame.pass<Radiance>(
        "compose.medium", "the eye looks through the medium",
        [&](graph::PassSetup& setup, Radiance& out) {
            setup.sample("receiver", eye.receiver);
            setup.sample("seenRadiance", seen.radiance);
            if (scatters) setup.sample("inScattered", inScattered.radiance);
            out.radiance =
                setup.create<RadianceTexel>("compose.radiance", frame.width(), frame.height());
            setup.bypass(out.radiance, seen.radiance);
        },
        [scatters](const Radiance& out, gl::PassContext& context) {
            gl::Command command = context.fullscreen("shared/medium.frag");
            if (scatters) command.define("SCATTERS");
            command.target(out.radiance).draw();
        });
}

Picture composePicture(FrameBuilder& frame, const PictureParams& params, Geometry geometry,
                       EyeBuffer eye, LayeredDepth layers, LightParts light) {
    const DirectLight direct = lightDirectly(frame, light.shadows, eye);
    const Radiance receivers = shadeReceivers(frame, eye, direct, light.caustic);
    const View seen = frame.run<ViewStage>(geometry, eye, layers, receivers, light.shadows);
    const Radiance whole = lookThroughMedium(frame, eye, {seen.radiance}, light.inScattered);
    const float exposure =
        params.exposure > 0.0f ? params.exposure : automaticExposure(frame.scene());
    return frame.pass<Picture>(
        "compose.display", "the display image is an output",
        [&](graph::PassSetup& setup, Picture& data) {
            data.radiance = setup.sample("radiance", whole.radiance);
            data.view = seen;
            data.display = setup.create<DisplayTexel>("display", frame.width(), frame.height());
        },
        [exposure](const Picture& data, gl::PassContext& context) {
            context.fullscreen("shared/display.frag")
                .set("exposure", exposure)
                .target(data.display)
                .draw();
        });
}

}  // namespace

void registerPicture(Registry& registry) {
    registry.node<ComposeStage>("picture",
                                {"Direct light with its shadows, the caustic, and what the eye "
                                 "sees through specular surfaces.",
                                 ""},
                                &composePicture);
}

}  // namespace kaustik
