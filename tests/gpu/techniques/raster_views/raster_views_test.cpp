// SPDX-License-Identifier: MIT
// Layers may be peeled, photons traced and light stored in other views than the eye's: a sun's,
// whose rays are parallel, and the six faces of a cube.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "framework/core/error.h"
#include "framework/numerics/frame.h"
#include "framework/scene/files/scene_file.h"
#include "techniques/layered_depth/depth_peeling.h"
#include "techniques/layered_depth/pyramid.h"
#include "techniques/raster_views/receivers.h"
#include "techniques/register_all.h"
#include "techniques/splats/sprite_splats.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using MakeViews = std::function<Views(FrameBuilder&)>;

// All of the scene, along the first light.
Views sunViews(FrameBuilder& frame, int side) {
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const render::RasterView view = render::makeLightView(frame.scene().lights[0], bounds, bounds);
    return frame.makeViews(render::Space::light, {render::inPixels(view, side, side)});
}

Views cubeViews(FrameBuilder& frame, const glm::dvec3& center, int side) {
    return frame.makeViews(render::Space::cube, render::makeCube(center, 1e-3, side));
}

// A technique that peels, and so traces, in other views.
Registry tracingIn(const MakeViews& makeViews, const std::string& tracer) {
    Registry registry = registerAll();
    registry.node<LayersStage>(
        "elsewhere", {"In other views.", "a test", ""},
        std::function([makeViews](FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
            LayersRequest request{.name = "layers", .layers = 12};
            request.views = makeViews(frame);
            return addPyramid(frame, peel(frame, geometry, request));
        }));
    registry.technique({"elsewhere",
                        "Traces in other views.",
                        "a test",
                        {{"layers", "elsewhere"}, {"trace", tracer}},
                        {}});
    return registry;
}

// A technique that stores light in other views, by the sprites that the screen has.
Registry storingIn(const MakeViews& makeViews, const std::string& gather) {
    Registry registry = registerAll();
    registry.node<ReconstructStage>(
        "elsewhere", {"In other views.", "a test", ""},
        std::function([makeViews](FrameBuilder& frame, const SpritesParams& params, Hits hits,
                                  Surfaces surfaces, CausticMap before) {
            const auto seen = frame.once<ReceiverView>("receivers elsewhere", [&] {
                return std::make_shared<ReceiverView>(renderReceivers(frame, surfaces.geometry,
                                                                      makeViews(frame), "elsewhere",
                                                                      "a test")
                                                          .receivers);
            });
            const Stored stored =
                splatInto(frame, {.params = params}, hits, {*seen, -1, "_elsewhere"},
                          before.maps.empty() ? FluxMap{} : before.maps.front());
            return CausticMap{{stored.map}, stored.ledger};
        }));
    registry.node<GatherStage>(
        "elsewhere", {"By projection.", "a test", ""},
        std::function([](FrameBuilder& frame, const params::NoParams&, CausticMap map,
                         Surfaces surfaces) {
            const FluxMap& stored = map.maps.front();
            return frame.pass<IrradianceMap>(
                "gather.elsewhere", "a test",
                [&](graph::PassSetup& setup, IrradianceMap& data) {
                    setup.sample("fluxSums", stored.flux);
                    setup.sample("mapReceiver", stored.on.receiver);
                    setup.sample("receiver", surfaces.eye.receiver);
                    data.irradiance = setup.create<IrradianceTexel>("caustic.irradiance",
                                                                    frame.width(), frame.height());
                    data.ledger = map.ledger;
                },
                [views = stored.on.views](const IrradianceMap& data, gl::PassContext& context) {
                    gl::Command command =
                        context.fullscreen("tests/gpu/shaders/gather_from_views.frag");
                    command.uniforms("MapViews", views->block()).set("mapCount", views->count());
                    if (views->count() > 1) command.define("CUBE");
                    command.target(data.irradiance).draw();
                });
        }));
    registry.technique({"elsewhere",
                        "Stores flux in other views.",
                        "a test",
                        {{"reconstruct", "elsewhere"}, {"gather", gather}},
                        {}});
    return registry;
}

numerics::Frame render(const Registry& registry, const scene::Scene& scene,
                       const std::string& technique, const numerics::Settings& settings) {
    numerics::FrameRequest request{200, 150, settings, {"eye.receiver"}};
    request.recordsTraces = true;
    return {context(), registry, scene, registry.findTechnique(technique), request};
}

// How many of the photons of one tracing two frames agree on: what they reach, and, within
// `tolerance` metres, where.
struct Agreement {
    int photons = 0;
    int same = 0;
    [[nodiscard]] double share() const { return static_cast<double>(same) / photons; }
};

Agreement agreement(const numerics::Frame& a, const numerics::Frame& b, std::size_t tracing,
                    double tolerance) {
    const Hits& hitsA = a.renderer().traces()[tracing].hits;
    const Hits& hitsB = b.renderer().traces()[tracing].hits;
    const auto list =
        b.renderer().buffer(hitsB.incoming.list).read<transport::PhotonList>().front();
    const Texels positionA = a.read(hitsA.position);
    const Texels positionB = b.read(hitsB.position);
    const Texels surfaceA = a.read(hitsA.surface);
    const Texels surfaceB = b.read(hitsB.surface);
    Agreement result;
    for (unsigned i = 0; i < list.count; ++i) {
        const int x = static_cast<int>(i % list.rowLength);
        const int y = static_cast<int>(i / list.rowLength);
        ++result.photons;
        const bool isSame = surfaceA.at(x, y, 3) == surfaceB.at(x, y, 3) &&
                            glm::distance(positionA.rgb(x, y), positionB.rgb(x, y)) <= tolerance;
        if (isSame) ++result.same;
    }
    return result;
}

void expectTracersAgree(const std::string& sceneName, const MakeViews& makeViews,
                        const std::string& tracer, const std::string& exactTechnique,
                        double tolerance, double minShare) {
    const scene::Scene scene = scene::loadScene(sceneName);
    const Registry registry = tracingIn(makeViews, tracer);
    const numerics::Settings settings{{"emit.photons", "64x64"}};
    const numerics::Frame traced = render(registry, scene, "elsewhere", settings);
    const numerics::Frame exact = render(registry, scene, exactTechnique, settings);
    const Agreement found = agreement(traced, exact, 0, tolerance);
    EXPECT_GT(found.photons, 1000);
    EXPECT_GE(found.share(), minShare) << found.same << " of " << found.photons;
    EXPECT_LT(std::abs(traced.renderer().ledger().balance()), 1e-6);
}

Views sun512(FrameBuilder& frame) {
    return sunViews(frame, 512);
}

const std::vector<std::string> kTracersInAnyView{"hierarchical", "hierarchical_compute", "march",
                                                 "march_compute"};

// Floor and walls of still water are flat: their planes judge.
TEST(LayersInTheSunsView, GiveTheHitsOfAnalyticPlanes) {
    for (const std::string& tracer : kTracersInAnyView) {
        SCOPED_TRACE(tracer);
        expectTracersAgree("flat-water", sun512, tracer, "planar", 1e-4, 0.999);
    }
}

TEST(LayersInTheSunsView, GiveTheHitsOfExactRays) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    for (const std::string& tracer : kTracersInAnyView) {
        SCOPED_TRACE(tracer);
        expectTracersAgree("flat-water", sun512, tracer, "raytraced", 1e-4, 0.999);
        // From the water's waves to a floor and walls that the sun sees nearly edge-on.
        expectTracersAgree("pool", sun512, tracer, "raytraced", 0.02, 0.97);
    }
}

TEST(LayersOnACube, GiveTheHitsOfExactRays) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    // Around the ball, so that every ray in it crosses a face or two.
    const auto cube = [](FrameBuilder& frame) {
        const scene::Scene& scene = frame.scene();
        for (const scene::Object& object : scene.objects) {
            if (scene.materials[object.material].kind != scene::MaterialKind::dielectric) continue;
            const scene::Bounds bounds = objectBounds(scene, object);
            return cubeViews(frame, 0.5 * (bounds.minimum + bounds.maximum), 256);
        }
        throw std::logic_error("no ball");
    };
    for (const char* tracer : {"hierarchical", "march_compute"}) {
        SCOPED_TRACE(tracer);
        expectTracersAgree("glass-sphere", cube, tracer, "raytraced", 0.01, 0.99);
    }
}

// Still water lets the sun's light through straight down: the floor's irradiance has a closed form.
void expectClosedForm(const MakeViews& makeViews, double tolerance) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Registry registry = storingIn(makeViews, "elsewhere");
    // So wide that a texel's splats even out, however much of the floor it sees.
    const numerics::Frame frame =
        render(registry, scene, "elsewhere",
               {{"emit.photons", "256x256"}, {"reconstruct.elsewhere.footprints", "6"}});
    const double below = (1.333 - 1.0) / (1.333 + 1.0);
    const double expected = 1000.0 * (1.0 - below * below);
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    int floorPixels = 0;
    double largest = 0.0;
    double sum = 0.0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = static_cast<double>(receiver.at(x, y, 0));
            if (depth <= 0.0) continue;
            const glm::dvec3 world = frame.worldAt(x, y, depth);
            const bool isInside = std::abs(world.x) < 1.8 && std::abs(world.z) < 1.3;
            if (!isInside || std::abs(world.y + 1.2) > 1e-3) continue;
            ++floorPixels;
            sum += irradiance.rgb(x, y).g;
            largest = std::max(largest, std::abs(irradiance.rgb(x, y).g / expected - 1.0));
        }
    }
    EXPECT_GT(floorPixels, 5000);
    // A texel's middle stands for all of it, which shows where it sees the floor at a slant.
    EXPECT_LE(largest, tolerance);
    EXPECT_NEAR(sum / floorPixels, expected, 1e-3 * expected);
    // What the map holds is what the ledger says, whatever the screen shows of it.
    const EnergyLedger ledger = frame.renderer().ledger();
    EXPECT_LT(std::abs(ledger.balance()), 1e-6);
    EXPECT_NEAR(
        ledger.watts[transport::kAccountDeposited] + ledger.watts[transport::kAccountOutsideMap] +
            ledger.watts[transport::kAccountHiddenInMap],
        ledger.watts[transport::kAccountArrived], 1e-6 * ledger.watts[transport::kAccountArrived]);
    EXPECT_GT(ledger.watts[transport::kAccountDeposited],
              0.99 * ledger.watts[transport::kAccountArrived]);
}

TEST(LightInTheSunsView, HasTheIrradianceOfTheClosedForm) {
    expectClosedForm([](FrameBuilder& frame) { return sunViews(frame, 128); }, 4e-3);
}

TEST(LightOnACube, HasTheIrradianceOfTheClosedForm) {
    expectClosedForm(
        [](FrameBuilder& frame) {
            return cubeViews(frame, {0.1, -0.5, 0.2}, 96);
        },
        2e-2);
}

std::string refusalOf(const std::function<void()>& act) {
    try {
        act();
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(ANodeInASpaceThatItCannotServe, SaysSo) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const auto sun = [](FrameBuilder& frame) { return sunViews(frame, 64); };
    const auto cube = [](FrameBuilder& frame) { return cubeViews(frame, {0.0, -0.5, 0.0}, 64); };
    const auto refusal = [&](const Registry& registry) {
        return refusalOf([&] { static_cast<void>(render(registry, scene, "elsewhere", {})); });
    };
    EXPECT_EQ(refusal(storingIn(sun, "screen")),
              "gather.screen looks light up by the eye's pixels, but it is stored in the lights' "
              "maps; take gather=project, or reconstruct.space=screen.");
    EXPECT_EQ(refusal(storingIn(cube, "screen")),
              "gather.screen looks light up by the eye's pixels, but it is stored in the lights' "
              "maps; take gather=project, or reconstruct.space=screen.");
    EXPECT_EQ(refusal(tracingIn(sun, "lines")),
              "trace.lines works on the screen, but the layers it is given are in a light's view.");
    EXPECT_EQ(refusal(tracingIn(cube, "all_hits")),
              "trace.all_hits works on the screen, but the layers it is given are on the faces of "
              "a cube.");
}

}  // namespace
}  // namespace kaustik::test
