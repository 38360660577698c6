// SPDX-License-Identifier: MIT
// What is said to have no effect has none: whatever it is set to, pictures and ledger stay the same
// to the bit. And what is said of whom.
#include <fmt/format.h>

#include <set>

#include "framework/core/error.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/pipeline/effect.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using numerics::floorPlane;
using numerics::makeScene;
using numerics::object;

const numerics::CameraText kCamera{{0.0, 2.0, 3.0}, {0.0, 0.0, 0.0}};
const std::string kSunAndFloor =
    numerics::sun({0.2, -1.0, -0.1}) + floorPlane("floor", "grey", 4.0, {0, 0, 0});
const std::string kWater =
    object("pond", "water", "water", {0, 0.5, 0},
           "size = [2, 2]\ncells = [8, 8]\nwaves = [{amplitude = 0.02, wavelength = 0.6}]");
const std::string kBallAndMirror =
    object("ball", "sphere", "glass", {0, 0.7, 0}, "radius = 0.4\nsegments = 12") +
    floorPlane("pane", "mirror", 0.5, {0.9, 0.1, 0});
const std::string kFog = "[medium]\nscattering_per_meter = 0.2\nabsorption_per_meter = 0.05\n";

// What makes frames of this size cheap.
const Settings kSmall = {{"emit.photons", "16x16"},      {"shadow.map.size", "64"},
                         {"reconstruct.map_size", "64"}, {"emit.deferred.size", "64"},
                         {"around.cubes.size", "32"},    {"around.cubes.layers", "2"},
                         {"refine.finest", "64"},        {"refine.start", "8"},
                         {"refine.check", "16"},         {"specular.deferred.size", "64"},
                         {"emit.vertices.size", "64"},   {"specular.two_interfaces.size", "64"},
                         {"layers.count", "4"},          {"refine.memory", "16"}};

// Further answers than the techniques' own.
const std::vector<std::pair<std::string, Settings>> kVariants = {
    {"screen_space_photons",
     {{"specular", "split"},
      {"reconstruct", "sprites"},
      {"reconstruct.sprites.radius", "0.1"},
      {"view.refraction.search", "all"},
      {"media", "lines"},
      {"media.lines.width", "2"}}},
    {"screen_space_photons",
     {{"layers", "lists"}, {"trace.test", "in_out"}, {"view.refraction.surfaces", "layers"}}},
    {"screen_space_photons", {{"layers", "peel"}, {"trace", "lines"}, {"view", "image_space"}}},
    {"screen_space_photons", {{"specular", "two_interfaces"}, {"view.refraction.scene", "false"}}},
    {"screen_space_photons", {{"view", "around"}, {"shadow", "rays"}}},
    {"caustic_map", {{"trace.background.steps", "0"}, {"reconstruct.map_covers", "scene"}}},
    {"eye_gather", {{"view", "around"}}},
    {"adaptive_caustic_map", {{"refine.metric", "traversal"}, {"refine", "feedback"}}},
    {"adaptive_caustic_map", {{"refine.check", "128"}, {"refine.medium", "0"}}},
    {"adaptive_caustic_map", {{"refine.tolerance", "0"}}},
    {"adaptive_caustic_map", {{"reconstruct", "triangles"}, {"filter", "none"}}},
    {"hierarchical_caustic_map", {{"reconstruct", "triangles"}, {"filter", "none"}}},
    {"screen_space_photons", {{"specular", "deferred"}, {"view", "deferred"}}},
    {"screen_space_photons", {{"view", "interface"}, {"trace", "raytraced"}}},
    {"caustic_map", {{"reconstruct.fixed.diameter", "1"}}},
    {"caustic_triangles", {{"around.cubes.layers", "1"}}},
    {"caustic_triangles", {{"reconstruct.space", "light"}, {"gather", "project"}}}};

struct Outcome {
    std::vector<float> radiance;
    std::vector<float> irradiance;
    std::vector<double> ledger;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

class ParametersWithoutEffect : public testing::Test {
  protected:
    [[nodiscard]] RenderSettings settingsOf(const std::string& technique,
                                            const std::vector<Settings>& all) const {
        RenderSettings settings;
        settings.technique = registry_.findTechnique(technique);
        settings.params = registry_.makeParams(settings.technique);
        for (const Settings& some : all) {
            for (const auto& [name, value] : some)
                settings.params.set(name, value, "test");
        }
        settings.width = 32;
        settings.height = 24;
        return settings;
    }
    [[nodiscard]] static Outcome render(Renderer& renderer, const RenderSettings& settings) {
        renderer.update(settings);
        renderer.build(Purpose::measurement);
        gl::PassTimer timer(gl::TimerMode::finish);
        EXPECT_TRUE(renderer.renderFrame(timer));
        const FrameOutputs& outputs = renderer.outputs();
        const EnergyLedger ledger = renderer.ledger();
        return {renderer.texture(outputs.picture.radiance).read(),
                renderer.texture(outputs.caustic.irradiance).read(),
                {ledger.watts.begin(), ledger.watts.end()}};
    }
    // Names of which it is said.
    [[nodiscard]] static std::vector<params::NamedField> withoutEffect(const Renderer& renderer) {
        std::vector<params::NamedField> all = renderer.settings().params.all();
        std::erase_if(all, [&](const params::NamedField& named) {
            return renderer.whyNoEffect(named.fullName).empty();
        });
        return all;
    }
    // The far ends of what a parameter may be.
    [[nodiscard]] static std::string endOf(const params::Field& field, bool isUpper) {
        if (!field.choices.empty()) return isUpper ? field.choices.back() : field.choices.front();
        const auto end = static_cast<int>(isUpper ? field.maximum : field.minimum);
        const std::string type = field.typeName();
        if (type == "bool") return isUpper ? "true" : "false";
        if (type == "WxH") return fmt::format("{0}x{0}", end);
        if (type == "int") return std::to_string(end);
        return fmt::format("{}", static_cast<float>(isUpper ? field.maximum : field.minimum));
    }
    [[nodiscard]] static RenderSettings with(RenderSettings settings,
                                             const std::vector<params::NamedField>& fields,
                                             bool isUpper) {
        for (const params::NamedField& named : fields)
            settings.params.set(named.fullName, endOf(named.field, isUpper), "test");
        return settings;
    }
    void expectNoEffect(Renderer& renderer, const std::string& technique, const Settings& own) {
        const RenderSettings settings = settingsOf(technique, {kSmall, own});
        Outcome before;
        try {
            before = render(renderer, settings);
        } catch (const ConfigError&) {
            return;  // answers that do not fit together
        }
        ++rendered_;
        const std::vector<params::NamedField> fields = withoutEffect(renderer);
        for (const params::NamedField& named : fields)
            said_.insert(named.fullName);
        for (const bool isUpper : {false, true}) {
            if (render(renderer, with(settings, fields, isUpper)) == before) continue;
            // Which of them it was.
            for (const params::NamedField& named : fields) {
                EXPECT_TRUE(render(renderer, with(settings, {named}, isUpper)) == before)
                    << technique << ": " << named.fullName << " = " << endOf(named.field, isUpper);
            }
            ADD_FAILURE() << technique << ": " << (isUpper ? "upper" : "lower") << " ends";
        }
    }

    Registry registry_ = registerAll();
    int rendered_ = 0;
    std::set<std::string> said_;
};

TEST_F(ParametersWithoutEffect, LeaveEveryBitAsItIs) {
    for (const std::string& parts : {kWater, kFog + kBallAndMirror, std::string()}) {
        scene::Scene scene = makeScene(kCamera, parts + kSunAndFloor);
        if (parts.starts_with(kFog)) {
            scene.materials.front().kind = scene::MaterialKind::glossy;
            scene.materials.front().specular = glm::vec3(0.3f);
        }
        Renderer renderer(context(), registry_, scene, settingsOf("screen_space_photons", {}));
        for (const Technique& technique : registry_.techniques())
            expectNoEffect(renderer, technique.name, {});
        for (const auto& [technique, own] : kVariants)
            expectNoEffect(renderer, technique, own);
    }
    EXPECT_GT(rendered_, 50);
    // All that declares a condition has been among them.
    const params::ParamSet all = registry_.makeParams(registry_.techniques().front());
    for (const params::NamedField& named : all.all())
        EXPECT_TRUE(said_.contains(named.fullName) || named.field.conditions.empty())
            << named.fullName;
}

TEST_F(ParametersWithoutEffect, AreNamedWithTheReason) {
    struct Case {
        std::string technique;
        Settings settings;
        std::string name;
        std::string sentence;  // "": it has an effect
    };
    const scene::Scene scene = makeScene(kCamera, kSunAndFloor + kWater);
    const scene::SceneNeeds needs = sceneNeeds(scene);
    const std::string screen = "screen_space_photons";
    for (const Case& expected : std::vector<Case>{
             {screen, {}, "trace.epsilon", "trace.epsilon has no effect with trace.test=crossing."},
             {screen, {{"trace.test", "epsilon"}}, "trace.epsilon", ""},
             {screen,
              {},
              "reconstruct.map_size",
              "reconstruct.map_size has no effect: light is stored on the screen."},
             // Whose tracer looks into the lights' views of receivers.
             {"eye_gather", {}, "reconstruct.map_size", ""},
             {screen,
              {},
              "refine.tolerance",
              "refine.tolerance has no effect with driver=dense; take driver=adaptive."},
             {"hierarchical_caustic_map", {}, "refine.tolerance", ""},
             {"hierarchical_caustic_map",
              {},
              "refine.finest",
              "refine.finest has no effect with driver=hierarchical; take driver=adaptive."},
             {"adaptive_caustic_map",
              {},
              "emit.photons",
              "emit.photons has no effect with driver=adaptive; refine.finest and refine.memory "
              "have."},
             {"vertex_caustics",
              {},
              "emit.photons",
              "emit.photons has no effect: emit=vertices takes one photon a vertex."},
             {screen,
              {},
              "trace.lines.width",
              "trace.lines.width has no effect with trace=hierarchical."},
             {screen,
              {{"media", "lines"}},
              "media.lines.width",
              "media.lines.width has no effect: the scene has no medium that scatters."},
             {screen,
              {},
              "around.points",
              "around.points has no effect: nobody asks what lies around generators."},
             {"caustic_triangles", {}, "around.points", ""},
             {"caustic_triangles",
              {},
              "gather.cube.incidence",
              "gather.cube.incidence has no effect: no receiver is glossy."},
             {"adaptive_caustic_map",
              {{"refine.finest", "64"}},
              "refine.tolerance",
              "refine.tolerance has no effect: no cell is as fine as refine.check."},
             {"adaptive_caustic_map", {}, "refine.tolerance", ""},
             {"adaptive_caustic_map",
              {{"refine.metric", "traversal"}},
              "refine.signature",
              "refine.signature has no effect with refine.metric=traversal."},
             {"hierarchical_caustic_map",
              {{"reconstruct", "triangles"}},
              "reconstruct.triangles.merge",
              "reconstruct.triangles.merge has no effect: photons of driver=hierarchical stand for "
              "several cells; with refine.tolerance=0 they do not."},
             {"hierarchical_caustic_map",
              {{"reconstruct", "triangles"}, {"refine.tolerance", "0"}},
              "reconstruct.triangles.merge",
              ""},
             {"adaptive_caustic_map",
              {{"reconstruct", "triangles"}},
              "reconstruct.triangles.shading",
              "reconstruct.triangles.shading has no effect: photons of driver=adaptive are of "
              "cells of any size."},
             {screen,
              {{"specular", "deferred"}},
              "specular.deferred.incidence",
              "specular.deferred.incidence has no effect: the scene has no more than one body."},
             {screen,
              {{"specular", "two_interfaces"}},
              "specular.two_interfaces.steps",
              "specular.two_interfaces.steps has no effect: no dielectric of the scene has an "
              "inside."},
             {screen,
              {},
              "view.refraction.mirrors",
              "view.refraction.mirrors has no effect: the scene has no mirror."},
             {screen,
              {{"view.refraction.scene", "false"}},
              "view.refraction.reflection",
              "view.refraction.reflection has no effect with scene=false."},
             {"caustic_triangles",
              {},
              "around.max_generators",
              "around.max_generators has no effect: the scene has no more than one specular "
              "object."},
             {"caustic_map",
              {{"reconstruct.fixed.diameter", "1"}},
              "reconstruct.fixed.center",
              "reconstruct.fixed.center has no effect with reconstruct.fixed.diameter=1."},
             // Whether lists are made only the frame knows.
             {screen, {}, "layers.lists.memory", ""},
         }) {
        const RenderSettings settings = settingsOf(expected.technique, {expected.settings});
        const std::string reason = whyNoEffect({registry_, settings.params, &needs}, expected.name);
        EXPECT_EQ(reason.empty() ? "" : sayNoEffect(expected.name, reason), expected.sentence)
            << expected.technique << ", " << expected.name;
    }
}

TEST_F(ParametersWithoutEffect, AreSaidOnceAndOnlyOfWhatTheUserHasSet) {
    const scene::Scene scene = makeScene(kCamera, kSunAndFloor + kWater);
    const auto warningsOf = [&](const Settings& settings) {
        Renderer renderer(context(), registry_, scene,
                          settingsOf("screen_space_photons", {settings}));
        renderer.build(Purpose::picture);
        return renderer.warnings();
    };
    EXPECT_TRUE(warningsOf({}).empty());
    // So few layers that peeling them is faster than lists.
    EXPECT_EQ(
        warningsOf({{"layers.count", "3"}, {"trace.epsilon", "0.1"}, {"layers.lists.memory", "9"}}),
        (std::vector<std::string>{
            "layers.lists.memory has no effect: no pass of this frame is layers.lists's.",
            "trace.epsilon has no effect with trace.test=crossing."}));
}

}  // namespace
}  // namespace kaustik::test
