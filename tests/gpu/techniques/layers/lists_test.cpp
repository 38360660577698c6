// SPDX-License-Identifier: MIT
// Layers from lists of fragments are those of peeling, bit for bit: at every size, in every view,
// with surfaces that lie in one another, and where the lists have no room.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>

#include "framework/gl/access_counter.h"
#include "framework/scene/files/scene_file.h"
#include "techniques/layered_depth/fragment_lists.h"
#include "techniques/layered_depth/pyramid.h"
#include "techniques/register_all.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {
namespace {

const std::vector<std::string> kSaved{"layers.depth",        "layers.surface",
                                      "layers.statistics",   "view.layers.depth",
                                      "view.layers.surface", "layers.pyramid"};

std::uint32_t bitsOf(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

// Values of all layers of a texture that are not the same bits in both.
std::size_t differences(const numerics::Frame& a, const numerics::Frame& b,
                        const graph::ResourceRef& left, const graph::ResourceRef& right,
                        int layers) {
    std::size_t different = 0;
    for (int layer = 0; layer < layers; ++layer) {
        const Texels x = a.read(left, layer);
        const Texels y = b.read(right, layer);
        EXPECT_EQ(x.values.size(), y.values.size());
        for (std::size_t i = 0; i < x.values.size(); ++i)
            different += bitsOf(x.values[i]) == bitsOf(y.values[i]) ? 0 : 1;
    }
    return different;
}

void expectSameStatistics(const numerics::Frame& a, const numerics::Frame& b) {
    const transport::LayerStatistics x = a.renderer().layerStatistics();
    const transport::LayerStatistics y = b.renderer().layerStatistics();
    EXPECT_GT(x.fragments, 0u);
    EXPECT_EQ(x.complexity, y.complexity);
    EXPECT_EQ(x.fragments, y.fragments);
    EXPECT_EQ(x.skipped, y.skipped);
    EXPECT_EQ(x.pixelsSkipped, y.pixelsSkipped);
}

void expectSameLayers(const numerics::Frame& a, const numerics::Frame& b) {
    const LayeredDepth& left = a.renderer().outputs().layers;
    const LayeredDepth& right = b.renderer().outputs().layers;
    ASSERT_EQ(left.layers, right.layers);
    const int layers = left.views->layers(left.layers);
    EXPECT_EQ(differences(a, b, left.depth, right.depth, layers), 0u);
    EXPECT_EQ(differences(a, b, left.surface, right.surface, layers), 0u);
    EXPECT_EQ(differences(a, b, left.pyramid, right.pyramid, layers), 0u);
    expectSameStatistics(a, b);
}

void expectSameTexture(const Frame& a, const Frame& b, const std::string& name, int layers) {
    const auto handle = [&](const Frame& frame) { return frame.renderer().graph().find(name); };
    ASSERT_TRUE(handle(a).valid()) << name;
    EXPECT_EQ(differences(a, b, handle(a), handle(b), layers), 0u) << name;
}

Settings with(Settings settings, const Settings& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

const Settings kFew = {{"emit.photons", "16x16"}};

struct Rendered {
    Frame peeled;
    Frame listed;
};

// Both ways, each in memory that starts as NaN.
Rendered renderBoth(const scene::Scene& scene, int width, int height, const Settings& settings) {
    const Settings all = with(kFew, settings);
    return {Frame(scene, width, height, with(all, {{"layers", "peel"}}), kSaved, true),
            Frame(scene, width, height, with(all, {{"layers", "lists"}}), kSaved, true)};
}

std::vector<std::string> limitsOf(const numerics::Frame& frame) {
    std::vector<std::string> names;
    for (const ReachedLimit& limit : frame.renderer().reachedLimits())
        names.push_back(limit.parameter);
    return names;
}

bool reaches(const numerics::Frame& frame, const std::string& limit) {
    const std::vector<std::string> names = limitsOf(frame);
    return std::count(names.begin(), names.end(), limit) == 1;
}

bool peeledForLists(const numerics::Frame& frame) {
    return reaches(frame, "layers.lists.memory") ||
           reaches(frame, "layers.lists.fragments_per_pixel") ||
           reaches(frame, "layers.lists.longest");
}

TEST(FragmentLists, GiveTheLayersOfPeeling) {
    for (const char* name : {"pool", "cornell-bunny", "glass-sphere", "concave-glass",
                             "water-from-below", "pool-reflections"}) {
        SCOPED_TRACE(name);
        const scene::Scene scene = scene::loadScene(name);
        const Rendered both = renderBoth(scene, 200, 150, {});
        expectSameLayers(both.peeled, both.listed);
        expectSameTexture(both.peeled, both.listed, "view.layers.depth", 1);
        expectSameTexture(both.peeled, both.listed, "view.layers.surface", 1);
        EXPECT_FALSE(peeledForLists(both.listed));
    }
}

TEST(FragmentLists, DoSoAtAnySizeAndNumberOfLayers) {
    const scene::Scene scene = scene::loadScene("concave-glass");
    for (const auto& [width, height] : {std::pair(37, 23), std::pair(1, 1), std::pair(130, 9)}) {
        for (const char* count : {"1", "8", "9", "64"}) {
            SCOPED_TRACE(testing::Message() << width << "x" << height << ", " << count);
            const Rendered both = renderBoth(scene, width, height, {{"layers.count", count}});
            expectSameLayers(both.peeled, both.listed);
        }
    }
}

// Three bodies of which each holds the next, and many surfaces in a pixel.
TEST(FragmentLists, DoSoWhereManySurfacesLieBehindOneAnother) {
    std::string text = R"(
name = "shells"
[camera]
position = [0.1, 0.2, 6]
target = [0, 0, 0]
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
)" + greyFloor(9.0, -2.0);
    for (int i = 0; i < 20; ++i) {
        text += "[[object]]\nname = \"shell " + std::to_string(i) +
                "\"\nshape = \"sphere\"\nsegments = 24\nmaterial = \"" +
                (i % 3 == 2 ? "grey" : "glass") + "\"\nradius = " + std::to_string(0.2 + 0.07 * i) +
                "\n";
    }
    const scene::Scene scene = sceneFromText(text);
    for (const char* count : {"3", "8", "50"}) {
        SCOPED_TRACE(count);
        const Rendered both = renderBoth(scene, 97, 61, {{"layers.count", count}});
        expectSameLayers(both.peeled, both.listed);
        EXPECT_GE(both.listed.renderer().layerStatistics().complexity, 40u);
    }
}

// Each surface a second time in its place, with other normals: in the same mesh before or after
// the first, and as an object of its own material.
scene::Scene doubled(scene::Scene scene, bool isBefore) {
    for (scene::Mesh& mesh : scene.meshes) {
        if (mesh.heightField) continue;
        const auto count = static_cast<glm::uint>(mesh.positions.size());
        for (glm::uint i = 0; i < count; ++i) {
            const glm::vec3 n = mesh.normals[i];
            mesh.positions.push_back(mesh.positions[i]);
            mesh.normals.push_back(glm::normalize(n + glm::vec3(0.1f, 0.02f, -0.07f)));
            mesh.uvs.push_back(mesh.uvs[i]);
        }
        std::vector<glm::uvec3> second;
        for (const glm::uvec3& triangle : mesh.triangles)
            second.push_back(triangle + count);
        mesh.triangles.insert(isBefore ? mesh.triangles.begin() : mesh.triangles.end(),
                              second.begin(), second.end());
    }
    const std::size_t objects = scene.objects.size();
    for (std::size_t i = 0; i < objects; ++i) {
        scene::Object object = scene.objects[i];
        object.name += " again";
        object.material = scene.objects[(i + 1) % objects].material;
        scene.objects.push_back(object);
    }
    return scene;
}

TEST(FragmentLists, KeepTheFirstOfSurfacesThatLieInOneAnother) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    std::vector<Rendered> frames;
    for (const bool isBefore : {false, true}) {
        SCOPED_TRACE(isBefore);
        frames.push_back(renderBoth(doubled(scene, isBefore), 120, 90, {}));
        const Rendered& both = frames.back();
        expectSameLayers(both.peeled, both.listed);
        // Each of them four times.
        std::size_t kept = 0;
        const LayeredDepth& layers = both.listed.renderer().outputs().layers;
        for (int layer = 0; layer < layers.layers; ++layer) {
            const Texels texels = both.listed.read(layers.depth, layer);
            for (std::size_t i = 0; i < texels.values.size(); i += 4)
                kept += texels.values[i] > 0.0f ? 1 : 0;
        }
        EXPECT_EQ(both.listed.renderer().layerStatistics().fragments, 4 * kept);
    }
    // The order of drawing shows: a list that keeps any of them would not be noticed else.
    const auto surface = [&](std::size_t i) {
        return frames[i].listed.renderer().outputs().layers.surface;
    };
    EXPECT_GT(differences(frames[0].listed, frames[1].listed, surface(0), surface(1), 1), 1000u);
}

TEST(FragmentLists, ThatHaveNoRoomLeaveTheViewToPeelingAndSaySo) {
    const scene::Scene scene = scene::loadScene("pool");
    struct Limited {
        Settings settings;
        std::string limit;
    };
    const std::vector<Limited> all{
        {{{"layers.lists.memory", "1"}}, "layers.lists.memory"},
        {{{"layers.lists.fragments_per_pixel", "1"}}, "layers.lists.fragments_per_pixel"},
    };
    for (const Limited& limited : all) {
        SCOPED_TRACE(limited.limit);
        const Rendered both = renderBoth(scene, 320, 240, limited.settings);
        expectSameLayers(both.peeled, both.listed);
        const std::vector<ReachedLimit> limits = both.listed.renderer().reachedLimits();
        const auto found = std::find_if(
            limits.begin(), limits.end(),
            [&](const ReachedLimit& limit) { return limit.parameter == limited.limit; });
        ASSERT_NE(found, limits.end());
        EXPECT_EQ(found->value, 1.0);
        EXPECT_EQ(found->lostWatts, 0.0);
        const auto fragments =
            static_cast<double>(both.listed.renderer().layerStatistics().fragments);
        EXPECT_EQ(found->needed, limited.limit == "layers.lists.fragments_per_pixel"
                                     ? std::ceil(fragments / (320.0 * 240.0))
                                     : std::ceil(fragments * 36.0 / 1048576.0));
        // With what is said to be needed there is room.
        Settings enough = limited.settings;
        enough.front().second = std::to_string(static_cast<int>(found->needed));
        EXPECT_FALSE(peeledForLists(renderBoth(scene, 320, 240, enough).listed));
    }
}

// A list of so many fragments that a thread could not walk it.
TEST(FragmentLists, ThatAreTooLongLeaveTheViewToPeelingAndSaySo) {
    scene::Scene scene = sceneFromText(R"(
name = "sheets"
[camera]
position = [0, 0, 0]
target = [0, 0, -1]
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "sheets"
shape = "plane"
material = "grey"
size = [9, 9]
rotation_degrees = [90, 0, 0]
position = [0, 0, -3]
[[object]]
name = "behind the camera"
shape = "sphere"
material = "glass"
segments = 8
radius = 0.2
position = [0, 0, 3]
)");
    scene::Mesh& sheets = scene.meshes[scene.objects[0].mesh];
    const std::size_t vertices = sheets.positions.size();
    const std::size_t triangles = sheets.triangles.size();
    for (glm::uint i = 1; i < 1000; ++i) {
        for (std::size_t v = 0; v < vertices; ++v) {
            sheets.positions.push_back(sheets.positions[v] +
                                       1e-4f * static_cast<float>(i) * sheets.normals[v]);
            sheets.normals.push_back(sheets.normals[v]);
            sheets.uvs.push_back(sheets.uvs[v]);
        }
        for (std::size_t t = 0; t < triangles; ++t) {
            sheets.triangles.push_back(sheets.triangles[t] + i * static_cast<glm::uint>(vertices));
        }
    }
    const Rendered both = renderBoth(scene, 12, 9, {{"layers.count", "64"}});
    EXPECT_GT(both.listed.renderer().layerStatistics().complexity, 65000u / 66u);
    EXPECT_TRUE(reaches(both.listed, "layers.lists.longest"));
    expectSameLayers(both.peeled, both.listed);
}

// What is made of the layers, where nobody keeps them and memory starts as NaN: who reads one that
// a pixel does not have takes that for a surface. Layers that are kept are cleared.
TEST(FragmentLists, AreReadNoFartherThanThePixelsLayersGo) {
    struct Reader {
        std::string technique;
        Settings settings;
    };
    const std::string ownTechnique = "screen_space_photons";
    std::vector<Reader> readers{
        {"caustic_triangles", {}},
        {ownTechnique, {{"shadow", "rays"}}},
        {ownTechnique, {{"trace.test", "in_out"}}},
        {ownTechnique, {{"view.refraction.search", "all"}}},
        {ownTechnique, {{"view.refraction.surfaces", "layers"}}},
        {ownTechnique, {{"view.refraction.interfaces", "6"}, {"view.refraction.stop", "depth"}}},
    };
    for (const char* tracer :
         {"march", "march_compute", "lines", "hierarchical", "hierarchical_compute", "all_hits"})
        readers.push_back({ownTechnique, {{"trace", tracer}}});
    const Settings photons = {{"emit.photons", "48x48"}};
    for (const char* name : {"pool", "concave-glass"}) {
        const scene::Scene scene = scene::loadScene(name);
        for (const Reader& reader : readers) {
            SCOPED_TRACE(testing::Message()
                         << name << ", " << reader.technique << ", "
                         << (reader.settings.empty() ? ""
                                                     : reader.settings.front().first + "=" +
                                                           reader.settings.front().second));
            const auto render = [&](const char* layers, const std::vector<std::string>& kept) {
                return Frame(scene, 93, 61,
                             with(photons, with(reader.settings, {{"layers", layers}})), kept, true,
                             reader.technique);
            };
            const bool isOfScreen = reader.technique == ownTechnique;
            const Frame cleared = render(
                "peel", isOfScreen
                            ? std::vector<std::string>{"layers.depth", "layers.surface",
                                                       "view.layers.depth", "view.layers.surface"}
                            : std::vector<std::string>{});
            EXPECT_GT(cleared.causticIrradiance().sum(), 0.0);
            for (const char* node : {"peel", "lists"}) {
                const Frame read = render(node, {});
                const FrameOutputs& left = cleared.renderer().outputs();
                const FrameOutputs& right = read.renderer().outputs();
                EXPECT_EQ(differences(cleared, read, left.caustic.irradiance,
                                      right.caustic.irradiance, 1),
                          0u)
                    << node;
                EXPECT_EQ(
                    differences(cleared, read, left.picture.radiance, right.picture.radiance, 1),
                    0u)
                    << node;
            }
        }
    }
}

// A fragment is 36 bytes in its list and 32 as a layer. A pixel has 12 for its list, its count and
// its depth; a depth of 0 where its layers end, and where others nearby have more.
TEST(FragmentLists, WriteNoLayersThatAreNotThere) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    Frame frame(scene, 160, 120, with(kFew, {{"layers", "lists"}, {"layers.count", "8"}}));
    gl::AccessCounter counter(frame.renderer().programs());
    frame.renderer().executor().countAccesses(&counter);
    gl::PassTimer timer(gl::TimerMode::finish);
    frame.renderer().renderFrame(timer);
    const std::uint64_t fragments = frame.renderer().layerStatistics().fragments;
    const std::uint64_t pixels = 160 * 120;
    const std::vector<gl::PassAccesses> passes = counter.take();
    const auto lists = std::find_if(passes.begin(), passes.end(), [](const gl::PassAccesses& pass) {
        return pass.name == "layers.lists";
    });
    ASSERT_NE(lists, passes.end());
    EXPECT_GE(lists->writtenBytes, 68 * fragments);
    EXPECT_LE(lists->writtenBytes, 68 * fragments + (12 + 2 * 16) * pixels + 4096);
}

using MakeViews = std::function<Views(FrameBuilder&)>;

// A technique whose layers are made in other views, by lists of so many MiB or peeled.
Registry elsewhere(const MakeViews& makeViews, int mebibytes) {
    Registry registry = registerAll();
    registry.node<LayersStage>(
        "elsewhere", {"In other views.", "a test", ""},
        std::function([=](FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
            LayersRequest request{.name = "layers", .layers = 6};
            request.views = makeViews(frame);
            const LayeredDepth layers =
                mebibytes == 0 ? peel(frame, geometry, request)
                               : listFragments(frame, geometry, request, {mebibytes, 64});
            return addPyramid(frame, layers);
        }));
    registry.technique({"elsewhere",
                        "Makes layers in other views.",
                        "a test",
                        {{"layers", "elsewhere"}, {"trace", "hierarchical"}},
                        {}});
    return registry;
}

// Whether lists of that memory were peeled in part.
bool expectTheSameIn(const MakeViews& makeViews, int mebibytes) {
    const scene::Scene scene = scene::loadScene("pool");
    const Registry peeling = elsewhere(makeViews, 0);
    const Registry listing = elsewhere(makeViews, mebibytes);
    const auto render = [&](const Registry& registry) {
        return numerics::Frame(
            context(), registry, scene, registry.findTechnique("elsewhere"),
            {64, 48, kFew, {"layers.depth", "layers.surface", "layers.pyramid"}, false, true});
    };
    const numerics::Frame peeled = render(peeling);
    const numerics::Frame listed = render(listing);
    expectSameLayers(peeled, listed);
    return peeledForLists(listed);
}

Views sunViews(FrameBuilder& frame) {
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const render::RasterView view = render::makeLightView(frame.scene().lights[0], bounds, bounds);
    return frame.makeViews(render::Space::light, {render::inPixels(view, 131, 77)});
}

// Not in the middle, so that its faces see unlike many surfaces.
Views cubeViews(FrameBuilder& frame) {
    return frame.makeViews(render::Space::cube, render::makeCube({0.3, -0.4, 0.2}, 1e-3, 144));
}

TEST(FragmentLists, GiveTheLayersOfPeelingInTheSunsView) {
    EXPECT_FALSE(expectTheSameIn(sunViews, 256));
}

TEST(FragmentLists, GiveTheLayersOfPeelingOnACube) {
    EXPECT_FALSE(expectTheSameIn(cubeViews, 256));
    // A mebibyte is enough for some of its faces.
    EXPECT_TRUE(expectTheSameIn(cubeViews, 1));
}

}  // namespace
}  // namespace kaustik::test
