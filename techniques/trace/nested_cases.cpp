// SPDX-License-Identifier: MIT
// D38: dielectrics nested three and four deep, for photons by every tracer and for the eye's rays
// by those that follow them: concentric balls of 1.5, 1.2, 1.8 and 1.33. A ray keeps its impact
// parameter, the distance of its line from the middle times the index, so that the whole path is
// known in closed form. And what lies deeper than a stack holds is a limit that is said.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/lab.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/scene/dielectrics.h"
#include "techniques/register_hard_cases.h"

namespace kaustik {
namespace {

using namespace numerics;
using namespace transport;

struct Shell {
    double radius;
    double index;
};
const std::vector<Shell> kShells = {{0.5, 1.5}, {0.4, 1.2}, {0.3, 1.8}, {0.2, 1.33}};
const glm::dvec3 kMiddle(0.0, 0.8, 0.0);
// What a pixel of 320 x 240 covers at the balls, 3.2 m away, m.
constexpr double kFootprint = 0.011;
constexpr double kDegree = 0.017453292519943295;

// What a ray with an impact parameter (m) does: by how much it is turned towards the middle, and
// how many interfaces it hits.
struct Path {
    double turnRadians = 0.0;
    int interfaces = 0;
};
Path pathThrough(int shells, double impact) {
    Path path;
    double index = 1.0;
    for (int i = 0; i < shells; ++i) {
        const Shell& shell = kShells[static_cast<std::size_t>(i)];
        const double before = impact / (index * shell.radius);
        if (before >= 1.0) break;  // passes it by
        const double behind = impact / (shell.index * shell.radius);
        if (behind >= 1.0) {
            path.turnRadians -= 3.14159265358979323846 - 2.0 * std::asin(before);
            path.interfaces += 1;
            break;
        }
        path.turnRadians += 2.0 * (std::asin(before) - std::asin(behind));
        path.interfaces += 2;
        index = shell.index;
    }
    return path;
}

// By how much the paths of rays half a pixel to both sides differ: no more is known of one. Nothing
// where they hit other interfaces.
std::optional<double> differenceOverAPixel(int shells, double impact) {
    const Path low = pathThrough(shells, std::max(impact - 0.5 * kFootprint, 0.0));
    const Path high = pathThrough(shells, impact + 0.5 * kFootprint);
    if (low.interfaces != high.interfaces) return std::nullopt;
    return std::abs(high.turnRadians - low.turnRadians);
}

// Materials for the shells; `more` are never used.
std::string glasses(int more) {
    std::string text;
    for (std::size_t i = 0; i < kShells.size() + static_cast<std::size_t>(more); ++i) {
        text += fmt::format("[[material]]\nname = \"shell {}\"\ntype = \"dielectric\"\nior = {}\n",
                            i, number(kShells[i % kShells.size()].index));
    }
    return text;
}

scene::Scene nestedBalls(int shells, int moreMaterials = 0) {
    CameraText camera;
    camera.position = {0.0, 2.0, 3.0};
    camera.target = {0.0, 0.5, 0.0};
    camera.fovDegrees = 45.0;
    std::string text =
        sun({0.3, -1.0, -0.2}) + glasses(moreMaterials) + floorPlane("floor", "grey", 6, {0, 0, 0});
    for (int i = 0; i < shells; ++i) {
        text += object(fmt::format("ball {}", i), "sphere", fmt::format("shell {}", i), kMiddle,
                       fmt::format("radius = {}\nsegments = 192",
                                   number(kShells[static_cast<std::size_t>(i)].radius)));
    }
    return makeScene(camera, text);
}

// Photons: how far their path out is turned from the light's direction.
void photonsThrough(Lab& lab, int shells) {
    const scene::Scene scene = nestedBalls(shells);
    const glm::dvec3 light = scene.lights[0].direction;
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        FrameRequest request{320,
                             240,
                             {{"emit.photons", "64x64"},
                              {"layers.count", "12"},
                              {"specular", "interface"},
                              {"specular.bounces", "12"}}};
        request.recordsTraces = true;
        if (lab.seesReceiversOnly(tracer)) {
            lab.expectRefused(
                tracer.subject,
                fmt::format("light inside of {} balls, whose far sides it does not see", shells),
                [&] { (void)lab.render(tracer, scene, request); });
            continue;
        }
        const Frame frame = lab.render(tracer, scene, request);
        const std::vector<TraceRecord>& traces = frame.renderer().traces();
        const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
        int tested = 0;
        int right = 0;
        for (std::size_t trace = 0; trace < traces.size(); ++trace) {
            const Hits& found = traces[trace].hits;
            const std::vector<PhotonTexel> photons = readPhotons(frame.renderer(), found.incoming);
            const std::vector<HitTexel> hits = readHits(frame.renderer(), found);
            for (std::size_t i = 0; i < photons.size(); ++i) {
                if (photons[i].fate != kFateInFlight) continue;
                const bool isOut = hits[i].fate != kFateSpecular;
                if (!isOut && trace + 1 < traces.size()) continue;  // in the next list
                const glm::dvec3 out = back * glm::dvec3(photons[i].direction);
                const glm::dvec3 from = frame.toWorld(photons[i].position) - kMiddle;
                const double impact = glm::length(glm::cross(from, out));
                const Path exact = pathThrough(shells, impact);
                const std::optional<double> allowed = differenceOverAPixel(shells, impact);
                if (!allowed) continue;
                ++tested;
                const double turned =
                    std::atan2(glm::length(glm::cross(light, out)), glm::dot(light, out));
                const double error = std::abs(turned - std::abs(exact.turnRadians));
                right += isOut && error < kDegree + *allowed ? 1 : 0;
            }
        }
        lab.expect(
            tracer.subject,
            fmt::format("share of photons within a degree of the exact path through {} balls",
                        shells),
            1.0, static_cast<double>(right) / std::max(tested, 1),
            {0.02,
             "at silhouettes of balls of 25 to 60 pixels a pixel holds one of several "
             "triangles: 2 in a hundred"});
        lab.expectAtLeast(tracer.subject,
                          fmt::format("photons through {} balls that are compared", shells), 1000,
                          tested, kTooFewReason);
    }
}

// The eye's rays: exit directions and interfaces.
void raysThrough(Lab& lab, const Lab::Choice& node, int shells) {
    const scene::Scene scene = nestedBalls(shells);
    const Frame frame = lab.render(node, scene, {320, 240, {{"emit.photons", "8x8"}}});
    const View& seen = frame.renderer().outputs().picture.view;
    const Texels position = frame.read(seen.exitPosition);
    const Texels direction = frame.read(seen.exitDirection);
    const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
    const glm::dvec3 eye = frame.toWorld(glm::dvec3(0.0));
    int tested = 0;
    int counted = 0;
    int right = 0;
    for (int y = 0; y < position.height; ++y) {
        for (int x = 0; x < position.width; ++x) {
            const glm::dvec3 ray = glm::normalize(frame.worldAt(x, y, 1.0) - eye);
            const glm::dvec3 along = kMiddle - eye;
            const glm::dvec3 across = along - glm::dot(along, ray) * ray;
            const double impact = glm::length(across);
            const Path exact = pathThrough(shells, impact);
            const std::optional<double> allowed = differenceOverAPixel(shells, impact);
            if (exact.interfaces == 0 || !allowed) continue;
            ++tested;
            const bool isCounted = static_cast<int>(position.at(x, y, 3)) == exact.interfaces;
            counted += isCounted ? 1 : 0;
            const glm::dvec3 expected = std::cos(exact.turnRadians) * ray +
                                        std::sin(exact.turnRadians) * glm::normalize(across);
            const bool isNear =
                glm::length(back * direction.rgb(x, y) - expected) < kDegree + *allowed;
            right += isNear && direction.at(x, y, 3) == kPathExited ? 1 : 0;
        }
    }
    const Tolerance silhouettes{0.05,
                                "beside silhouettes, where a ray turns back between two pixels "
                                "and one of them holds no layer of what it hits"};
    const auto share = [&](int part) { return static_cast<double>(part) / std::max(tested, 1); };
    lab.expect(node.subject,
               fmt::format("share of rays with as many interfaces in {} balls", shells), 1.0,
               share(counted), silhouettes);
    lab.expect(
        node.subject,
        fmt::format("share of rays within a degree of the exact path through {} balls", shells),
        1.0, share(right), silhouettes);
    lab.expectAtLeast(node.subject, fmt::format("rays through {} balls that are compared", shells),
                      5000, tested, kTooFewReason);
}

void raysOfEachView(Lab& lab, int shells) {
    Lab::Choice refraction = lab.choose(ViewStage::name, "refraction");
    refraction.settings.emplace_back("view.refraction.interfaces", "8");
    refraction.settings.emplace_back("view.refraction.layers", "12");
    raysThrough(lab, refraction, shells);
    raysThrough(lab, lab.choose(ViewStage::name, "bvh"), shells);
}

// Fifty materials more leave room for a stack of three: what enters the fourth ball is counted.
void deeperThanTheStack(Lab& lab) {
    const scene::Scene scene = nestedBalls(4, 50);
    lab.expect("scene/dielectrics.h", "depth of the stack for 56 dielectrics", 3.0,
               numberDielectrics(scene).depth, kExactly);
    const Lab::Choice node = lab.choose(ViewStage::name, "refraction");
    const Frame frame = lab.render(node, scene,
                                   {160,
                                    120,
                                    {{"emit.photons", "64x64"},
                                     {"layers.count", "12"},
                                     {"specular", "interface"},
                                     {"view.refraction.interfaces", "8"},
                                     {"view.refraction.layers", "12"}}});
    const EnergyLedger ledger = frame.renderer().ledger();
    lab.expectAtLeast("include/photons/interaction.glsl",
                      "share of the flux that goes deeper than the stack", 0.1,
                      ledger.watts[kAccountNestingLimit] / ledger.watts[kAccountEmitted],
                      "the fourth ball's cross-section is a sixth of the first one's");
    lab.expect("include/photons/interaction.glsl", "balance of the ledger", 0.0, ledger.balance(),
               {1e-5, "sums of 32-bit fluxes and areas in fixed point"});
    const std::vector<ReachedLimit> limits = frame.renderer().reachedLimits();
    const auto found = std::find_if(limits.begin(), limits.end(), [](const ReachedLimit& limit) {
        return limit.parameter == "view.refraction.nesting";
    });
    lab.expect(node.subject, "limit that is said of the eye's rays, dielectrics", 3.0,
               found != limits.end() ? found->value : std::numeric_limits<double>::quiet_NaN(),
               kExactly);
}

}  // namespace

void addNestedCases(Suite& suite) {
    suite.add("D38",
              "Photons and the eye's rays go through dielectrics nested four deep; what is deeper "
              "than the stack is said.",
              deeperThanTheStack);
    for (const int shells : {3, 4}) {
        suite.add("D38", "", [shells](Lab& lab) { photonsThrough(lab, shells); });
        suite.add("D38", "", [shells](Lab& lab) { raysOfEachView(lab, shells); });
    }
}

}  // namespace kaustik
