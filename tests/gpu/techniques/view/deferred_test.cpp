// SPDX-License-Identifier: MIT
// view.deferred against exact rays: what the eye sees through two balls, one behind the other's
// side.
#include <cmath>

#include "tests/gpu/techniques/balls_of_glass.h"
#include "tests/gpu/techniques/caustic_map_frame.h"
#include "tests/gpu/techniques/smooth_tracer.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

// Two balls before the eye, one behind the other's side.
class DeferredView : public ::testing::Test {
  protected:
    const CameraText eye{{0.0, 0.5, 5.0}, {0.0, 0.5, 0.0}, 30.0, 0.01};
    const dvec3 near{-0.1, 0.5, 1.5};
    const dvec3 far{0.25, 0.4, -0.2};
    const double nearRadius = 0.4;
    const double farRadius = 0.6;
    [[nodiscard]] scene::Scene scene() const {
        return makeScene(eye, sun({0, -1, 0}) + ballAt("far", far, farRadius) +
                                  ballAt("near", near, nearRadius) + floorBelow());
    }
    [[nodiscard]] static Frame render(const scene::Scene& balls, Settings more,
                                      const std::vector<std::string>& saved) {
        more.insert(more.begin(), {{"view", "deferred"}, {"emit.photons", "16x16"}});
        return {balls, 240, 180, more, saved, false, "caustic_map"};
    }
    struct Seen {
        double median = 0.0;  // degrees, between a ray beyond both balls and the exact one
        int exact = 0;        // pixels whose exact rays go through both
        int both = 0;         // of these, those that do
    };
    [[nodiscard]] Seen seen(const std::string& incidence) const {
        const scene::Scene balls = scene();
        const Frame frame = render(
            balls, {{"view.deferred.incidence", incidence}, {"view.deferred.distance", "search"}},
            {"view.exit_position", "view.exit_direction"});
        const Texels positions = frame.read("view.exit_position");
        const Texels directions = frame.read("view.exit_direction");
        SmoothScene smooth = smoothBall(near, nearRadius, kGlassIndex);
        const SmoothScene other = smoothBall(far, farRadius, kGlassIndex);
        smooth.insert(smooth.end(), other.begin(), other.end());
        const glm::dmat3 toWorldAxes = glm::transpose(glm::dmat3(frame.view().worldToView));
        Seen result;
        std::vector<double> degrees;
        for (int y = 0; y < positions.height; ++y) {
            for (int x = 0; x < positions.width; ++x) {
                const dvec3 along = glm::normalize(frame.worldAt(x, y, 1.0) - eye.position);
                // Beyond 0.9 radii the eye sees the ball's sides nearly edge-on.
                if (glm::length(glm::cross(near - eye.position, along)) > 0.9 * nearRadius)
                    continue;
                const std::vector<SmoothHit> own =
                    followPath(smooth, {eye.position, along}, {false, false, false, false});
                if (own.size() != 4) continue;
                ++result.exact;
                if (positions.at(x, y, 3) != 4.0f || directions.at(x, y, 3) != kPathExited)
                    continue;
                ++result.both;
                degrees.push_back(
                    degreesBetween(toWorldAxes * directions.rgb(x, y), own[3].next.direction));
            }
        }
        result.median = medianOf(degrees);
        return result;
    }
};

TEST_F(DeferredView, LooksThroughBothBallsAsExactRaysDo) {
    const Seen byRay = seen("ray");
    const Seen byEye = seen("eye");
    const std::string said = fmt::format(
        "median angle error beyond interface 4: {:.4f}° by the ray's direction, "
        "{:.4f}° by the eye's; {} of {} pixels see through both balls",
        byRay.median, byEye.median, byRay.both, byRay.exact);
    RecordProperty("angles", said);
    ASSERT_GT(byRay.exact, 500) << said;
    EXPECT_GT(byRay.both, 0.95 * byRay.exact) << said;
    // Pixels are a twentieth of a radius: what of a ball is between them is interpolated.
    EXPECT_LT(byRay.median, 1.0) << said;
    EXPECT_GT(byEye.median, 10.0 * byRay.median) << said;
}

// In perspective a rasteriser may round the division by depth otherwise behind a geometry shader,
// and of triangles smaller than pixels keep another one.
TEST_F(DeferredView, DrawsBuffersOnceAsTwiceUpToRounding) {
    const scene::Scene balls = scene();
    const auto depths = [&](const char* geometry, int layer) {
        return render(balls, {{"view.deferred.geometry", geometry}}, {"view.body_depth"})
            .read("view.body_depth", layer);
    };
    for (int layer = 0; layer < 4; ++layer) {
        const Texels once = depths("once", layer);
        const Texels twice = depths("twice", layer);
        int drawn = 0;
        int different = 0;
        for (int y = 0; y < once.height; ++y) {
            for (int x = 0; x < once.width; ++x) {
                ASSERT_EQ(once.at(x, y, 0) > 0.0f, twice.at(x, y, 0) > 0.0f);
                const double error = std::abs(once.at(x, y, 0) - twice.at(x, y, 0));
                // Edges of the balls are 4 mm.
                ASSERT_LT(error, 1e-3);
                drawn += once.at(x, y, 0) > 0.0f ? 1 : 0;
                different += error > 1e-5 ? 1 : 0;  // metres, of about 4
            }
        }
        EXPECT_GT(drawn, 3000);
        EXPECT_LT(different, 0.01 * drawn);
    }
}

}  // namespace
}  // namespace kaustik::test
