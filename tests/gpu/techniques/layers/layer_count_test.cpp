// SPDX-License-Identifier: MIT
// layers.count (K06, section 2.2), of every node that makes layers: a surface is found exactly
// where as many layers are kept as surfaces lie in front of it, by pixel, and itself; what is
// missed for want of layers is in one account, and the report says what lies beyond.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "framework/transport/watts.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

constexpr int kSteps = 5;
constexpr double kWallDepth = 10.0;
// Half of the picture's width at a depth of 1 m: 60 degrees, 128 x 128 pixels.
constexpr double kHalfWidth = 0.57735026918962576;

// Sheets behind one another, of which each begins, as the eye sees it, a sixth of the picture right
// of the one before, and a wall behind them: the wall is layer 1 on the left and 6 on the right.
double beginOf(int sheet) {
    return kHalfWidth * (-1.0 + 2.0 * (sheet + 1) / 6.0);
}
// `cells`: along each side of the wall. Of many the triangles outnumber the pixels.
scene::Scene staircase(int cells) {
    std::string parts = object(
        "wall", "plane", "grey", {0, 0, -kWallDepth},
        fmt::format("size = [40, 40]\ncells = [{0}, {0}]\nrotation_degrees = [90, 0, 0]", cells));
    for (int i = 0; i < kSteps; ++i) {
        const double depth = 3.0 + 0.5 * i;
        parts +=
            facingPlane(std::to_string(i), "white", 20, {beginOf(i) * depth + 10.0, 0, -depth});
    }
    // Water behind the camera gives the scene a need for layers.
    return makeScene({},
                     sun({0.0, -1.0, 0.0}) + floorPlane("water", "water", 1, {0, 0, 9}) + parts);
}

struct Wanted {
    StagePhoton photon;
    int layer = 1;  // that the wall is where the photon hits it
};
// They start behind all sheets and hit the wall at least a pixel from where a sheet begins.
std::vector<Wanted> photonsAtTheWall() {
    std::vector<Wanted> all;
    for (int i = 0; i < 256; ++i) {
        const double tangent = kHalfWidth * (-0.98 + 1.96 * (i + 0.37) / 256.0);
        Wanted wanted;
        bool isNearEdge = false;
        for (int sheet = 0; sheet < kSteps; ++sheet) {
            wanted.layer += tangent > beginOf(sheet) ? 1 : 0;
            isNearEdge = isNearEdge || std::abs(tangent - beginOf(sheet)) < kHalfWidth / 64.0;
        }
        if (isNearEdge) continue;
        const dvec3 hit(tangent * kWallDepth, 0.013 * (i % 37), -kWallDepth);
        wanted.photon.direction = glm::normalize(dvec3(0.04 - 0.002 * (i % 41), 0.03, -1.0));
        wanted.photon.position = hit + wanted.photon.direction * (3.0 / wanted.photon.direction.z);
        all.push_back(wanted);
    }
    return all;
}

struct Node {
    std::string name;
    int cells = 1;
    friend void PrintTo(const Node& node, std::ostream* out) { *out << node.name << node.cells; }
};

class LayerCount : public testing::TestWithParam<Node> {
  protected:
    Traced trace(const scene::Scene& scene, const std::vector<StagePhoton>& photons, int count,
                 const char* tracer) {
        return tracePhotons(lab_, lab_.choose(TraceStage::name, tracer), scene, photons,
                            {{"layers", GetParam().name}, {"layers.count", std::to_string(count)}});
    }

  private:
    Registry registry_ = registerAll();
    Suite suite_;
    Lab lab_{context(), registry_, suite_};
};

TEST_P(LayerCount, FindsASurfaceExactlyWhereThatManyAreKept) {
    const scene::Scene scene = staircase(GetParam().cells);
    const std::vector<Wanted> wanted = photonsAtTheWall();
    std::vector<StagePhoton> photons;
    std::array<int, kSteps + 2> photonsOfLayer{};
    for (const Wanted& one : wanted) {
        photons.push_back(one.photon);
        ++photonsOfLayer[static_cast<std::size_t>(one.layer)];
    }
    for (int layer = 1; layer <= kSteps + 1; ++layer)
        EXPECT_GT(photonsOfLayer[static_cast<std::size_t>(layer)], 30) << layer;
    for (const char* tracer : {"lines", "hierarchical"}) {
        for (int count = 1; count <= kSteps + 2; ++count) {
            SCOPED_TRACE(fmt::format("{}, {} layers", tracer, count));
            const Traced traced = trace(scene, photons, count, tracer);
            double beyond = 0.0;
            std::uint64_t missed = 0;
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                const bool isKept = wanted[i].layer <= count;
                ASSERT_EQ(traced.hits[i].isHit(), isKept) << "of layer " << wanted[i].layer;
                if (!isKept) {
                    beyond += wattsOf(photons[i].fluxWatts);
                    ++missed;
                    continue;
                }
                EXPECT_EQ(traced.hits[i].material, kGrey);
                // The tangent plane of a 32-bit depth of 10 m, along rays that close in almost
                // straight: a few units of the last place.
                EXPECT_NEAR(traced.hits[i].distanceMeters, -3.0 / photons[i].direction.z, 1e-5);
            }
            // The ray goes on behind what the layers show to the end of the scene: the tracer does
            // not know whether something was there. Flux of a photon is 32 bits.
            EXPECT_EQ(traced.ledger.events[kAccountUnresolved], missed);
            EXPECT_NEAR(traced.ledger.watts[kAccountUnresolved], beyond, 1e-5 * beyond);
        }
    }
}

void expectPass(const Frame& frame, const std::string& name) {
    const std::vector<graph::PassRecord>& records = frame.renderer().compiled().records;
    EXPECT_TRUE(std::any_of(records.begin(), records.end(), [&](const graph::PassRecord& pass) {
        return pass.name == name && pass.state == graph::PassState::ran;
    })) << name;
}

TEST_P(LayerCount, IsSaidToBeTooSmallByWhatLiesBeyond) {
    const scene::Scene scene = staircase(GetParam().cells);
    constexpr int kSide = 48;
    // A sixth of the picture between two sheets' begins.
    constexpr std::uint64_t kPart = kSide / 6 * kSide;
    // The begins lie between two columns, and may be rounded to either side.
    constexpr double kColumns = kSteps * kSide;
    for (const int count : {1, 4, kSteps + 1}) {
        SCOPED_TRACE(count);
        // Up to three layers are peeled, whatever there is to draw.
        const bool lists = GetParam().cells > 1 && count > 3;
        const Frame frame(scene, kSide, kSide,
                          {{"layers", GetParam().name},
                           {"layers.count", std::to_string(count)},
                           {"emit.photons", "8x8"}});
        if (GetParam().name == "auto") expectPass(frame, lists ? "layers.lists" : "layers.peel");
        std::uint64_t fragments = 0;
        std::uint64_t skipped = 0;
        std::uint64_t pixels = 0;
        for (int layers = 1; layers <= kSteps + 1; ++layers) {
            const auto beyond = static_cast<std::uint64_t>(std::max(layers - count, 0));
            fragments += static_cast<std::uint64_t>(layers) * kPart;
            skipped += beyond * kPart;
            pixels += beyond > 0 ? kPart : 0;
        }
        const LayerStatistics found = frame.renderer().layerStatistics();
        EXPECT_EQ(found.complexity, static_cast<unsigned>(kSteps + 1));
        EXPECT_NEAR(static_cast<double>(found.fragments), static_cast<double>(fragments), kColumns);
        EXPECT_NEAR(static_cast<double>(found.skipped), static_cast<double>(skipped), kColumns);
        EXPECT_NEAR(static_cast<double>(found.pixelsSkipped), static_cast<double>(pixels),
                    kColumns);
        EXPECT_EQ(found.skipped > 0, count <= kSteps);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, LayerCount,
                         testing::Values(Node{"auto"}, Node{"auto", 130}, Node{"peel"},
                                         Node{"lists"}, Node{"per_object"}),
                         [](const testing::TestParamInfo<Node>& tested) {
                             return tested.param.name +
                                    (tested.param.cells > 1 ? "_of_many_triangles" : "");
                         });

}  // namespace
}  // namespace kaustik::test
