// SPDX-License-Identifier: MIT
// Photons that are probed in the picture.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

// Where the photons of a run went that another process made, with the camera of the scene's file.
class ProbedPhotons : public WorkbenchTest {
  protected:
    ProbedPhotons() {
        renderSmall({"--save", "hits.position_1", "--save", "hits.flux_1", "--out", "hits"});
        const Image positions = readImage(folder / "hits" / ("hits.position_1" + extension));
        const Image fluxes = readImage(folder / "hits" / ("hits.flux_1" + extension));
        constexpr float reachedReceiver = 2.0f;
        const double tangent = std::tan(45.0 / 2.0 * std::acos(-1.0) / 180.0);
        for (int y = 0; y < positions.height; ++y) {
            for (int x = 0; x < positions.width; ++x) {
                if (fluxes.at(x, y, 3) != reachedReceiver) continue;
                const auto at = [&](int c) { return static_cast<double>(positions.at(x, y, c)); };
                const double scale = 24.0 / (tangent * -at(2));
                landings.emplace_back(32.0 + scale * at(0), 24.0 - scale * at(1));
            }
        }
    }
    [[nodiscard]] std::ptrdiff_t landedWithin(double radius, int x, int y) const {
        return std::count_if(landings.begin(), landings.end(), [&](const auto& landing) {
            return std::hypot(landing.first - x - 0.5, landing.second - y - 0.5) <= radius;
        });
    }
    [[nodiscard]] long probed(int x, int y) {
        bench->click("picture.image", kLeftButton, pixel(x, y));
        untilSettled();
        bench->waitFor("photons", [](const json& screen) {
            return screen.at("controls").contains("image.probe_landed");
        });
        return std::stol(bench->value("image.probe_landed"));
    }

    std::string extension = floatImageExtension();
    std::vector<std::pair<double, double>> landings;
};

TEST_F(ProbedPhotons, AreAsManyAsLandedNearThePixel) {
    ASSERT_GT(landings.size(), 500u);
    start();
    open("Image");
    bench->hover("picture");
    bench->key("p");
    EXPECT_EQ(bench->value("image.probe"), "on");
    for (const auto& [x, y] : {std::pair{32, 25}, std::pair{26, 30}, std::pair{37, 20}}) {
        EXPECT_EQ(probed(x, y), landedWithin(1.0, x, y)) << x << ", " << y;
    }
    EXPECT_EQ(probed(2, 2), 0) << "off the scene";
    bench->typeInto("image.probe_radius", "4", Entry::controlClick);
    const long many = probed(32, 25);
    EXPECT_EQ(many, landedWithin(4.0, 32, 25));
    EXPECT_GT(many, landedWithin(1.0, 32, 25));
    bench->keepScreenshot("image-photons");
    // Their paths are drawn over the picture.
    const Image ways = seenPicture();
    bench->key("p");
    EXPECT_GT(largestDifference(seenPicture(), ways), 0.1);
    EXPECT_FALSE(document().at("edits").contains("camera"));
}

}  // namespace
}  // namespace kaustik::test
