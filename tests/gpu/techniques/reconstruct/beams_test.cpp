// SPDX-License-Identifier: MIT
// The beams of photons, after every interaction, against central differences of light that a tracer
// of its own follows through the same shapes in closed form and in double precision
// (tests/gpu/techniques/smooth_tracer.h): a cell's width in the light's grid to either side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/scene.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/smooth_tracer.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using glm::dvec2;
using glm::dvec3;

// As shaders/include/photons/beam.glsl says (Duff et al. 2017).
glm::dmat2x3 basisAcross(const dvec3& unit) {
    const double side = unit.z < 0.0 ? -1.0 : 1.0;
    const double a = -1.0 / (side + unit.z);
    const double b = unit.x * unit.y * a;
    return {{1.0 + side * unit.x * unit.x * a, side * b, -side * unit.x},
            {b, side + unit.y * unit.y * a, -unit.y}};
}

template <class Matrix>
double frobenius(const Matrix& m) {
    return std::hypot(glm::length(m[0]), glm::length(m[1]));
}

// A photon and what it has hit, eye view space.
struct Followed {
    std::uint32_t cell = 0;
    std::vector<bool> reflected;  // at its interactions, the first one first
    dvec3 direction{0.0};
    glm::dmat2 place{0.0};
    glm::dmat2 turn{0.0};
    bool arrives = false;  // somewhere
    dvec3 hit{0.0};
    dvec3 hitNormal{0.0};
    double distance = 0.0;
};

std::vector<std::string> texturesOf(int interactions) {
    std::vector<std::string> names;
    for (int i = 0; i <= interactions; ++i) {
        const std::string suffix = i == 0 ? "" : fmt::format("_{}", i);
        for (const char* name :
             {"photons.position", "photons.direction", "photons.origin", "photons.list",
              "photons.place", "photons.turn", "hits.position", "hits.surface", "hits.flux"})
            names.push_back(name + suffix);
    }
    return names;
}

// Those of the list after so many interactions.
std::vector<Followed> followedIn(const Frame& frame, int interactions) {
    const std::string suffix = interactions == 0 ? "" : fmt::format("_{}", interactions);
    const auto texels = [&](const char* name) { return frame.read(name + suffix).values; };
    const std::vector<float> direction = texels("photons.direction");
    const std::vector<float> origin = texels("photons.origin");
    const std::vector<float> place = texels("photons.place");
    const std::vector<float> turn = texels("photons.turn");
    const std::vector<float> hit = texels("hits.position");
    const std::vector<float> surface = texels("hits.surface");
    const std::vector<float> flux = texels("hits.flux");
    const graph::Graph& graph = frame.renderer().graph();
    const auto count = frame.renderer()
                           .buffer(graph.find("photons.list" + suffix))
                           .read<transport::PhotonList>()
                           .front()
                           .count;
    std::vector<Followed> photons;
    for (std::size_t i = 0; i < 4 * std::size_t{count}; i += 4) {
        const auto fate = static_cast<std::uint32_t>(direction[i + 3]);
        if (fate != transport::kFateInFlight && fate != transport::kFateSpecular) continue;
        Followed photon;
        photon.cell = static_cast<std::uint32_t>(origin[i]);
        const auto path = static_cast<std::uint32_t>(origin[i + 2]);
        for (int k = interactions - 1; k >= 0; --k)
            photon.reflected.push_back(((path >> k) & 1u) == 1u);
        photon.direction = {direction[i], direction[i + 1], direction[i + 2]};
        photon.place = {{place[i], place[i + 1]}, {place[i + 2], place[i + 3]}};
        photon.turn = {{turn[i], turn[i + 1]}, {turn[i + 2], turn[i + 3]}};
        const auto hitFate = static_cast<std::uint32_t>(flux[i + 3]);
        photon.arrives = hitFate == transport::kFateReceiver || hitFate == transport::kFateSpecular;
        photon.hit = {hit[i], hit[i + 1], hit[i + 2]};
        photon.distance = double{hit[i + 3]};
        photon.hitNormal = {surface[i], surface[i + 1], surface[i + 2]};
        photons.push_back(photon);
    }
    return photons;
}

// The rays that a light sends through its grid, by the cell's coordinates.
class LightGrid {
  public:
    LightGrid(const scene::Scene& scene, int side) : light_(scene.lights.front()), side_(side) {
        scene::Bounds specular;
        scene::Bounds all;
        for (const scene::Object& object : scene.objects) {
            const scene::Bounds bounds = objectBounds(scene, object);
            for (scene::Bounds* into : {&all, &specular}) {
                if (into == &specular && isReceiver(scene.materials[object.material].kind))
                    continue;
                into->include(bounds.minimum);
                into->include(bounds.maximum);
            }
        }
        view_ = render::makeLightView(light_, specular, all);
        toWorld_ = glm::inverse(view_.worldToView);
    }
    // (0, 0): the middle of the grid's first cell.
    [[nodiscard]] Ray rayOf(const dvec2& cell) const {
        const dvec2 onPlane = (2.0 * (cell + 0.5) / double(side_) - 1.0) * view_.halfExtent;
        if (view_.isOrthographic) {
            const dvec3 along(toWorld_ * glm::dvec4(0.0, 0.0, -1.0, 0.0));
            return {dvec3(toWorld_ * glm::dvec4(onPlane, 10.0, 1.0)), glm::normalize(along)};
        }
        const dvec3 along(toWorld_ * glm::dvec4(onPlane, -1.0, 0.0));
        return {light_.position, glm::normalize(along)};
    }

  private:
    scene::Light light_;
    int side_;
    render::RasterView view_;
    glm::dmat4 toWorld_{1.0};
};

// The relative errors of photons after so many interactions.
struct Errors {
    std::vector<double> place;    // of how far neighbours are next to a photon
    std::vector<double> beam;     // the same with the turn of the direction, by the way to the hit
    std::vector<double> arrival;  // of where neighbours hit the surface that the photon hits next
    int judged = 0;               // photons that go on and do not graze
    int elsewhere = 0;            // that have not gone where the shapes say
};

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 1e30;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Largest relative errors of half of the photons, of 95 % and of all.
struct Bounds {
    double half = 0.0;
    double maximum = 0.0;
    double all = 1e30;
};

struct Case {
    std::string name;
    std::string parts;  // of the scene
    SmoothScene smooth;
    int interactions = 2;
    // By the tracer that knows the surface from the layers of pixels alone.
    Bounds inLayers{};
    int photons = 48;  // along a side of the grid
    Settings settings{};
};

constexpr double kStep = 1e-3;    // of a cell
constexpr double kGrazing = 0.2;  // cosine, at every surface

void compare(const Case& what, const Frame& frame, const LightGrid& grid, int interactions,
             Errors& errors) {
    const glm::dmat3 toView(frame.view().worldToView);
    for (const Followed& photon : followedIn(frame, interactions)) {
        const dvec2 cell(photon.cell % static_cast<unsigned>(what.photons),
                         photon.cell / static_cast<unsigned>(what.photons));
        const auto follow = [&](const dvec2& at) {
            return followPath(what.smooth, grid.rayOf(at), photon.reflected);
        };
        const std::vector<SmoothHit> own = follow(cell);
        const auto last = static_cast<std::size_t>(interactions);
        const bool isGrazing = std::any_of(
            own.begin(), own.end(), [](const SmoothHit& hit) { return hit.cosine < kGrazing; });
        const bool isSomewhere = own.size() > last;
        if (isGrazing || (!isSomewhere && !photon.arrives)) continue;
        ++errors.judged;
        if (!isSomewhere || !photon.arrives ||
            glm::length(frame.toWorld(photon.hit) - own[last].position) > 0.02) {
            ++errors.elsewhere;
            continue;
        }
        const auto direction = [&](const std::vector<SmoothHit>& path, const Ray& emitted) {
            return last == 0 ? emitted.direction : path[last - 1].next.direction;
        };
        // Columns: along u and along v.
        glm::dmat2x3 moved(0.0);
        glm::dmat2x3 turned(0.0);
        glm::dmat2x3 arrived(0.0);
        bool isSmooth = true;
        for (int axis = 0; axis < 2; ++axis) {
            dvec2 step(0.0);
            step[axis] = kStep;
            const std::vector<SmoothHit> less = follow(cell - step);
            const std::vector<SmoothHit> more = follow(cell + step);
            if (less.size() != own.size() || more.size() != own.size()) {
                isSmooth = false;
                break;
            }
            for (std::size_t i = 0; i < own.size(); ++i) {
                if (less[i].surface != own[i].surface || more[i].surface != own[i].surface)
                    isSmooth = false;
            }
            const double scale = 0.5 / kStep;
            arrived[axis] = scale * (more[last].position - less[last].position);
            turned[axis] = scale * (direction(more, grid.rayOf(cell + step)) -
                                    direction(less, grid.rayOf(cell - step)));
            // Before the first interaction: where the light first hits, and so next to the photon.
            const std::size_t from = last == 0 ? 0 : last - 1;
            moved[axis] = scale * (more[from].position - less[from].position);
        }
        if (!isSmooth) continue;
        const glm::dmat2x3 across = basisAcross(photon.direction);
        const glm::dmat2 place = glm::transpose(across) * (toView * moved);
        const glm::dmat2 turn = glm::transpose(across) * (toView * turned);
        // Where the neighbours' rays hit the plane that the photon has hit.
        const glm::dmat2x3 offsets =
            across * (photon.place + (last == 0 ? 0.0 : photon.distance) * photon.turn);
        const glm::dmat2x3 neighbour =
            offsets - glm::outerProduct(photon.direction, photon.hitNormal * offsets) /
                          glm::dot(photon.direction, photon.hitNormal);
        const double way = glm::length(own[last].position - own[last == 0 ? 0 : last - 1].position);
        errors.place.push_back(frobenius(photon.place - place) / frobenius(place));
        errors.beam.push_back(
            std::hypot(frobenius(photon.place - place), way * frobenius(photon.turn - turn)) /
            std::hypot(frobenius(place), way * frobenius(turn)));
        const glm::dmat2x3 exact = toView * arrived;
        errors.arrival.push_back(frobenius(neighbour - exact) / frobenius(exact));
    }
}

// By the number of interactions.
std::vector<Errors> errorsOf(const Case& what, const std::string& tracer, int width, int height) {
    const scene::Scene scene =
        makeScene({{0.0, 2.5, 3.5}, {0.0, 0.2, 0.0}, 60.0, 0.01}, what.parts);
    Settings settings = {{"emit.photons", fmt::format("{0}x{0}", what.photons)},
                         {"specular", "interface"},
                         {"specular.bounces", std::to_string(what.interactions)},
                         {"reconstruct", "triangles"},
                         {"trace", tracer}};
    settings.insert(settings.end(), what.settings.begin(), what.settings.end());
    const Frame frame(scene, width, height, settings, texturesOf(what.interactions));
    const LightGrid grid(scene, what.photons);
    std::vector<Errors> all(static_cast<std::size_t>(what.interactions) + 1);
    for (int i = 0; i <= what.interactions; ++i)
        compare(what, frame, grid, i, all[static_cast<std::size_t>(i)]);
    return all;
}

void expectWithin(const std::vector<Errors>& all, const Bounds& bounds, double minFound) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Errors& errors = all[i];
        EXPECT_LE(errors.elsewhere, (1.0 - minFound) * errors.judged) << i;
        EXPECT_GE(errors.place.size(), 15u) << i;
        const std::pair<const char*, const std::vector<double>*> kinds[] = {
            {"place", &errors.place}, {"beam", &errors.beam}, {"arrival", &errors.arrival}};
        for (const auto& [name, values] : kinds) {
            const std::string text =
                fmt::format("{} photons: half {:.1e}, 95 % {:.1e}, 99 % {:.1e}, all {:.1e}",
                            values->size(), quantile(*values, 0.5), quantile(*values, 0.95),
                            quantile(*values, 0.99), quantile(*values, 1.0));
            ::testing::Test::RecordProperty(fmt::format("{}_{}", name, i), text);
            EXPECT_LE(quantile(*values, 0.5), bounds.half) << name << " " << i << ": " << text;
            EXPECT_LE(quantile(*values, 0.95), bounds.maximum) << name << " " << i << ": " << text;
            EXPECT_LE(quantile(*values, 1.0), bounds.all) << name << " " << i << ": " << text;
        }
    }
}

const std::string kFloor = floorPlane("floor", "grey", 12.0, {0, -1, 0});
const std::string kLamp =
    "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.4, 2.2, 0.5]\nintensity = 60\n";

SmoothScene with(SmoothScene scene, const SmoothScene& more) {
    scene.insert(scene.end(), more.begin(), more.end());
    return scene;
}

const std::string kSun = sun({0.3, -1.0, 0.2});
const std::string kLowSun = sun({0.9, -0.7, 0.3});

Case ball(const std::string& name, const std::string& light) {
    return {name,
            light + kFloor +
                object("ball", "sphere", "glass", {0.1, 0.3, 0}, "radius = 0.5\nsegments = 640"),
            with(smoothFloor(-1.0), smoothBall({0.1, 0.3, 0}, 0.5, kGlassIndex)), 2,
            Bounds{1e-3, 4e-3}};
}
// Both branches, so that light is reflected within the ball as well.
Case ballWithin() {
    Case what = ball("BallWithReflections", kSun);
    what.interactions = 3;
    what.settings = {{"specular", "split"}, {"specular.split.levels", "5"}};
    what.photons = 36;
    what.inLayers = {2e-3, 0.1};
    return what;
}
Case lens(const std::string& name, const std::string& light) {
    return {name,
            light + kFloor +
                object("lens", "lens", "glass", {0, 0.2, 0},
                       "top_radius = 0.8\nbottom_radius = 1.1\ndiameter = 1\n"
                       "center_thickness = 0.35\nsegments = 640"),
            with(smoothFloor(-1.0), smoothLens({{0, 0.2, 0}, 0.8, 1.1, 1.0, 0.35}, kGlassIndex)), 2,
            Bounds{1e-3, 4e-3}};
}
// Normals between vertices go straight, so that they turn by what a wave does half a cell beside.
Case waves(const std::string& name, const std::string& light, const Settings& settings = {}) {
    return {name,
            light + kFloor +
                object("water", "water", "water", {0, 0, 0},
                       "size = [0.8, 0.8]\ncells = [896, 896]\nwaves = ["
                       "{amplitude = 0.02, wavelength = 0.9, direction_degrees = 20, omega = 0},"
                       "{amplitude = 0.01, wavelength = 0.6, direction_degrees = 110, omega = 0}]"),
            with(smoothFloor(-1.0),
                 smoothWaves({{0.02, 0.9, 20.0}, {0.01, 0.6, 110.0}}, 0.8, kWaterIndex)),
            1,
            Bounds{1e-3, 4e-3},
            48,
            settings};
}
Case cylinder() {
    return {"Cylinder",
            kLowSun + kFloor +
                object("cylinder", "cylinder", "glass", {0, 0.2, 0},
                       "radius = 0.4\nheight = 1\nsegments = 2048"),
            with(smoothFloor(-1.0), smoothCylinder({0, 0.2, 0}, 0.4, 1.0, kGlassIndex)), 2,
            Bounds{1e-3, 2e-2}};
}
// Light goes down within it from wall to wall.
Case ring() {
    return {"Ring",
            kLowSun + kFloor +
                object("ring", "ring", "mirror", {0, 0, 0},
                       "inner_radius = 0.5\nouter_radius = 0.55\nheight = 1.4\nsegments = 2048"),
            with(smoothFloor(-1.0), smoothRing({0, 0, 0}, 0.5, 0.55, 1.4)), 4, Bounds{1e-2, 0.2}};
}

class Beams : public ::testing::TestWithParam<Case> {};

// Within 1e-3, but for photons that come near a focus, where what they are judged by goes to
// nothing.
TEST_P(Beams, AreWhatNeighboursDoAfterEveryInteraction) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    expectWithin(errorsOf(GetParam(), "raytraced", 120, 90), {5e-4, 1e-3, 5e-3}, 0.97);
}

// What curves is known from the pixels around, four by four. Some see the edges of a shape there,
// and after several interactions errors have multiplied.
TEST_P(Beams, AreNearToThatInLayersOfPixels) {
    expectWithin(errorsOf(GetParam(), "hierarchical", 640, 480), GetParam().inLayers, 0.88);
}

INSTANTIATE_TEST_SUITE_P(On, Beams,
                         ::testing::Values(ball("Ball", kSun), ball("BallUnderALamp", kLamp),
                                           ballWithin(), lens("Lens", kSun),
                                           lens("LensUnderALamp", kLamp), waves("Waves", kSun),
                                           waves("WavesUnderALamp", kLamp), cylinder(), ring()),
                         [](const ::testing::TestParamInfo<Case>& tested) {
                             return tested.param.name;
                         });

}  // namespace
}  // namespace kaustik::test
