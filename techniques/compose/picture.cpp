// SPDX-License-Identifier: MIT
// compose.picture: direct light of all lights, the radiance of the receivers with the caustic on
// them, what the eye sees through specular surfaces (stage `view`), the medium in front of all of
// it, and the display image. Irradiance in W/m², radiance in W/m²/sr.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/pixel_mean.h"

namespace kaustik {
namespace {

struct PictureParams {
    float exposure = 0.0f;
    template <class R>
    void reflect(R& r) {
        r.field(
            exposure, "exposure",
            "Brightness of the display image; 0: from the scene's lights and medium, the same for "
            "every technique, camera and size",
            "1/(W/m²/sr)", params::range(0.0f, 1e6f));
    }
};

// Irradiance of one light on what faces it, W/m², in the middle of the scene; of a point light that
// hangs in it, near which there is much more than elsewhere, the geometric mean over the scene's
// box.
double typicalIrradiance(const scene::Light& light, const scene::Bounds& bounds) {
    auto power = static_cast<double>(std::max({light.power.r, light.power.g, light.power.b}));
    if (light.kind == scene::LightKind::directional) return power;
    if (light.kind == scene::LightKind::surface) {
        const glm::dvec3 towards = 0.5 * (bounds.minimum + bounds.maximum) - light.position;
        const double distance = std::max(glm::length(towards), 1e-9);
        power *= std::max(glm::dot(towards, light.direction) / distance, 0.0);
    }
    const glm::dvec3 extent = bounds.maximum - bounds.minimum;
    // Nearer than a part of the box there is hardly anything of it.
    const double minimum = std::max(1e-3 * glm::dot(extent, extent), 1e-6);
    const bool isWithin = light.kind == scene::LightKind::point &&
                          glm::all(glm::lessThan(bounds.minimum, light.position)) &&
                          glm::all(glm::lessThan(light.position, bounds.maximum));
    const int cells = isWithin ? 6 : 1;
    double logarithms = 0.0;
    for (int i = 0; i < cells * cells * cells; ++i) {
        const glm::dvec3 cell(i % cells, i / cells % cells, i / (cells * cells));
        const glm::dvec3 offset =
            bounds.minimum + extent * (cell + 0.5) / static_cast<double>(cells) - light.position;
        logarithms += std::log(std::max(glm::dot(offset, offset), minimum));
    }
    return power / std::exp(logarithms / (cells * cells * cells));
}

// What makes a half-reflecting receiver of the scene a light grey, seen through half of the medium:
// of the scene alone, so that pictures of it can be compared, whatever made them and from wherever
// they are taken.
float automaticExposure(const scene::Scene& scene) {
    const scene::Bounds bounds = sceneBounds(scene);
    double irradiance = static_cast<double>(scene.ambientIrradiance.g);
    for (const scene::Light& light : scene.lights) {
        if (light.band > 0) continue;
        const bool isSky = light.emitter >= 0 &&
                           scene.emitters[static_cast<std::size_t>(light.emitter)].environment;
        // What comes from all around brings a surface a quarter of itself.
        irradiance += (isSky ? 0.25 : 1.0) * typicalIrradiance(light, bounds);
    }
    if (scene.medium) {
        const glm::dvec3 extinction(scene.medium->scatteringPerMeter +
                                    scene.medium->absorptionPerMeter);
        const glm::dvec3 extent = bounds.maximum - bounds.minimum;
        const double path = 0.5 * (extent.x + extent.y + extent.z) / 3.0;
        // A medium that lets less through is seen itself.
        const double depth = path * (extinction.x + extinction.y + extinction.z) / 3.0;
        irradiance *= std::exp(-std::min(depth, 1.0));
    }
    const double exposure = 0.45 * glm::pi<double>() / (0.5 * irradiance);
    return std::isfinite(exposure) ? static_cast<float>(exposure) : 1.0f;
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
            if (lights == 0) {
                context.texture(direct.irradiance).clear({0, 0, 0, 0});
                if (direct.radiance.valid()) context.texture(direct.radiance).clear({0, 0, 0, 0});
            }
            for (int light = 0; light < lights; ++light) {
                gl::Command command = context.fullscreen("compose/picture_direct.frag");
                command.set("lightIndex", light).target(direct.irradiance);
                if (direct.radiance.valid())
                    command.define("GLOSSY_RECEIVERS").target(direct.radiance);
                // The first one's replaces what is there.
                if (light > 0) command.blend(gl::Blend::add);
                command.draw();
            }
        });
}

Radiance shadeReceivers(FrameBuilder& frame, EyeBuffer eye, const DirectLight& direct,
                        const IrradianceMap& caustic) {
    const bool isGlossy = direct.radiance.valid();
    const bool emits = frame.needs().emission;
    const bool isCausticGlossy = caustic.radiance.valid();
    return frame.pass<Radiance>(
        "compose.radiance", "the picture shows the receivers",
        [&](graph::PassSetup& setup, Radiance& out) {
            setup.sample("receiverAlbedo", eye.receiverAlbedo);
            if (isGlossy || emits) setup.sample("receiverSurface", eye.receiverSurface);
            if (isGlossy) {
                setup.sample("directRadiance", direct.radiance);
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
        [isGlossy, isCausticGlossy, emits](const Radiance& out, gl::PassContext& context) {
            gl::Command command = context.fullscreen("compose/picture_radiance.frag");
            if (isGlossy) command.define("GLOSSY_RECEIVERS");
            if (emits) command.define("EMISSION");
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
            gl::Command command = context.fullscreen("compose/picture_medium.frag");
            if (scatters) command.define("SCATTERS");
            command.target(out.radiance).draw();
        });
}

Picture composePicture(FrameBuilder& frame, const PictureParams& params, Geometry geometry,
                       EyeBuffer eye, LayeredDepth layers, LightParts light) {
    const DirectLight direct = lightDirectly(frame, light.shadows, eye);
    const Radiance receivers = shadeReceivers(frame, eye, direct, light.caustic);
    const View seen =
        frame.run<ViewStage>(geometry, eye, layers, receivers, light.shadows, light.map);
    const Radiance ofSamples = lookThroughMedium(frame, eye, {seen.radiance}, light.inScattered);
    const Radiance whole{meanOverPixels(frame, "pixels", ofSamples.radiance)};
    const int side = frame.inputs().samplesPerSide;
    const float exposure =
        params.exposure > 0.0f ? params.exposure : automaticExposure(frame.scene());
    return frame.pass<Picture>(
        "compose.display", fmt::format("the display image is an output; exposure {:.3g}", exposure),
        [&](graph::PassSetup& setup, Picture& data) {
            data.radiance = setup.sample("radiance", whole.radiance);
            data.view = seen;
            data.display =
                setup.create<DisplayTexel>("display", frame.width() / side, frame.height() / side);
        },
        [exposure](const Picture& data, gl::PassContext& context) {
            context.fullscreen("compose/picture_display.frag")
                .set("exposure", exposure)
                .target(data.display)
                .draw();
        });
}

}  // namespace

void registerComposePicture(Registry& registry) {
    registry.node<ComposeStage>(
        "picture",
        {"Direct light with its shadows, the caustic, and what the eye "
         "sees through specular surfaces.",
         "",
         "The display image is for looking at: it is exposed and tone-mapped by one rule for the "
         "scene. Errors are measured on the outputs before it."},
        &composePicture);
}

}  // namespace kaustik
