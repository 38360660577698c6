// SPDX-License-Identifier: MIT
// An execute that asks for what its setup has not declared, or misuses a command, ends the run with
// an error that names the pass and the resource, in every build.
#include <functional>

#include "framework/core/error.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

struct Element {
    float value[4];
};
struct Resources {
    graph::Texture<RadianceTexel> image;
    graph::Buffer<Element> list;
};
using Execute = std::function<void(const Resources& made, const Resources& own, gl::PassContext&)>;

// stage.maker makes an image and a list; stage.culprit, which reads only the image and makes a list
// and an image of its own, runs `execute`. Gives the error that the frame ends with.
std::string errorOf(const Execute& execute) {
    graph::Graph graph;
    const auto make = [](graph::PassSetup& setup, Resources& data, const std::string& name) {
        data.image = setup.create<RadianceTexel>(name + ".image", 4, 4);
        data.list = setup.createBuffer<Element>(name + ".list", 4);
    };
    const Resources made = graph.addPass<Resources, gl::PassContext>(
        {"stage.maker", ""},
        [&](graph::PassSetup& setup, Resources& data) { make(setup, data, "maker"); },
        [](const Resources& data, gl::PassContext& pass) {
            pass.texture(data.image).clear({1, 2, 3, 4});
            pass.buffer(data.list).clear();
        });
    graph.addPass<Resources, gl::PassContext>(
        {"stage.culprit", ""},
        [&](graph::PassSetup& setup, Resources& data) {
            make(setup, data, "culprit");
            setup.read(made.image);
            setup.sideEffect();
        },
        [&](const Resources& own, gl::PassContext& pass) { execute(made, own, pass); });
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    executor.prepare(graph.compile());
    gl::PassTimer timer(gl::TimerMode::finish);
    try {
        executor.runFrame(timer);
    } catch (const GraphError& error) {
        return error.what();
    }
    return "no error";
}

void expectNamed(const Execute& execute, const std::string& resource, const std::string& mistake) {
    const std::string message = errorOf(execute);
    for (const std::string& part : {std::string("'stage.culprit'"), resource, mistake})
        EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
}

gl::Command flatCommand(gl::PassContext& pass) {
    return pass.fullscreen("compose/picture_display.frag");
}

TEST(AuthorMistakes, ABufferLargerThanAStorageBlockIsRefusedByName) {
    graph::Graph graph;
    const auto blocks = static_cast<std::size_t>(context().info().maxStorageBlockBytes);
    graph.addPass<Resources, gl::PassContext>(
        {"stage.maker", ""},
        [&](graph::PassSetup& setup, Resources& data) {
            data.list = setup.createBuffer<Element>("maker.list", blocks / sizeof(Element) + 1);
            setup.sideEffect();
        },
        [](const Resources&, gl::PassContext&) {});
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    try {
        executor.prepare(graph.compile());
        FAIL() << "it was taken";
    } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("'maker.list'"), std::string::npos)
            << error.what();
    }
}

TEST(AuthorMistakes, WhatIsDeclaredIsNoError) {
    EXPECT_EQ(errorOf([](const Resources& made, const Resources& own, gl::PassContext& pass) {
                  pass.texture(made.image).copyTo(pass.texture(own.image));
                  pass.buffer(own.list).clear();
              }),
              "no error");
}

TEST(AuthorMistakes, AnUndeclaredReadNamesPassAndResource) {
    const std::string mistake = "without having declared it";
    const auto expectUndeclared = [&](const Execute& execute) {
        expectNamed(execute, "'maker.list'", mistake);
    };
    expectUndeclared([](const Resources& made, const Resources&, gl::PassContext& pass) {
        static_cast<void>(pass.buffer(made.list));
    });
    expectUndeclared([](const Resources& made, const Resources&, gl::PassContext& pass) {
        pass.compute("numerics/fresnel.comp").storage("Inputs", made.list);
    });
    expectNamed(
        [](const Resources&, const Resources&, gl::PassContext& pass) {
            flatCommand(pass).texture("radiance", graph::Texture<RadianceTexel>{});
        },
        "a handle that no pass has made", "");
}

TEST(AuthorMistakes, AWrongKindOfResourceNamesPassAndResource) {
    expectNamed([](const Resources&, const Resources& own,
                   gl::PassContext& pass) { flatCommand(pass).texture("radiance", own.list); },
                "'culprit.list'", "as a texture");
    expectNamed([](const Resources& made, const Resources&,
                   gl::PassContext& pass) { static_cast<void>(pass.buffer(made.image)); },
                "'maker.image'", "as a buffer");
}

TEST(AuthorMistakes, DrawingToWhatIsOnlyReadNamesPassAndResource) {
    expectNamed([](const Resources& made, const Resources&,
                   gl::PassContext& pass) { flatCommand(pass).target(made.image); },
                "'maker.image'", "declared only to read");
}

TEST(AuthorMistakes, ADrawToNothingNamesPassAndShader) {
    expectNamed(
        [](const Resources& made, const Resources&, gl::PassContext& pass) {
            flatCommand(pass).texture("radiance", made.image).draw();
        },
        "compose/picture_display.frag", "target() or depth() is missing");
    expectNamed([](const Resources&, const Resources&,
                   gl::PassContext& pass) { flatCommand(pass).clear(); },
                "", "target() or depth() comes first");
}

TEST(AuthorMistakes, GroupsOfNoThreadsNamePassAndShader) {
    expectNamed(
        [](const Resources&, const Resources&, gl::PassContext& pass) {
            pass.compute("numerics/fresnel.comp").dispatchOver(64, 0);
        },
        "numerics/fresnel.comp", "in groups of 0x1");
}

// A texture's memory is another's by then, unless it was asked for.
TEST(AuthorMistakes, WhatNothingAskedForCannotBeReadAfterTheFrame) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame(scene, 16, 12, {{"emit.photons", "8x8"}}, {"hits.flux"});
    EXPECT_EQ(frame.read("hits.flux").width, 8);
    const auto errorOfReading = [&](const std::string& name) -> std::string {
        try {
            static_cast<void>(frame.read(name));
        } catch (const GraphError& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_NE(errorOfReading("photons.direction").find("'photons.direction' is read after"),
              std::string::npos);
    EXPECT_NE(errorOfReading("photons.typo").find("a handle that no pass has made"),
              std::string::npos);
}

Hits noHits(FrameBuilder&, const params::NoParams&, Photons, Surfaces) {
    return {};
}

TEST(AuthorMistakes, ANodeOrATechniqueThatIsRegisteredTwiceIsNamed) {
    Registry registry = registerAll();
    const auto errorOfRegistering = [&](const auto& action) -> std::string {
        try {
            action();
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "no error";
    };
    const auto addNode = [&] {
        registry.node<TraceStage>("mine", {"None.", "a test", "For this test."}, &noHits);
    };
    const auto addTechnique = [&] { registry.technique({"mine", "None.", "a test", {}, {}}); };
    EXPECT_EQ(errorOfRegistering(addNode), "no error");
    EXPECT_EQ(errorOfRegistering(addNode), "The node 'trace.mine' is registered twice.");
    EXPECT_EQ(errorOfRegistering(addTechnique), "no error");
    EXPECT_EQ(errorOfRegistering(addTechnique), "The technique 'mine' is registered twice.");
    EXPECT_EQ(errorOfRegistering([&] { static_cast<void>(registry.findNode("trace", "lins")); }),
              "There is no node 'trace.lins'; did you mean 'trace.lines'?");
    registry.technique({"bad", "A default.", "a test", {{"trace", "lins"}}, {}});
    EXPECT_NE(errorOfRegistering([&] {
                  static_cast<void>(registry.makeParams(registry.findTechnique("bad")));
              }).find("technique 'bad': trace cannot be 'lins'; did you mean 'lines'?"),
              std::string::npos);
}

}  // namespace
}  // namespace kaustik::test
