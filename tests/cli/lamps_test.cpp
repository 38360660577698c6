// SPDX-License-Identifier: MIT
// Lights that have a size, as a run has them: as much light as the closed form says, seen as lamps,
// by every technique, and at no cost where their size cannot be seen.
#include <nlohmann/json.hpp>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

// A square that shines down on a pane as large as it is, from as far as it is wide; a floor below.
constexpr const char* kLampOverPane = R"(name = "panel"
[camera]
position = [0, 0.2, 3]
target = [0, 0.6, 0]
vertical_fov_degrees = 50
[[material]]
name = "lamp"
type = "lambertian"
albedo = 0
emission = [2, 1, 0.5]
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[material]]
name = "white"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
shape = "plane"
material = "white"
size = [6, 6]
position = [0, -1, 0]
[[object]]
name = "pane"
shape = "plane"
material = "glass"
size = [1, 1]
[[object]]
name = "panel"
shape = "plane"
material = "lamp"
size = [1, 1]
position = [0, 1, 0]
rotation_degrees = [180, 0, 0]
)";

class Lamps : public CommandLine {
  protected:
    Lamps() { static_cast<void>(folder.file("panel.toml", kLampOverPane)); }
    [[nodiscard]] Outcome render(const std::vector<std::string>& settings,
                                 const std::string& technique = "screen_space_photons") const {
        std::vector<std::string> options{"--technique", technique, "--out", "out"};
        for (const std::string& setting : settings) {
            options.emplace_back("--set");
            options.push_back(setting);
        }
        return run(smallRun("panel.toml", options));
    }
    [[nodiscard]] double emitted() const {
        return report().at("energy").at("emitted_w").get<double>() -
               report().at("energy").at("lost_w").value("emission_sampling", 0.0);
    }
};

TEST_F(Lamps, SendTheViewFactorOfASquareToAnother) {
    constexpr double kPi = 3.14159265358979;
    // All channels' mean of the radiance, and the factor by Hottel's formula.
    const double expected = (3.5 / 3.0) * kPi * 0.199825;
    ASSERT_EQ(render({"photons=256x256", "light_points=64"}).exitCode, 0);
    EXPECT_EQ(report().at("scene").at("needs").at("lights"), 64);
    // 64 points on a grid: 0.5 %; the borders of their grids of 32 by 32 as much again.
    EXPECT_NEAR(emitted(), expected, 0.01 * expected);
    ASSERT_EQ(render({"photons=256x256", "light_points=1"}).exitCode, 0);
    EXPECT_GT(emitted(), 1.02 * expected);  // from its middle it sees more of the pane
}

TEST_F(Lamps, AreSeenWithTheirRadiance) {
    ASSERT_EQ(render({}).exitCode, 0);
    const Image seen = readImage(folder / "out/beauty.exr");
    float brightest = 0.0f;
    for (std::size_t i = 0; i < seen.values.size(); i += static_cast<std::size_t>(seen.channels))
        brightest = std::max(brightest, seen.values[i]);
    EXPECT_NEAR(brightest, 2.0f, 0.02f);
}

TEST_F(Lamps, LightEveryEmitterOfPhotons) {
    for (const char* technique : {"planar", "caustic_map", "vertex_caustics", "caustic_triangles",
                                  "adaptive_caustic_map"}) {
        SCOPED_TRACE(technique);
        const Outcome outcome = render({"light_points=4"}, technique);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_GT(report().at("energy").at("deposited_w").get<double>(), 0.01);
        EXPECT_EQ(report().at("violations"), json::array());
    }
}

TEST_F(Lamps, ThatAreTooSmallToBeSeenAreOnePoint) {
    const auto pointsOf = [&](const std::string& degrees) {
        static_cast<void>(folder.file("base.toml", kWavyWater));
        static_cast<void>(folder.file("sun.toml",
                                      "extends = \"base.toml\"\n[[light]]\nname = \"sun\"\n"
                                      "angular_diameter_degrees = " +
                                          degrees + "\n"));
        const Outcome outcome = run({"explain", "sun.toml", "--size", "640x480"});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.out;
    };
    EXPECT_NE(pointsOf("0.001").find("has a size: 1 point ("), std::string::npos);
    EXPECT_NE(pointsOf("20").find("has a size: 16 points ("), std::string::npos);
    EXPECT_EQ(pointsOf("0").find("' has a size"), std::string::npos);
}

TEST_F(Lamps, HaveNoParameterWhereThereAreNone) {
    const Outcome outcome = renderWater({"--set", "light_points=4"});
    EXPECT_NE(outcome.out.find("no light of the scene has a size"), std::string::npos);
}

}  // namespace
}  // namespace kaustik::test
