// SPDX-License-Identifier: MIT
// Photons that landed somewhere, and their paths, judged by the laws of reflection and refraction
// on a slab of glass under two suns: light keeps its azimuth, and across the slab its direction's
// horizontal part is the sun's outside and that over the index inside.
#include "framework/gui/photon_probe.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/pipeline/tracing_log.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "framework/gl/timers.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu_gui/floor_and_glass.h"

namespace kaustik::test {
namespace {

constexpr double kIndex = 1.5;
constexpr double kSlabBottom = 0.5;
constexpr double kSlabTop = 0.7;
constexpr double kFloor = 0.0;
constexpr int kPhotonRows = 32;

constexpr const char* kSlab = R"(
name = "slab"
[camera]
position = [0, 3, 4]
target = [0, 0.3, 0]
[[light]]
name = "east"
type = "directional"
direction = [-0.4, -1, 0]
irradiance = 1000
[[light]]
name = "south"
type = "directional"
direction = [0, -1, -0.6]
irradiance = 1000
[[object]]
name = "slab"
shape = "box"
material = "glass"
size = [2, 0.2, 2]
position = [0, 0.6, 0]
)";

const std::array<glm::dvec3, 2> kSuns = {glm::normalize(glm::dvec3(-0.4, -1, 0)),
                                         glm::normalize(glm::dvec3(0, -1, -0.6))};

class PhotonsUnderASlab : public testing::Test {
  protected:
    using Settings = std::vector<std::pair<std::string, std::string>>;
    gui::PhotonProbe probe(const std::string& splits, float radiusPixels,
                           const Settings& more = {}) {
        RenderSettings settings;
        settings.technique = registry.findTechnique("screen_space_photons");
        settings.params = registry.makeParams(settings.technique);
        settings.params.set("specular", "split", "test");
        settings.params.set("specular.split.levels", splits, "test");
        settings.params.set("emit.photons", "32x" + std::to_string(kPhotonRows), "test");
        for (const auto& [name, value] : more)
            settings.params.set(name, value, "test");
        settings.width = 160;
        settings.height = 120;
        renderer = std::make_unique<Renderer>(context(), registry, scene, std::move(settings));
        renderer->build(Purpose::audit);
        gl::PassTimer timer(gl::TimerMode::finish);
        static_cast<void>(renderer->renderFrame(timer));
        return gui::probePhotons(*renderer, {80, 60}, radiusPixels);
    }
    [[nodiscard]] glm::dvec3 world(const glm::vec3& pointVs) const {
        return glm::dvec3(glm::inverse(renderer->view().worldToView) *
                          glm::dvec4(glm::dvec3(pointVs), 1.0));
    }
    [[nodiscard]] std::size_t arrivals() const {
        std::size_t count = 0;
        for (const TraceRecord& record : renderer->traces()) {
            for (const HitTexel& hit : readHits(*renderer, record.hits))
                count += hit.fate == transport::kFateReceiver ? 1 : 0;
        }
        return count;
    }

    Registry registry = registerAll();
    scene::Scene scene = sceneFromText(std::string(kSlab) + kFloorAndGlass);
    std::unique_ptr<Renderer> renderer;
};

constexpr float kEverywhere = 1e6f;

bool isOn(const glm::dvec3& point, double height) {
    return std::abs(point.y - height) < 2e-3;
}

TEST_F(PhotonsUnderASlab, ComeFromTheirOwnSunByTheLawsOfRefraction) {
    const gui::PhotonProbe probe = this->probe("2", 12.0f);
    ASSERT_GT(probe.paths.size(), 50u);
    std::array<int, 2> judged = {0, 0};
    for (const gui::PhotonPath& path : probe.paths) {
        std::vector<glm::dvec3> points;
        for (const glm::vec3& point : path.points)
            points.push_back(world(point));
        ASSERT_GE(points.size(), 4u) << "a light, two interfaces and the floor";
        const std::size_t light = path.origin.light;
        const glm::dvec3 sun = kSuns[light];
        EXPECT_NEAR(glm::length(glm::normalize(points[1] - points[0]) - sun), 0.0, 1e-4);
        EXPECT_TRUE(isOn(points.back(), kFloor));
        const bool isAcross =
            std::all_of(points.begin() + 1, points.end() - 1, [](const glm::dvec3& point) {
                return isOn(point, kSlabTop) || isOn(point, kSlabBottom);
            });
        if (!isAcross) continue;  // through a side
        ++judged[light];
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            if (points[i] == points[i + 1]) continue;
            const glm::dvec3 segment = glm::normalize(points[i + 1] - points[i]);
            const bool isInside = !isOn(points[i + 1], kFloor);
            const double part = isInside ? 1.0 / kIndex : 1.0;
            // The tracers' depths are 32-bit floats, and the slab is 0.2 m thick.
            EXPECT_NEAR(segment.x, part * sun.x, 5e-3) << "point " << i << " of light " << light;
            EXPECT_NEAR(segment.z, part * sun.z, 5e-3) << "point " << i << " of light " << light;
        }
    }
    EXPECT_GT(judged[0], 10);
    EXPECT_GT(judged[1], 10);
}

TEST_F(PhotonsUnderASlab, AreAllFoundHoweverOftenTheListHasGrown) {
    for (const char* splits : {"0", "1", "2", "3"}) {
        const gui::PhotonProbe probe = this->probe(splits, kEverywhere);
        EXPECT_EQ(probe.landed, arrivals()) << splits;
        std::set<std::array<std::uint32_t, 3>> photons;
        for (const gui::PhotonPath& path : probe.paths)
            photons.insert({path.origin.cell, path.origin.light, path.origin.path});
        EXPECT_EQ(photons.size(), probe.paths.size()) << splits;
    }
}

TEST_F(PhotonsUnderASlab, SayHowManyTheirBatchesHaveOverwritten) {
    const auto with = [&](const char* memory) {
        return probe("1", kEverywhere,
                     {{"driver", "adaptive"},
                      {"emit", "deferred"},
                      {"reconstruct", "sprites"},
                      {"refine.finest", "256"},
                      {"refine.check", "128"},
                      {"refine.memory", memory}});
    };
    const auto traced = [&] {
        std::size_t photons = 0;
        for (const TraceRecord& record : renderer->traces())
            photons += readTracing(*renderer, record)->photons.size();
        return photons;
    };
    EXPECT_EQ(with("1024").overwritten, 0u);
    const std::size_t all = traced();
    const std::size_t overwritten = with("1").overwritten;
    EXPECT_EQ(traced(), all);
    EXPECT_GT(overwritten, all / 2);
    EXPECT_LT(overwritten, all);
}

}  // namespace
}  // namespace kaustik::test
