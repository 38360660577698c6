// SPDX-License-Identifier: MIT
// What a pass does to memory is counted as it is, by shaders whose accesses are known by hand, and
// counting changes nothing of what they make.
#include "framework/gl/access_counter.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>

#include "framework/core/files.h"
#include "framework/gl/executor.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;

struct Thing {  // as the shaders below have it
    float place[4];
    float weight;
    float rest[3];
};
struct Number {
    unsigned value;
};
struct Resources {
    graph::Texture<RadianceTexel> image;
    graph::Buffer<Thing> things;
    graph::Buffer<Number> numbers;
};

class CountedAccesses : public ::testing::Test {
  protected:
    static constexpr int kWidth = 64;
    static constexpr int kHeight = 32;
    static constexpr int kThings = 1024;

    void SetUp() override {
        static_cast<void>(context());
        folder_ = fs::temp_directory_path() / ("kaustik-counted-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }

    // What the passes of the graph's first frame do.
    static std::vector<gl::PassAccesses> countFrame(graph::Graph& graph) {
        gl::ProgramCache programs;
        gl::Executor executor(context(), programs);
        executor.prepare(graph.compile());
        gl::AccessCounter counter(programs);
        executor.countAccesses(&counter);
        gl::PassTimer timer(gl::TimerMode::finish);
        executor.runFrame(timer);
        return counter.take();
    }
    static gl::PassAccesses passNamed(const std::vector<gl::PassAccesses>& passes,
                                      const std::string& name) {
        for (const gl::PassAccesses& pass : passes) {
            if (pass.name == name) return pass;
        }
        ADD_FAILURE() << name << " was not counted";
        return {};
    }

    // stage.maker clears an image, things and numbers; stage.counted runs `execute`, which may use
    // all of them and has an image of its own. Gives what is counted of that.
    using Execute =
        std::function<void(const Resources& made, const Resources& own, gl::PassContext&)>;
    static gl::PassAccesses count(const Execute& execute) {
        graph::Graph graph;
        const Resources made = graph.addPass<Resources, gl::PassContext>(
            {"stage.maker", ""},
            [&](graph::PassSetup& setup, Resources& data) {
                data.image = setup.create<RadianceTexel>("maker.image", kWidth, kHeight);
                data.things = setup.createBuffer<Thing>("maker.things", kThings);
                data.numbers = setup.createBuffer<Number>("maker.numbers", kThings);
            },
            [](const Resources& data, gl::PassContext& pass) {
                pass.texture(data.image).clear({1, 2, 3, 4});
                pass.buffer(data.things).clear();
                pass.buffer(data.numbers).clear();
            });
        graph.addPass<Resources, gl::PassContext>(
            {"stage.counted", ""},
            [&](graph::PassSetup& setup, Resources& data) {
                setup.read(made.image);
                setup.read(made.things);
                data.numbers = setup.write(made.numbers);
                data.image = setup.create<RadianceTexel>("counted.image", kWidth, kHeight);
                setup.sideEffect();
            },
            [&](const Resources& own, gl::PassContext& pass) { execute(made, own, pass); });
        return passNamed(countFrame(graph), "stage.counted");
    }

    fs::path folder_;
};

TEST_F(CountedAccesses, ReadsOfABufferAreThoseOfItsFieldsAndEachByteOnce) {
    // Every second thing, each by two threads: 4 of its 32 bytes are asked for twice, and lie in a
    // piece of 16.
    const std::string shader = write("read.comp",
                                     "layout(local_size_x = 64) in;\n"
                                     "struct Thing { vec4 place; float weight; float rest[3]; };\n"
                                     "layout(std430) readonly buffer Things { Thing things[]; };\n"
                                     "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                     "void main() {\n"
                                     "    uint i = gl_GlobalInvocationID.x;\n"
                                     "    numbers[i] = uint(things[(i / 2u) * 2u].weight) + 7u;\n"
                                     "}\n");
    const gl::PassAccesses counted =
        count([&](const Resources& made, const Resources& own, gl::PassContext& pass) {
            pass.compute(shader)
                .storage("Things", made.things)
                .storage("Numbers", own.numbers)
                .dispatch(kThings / 64);
        });
    EXPECT_EQ(counted.requestedReadBytes, kThings * 4u);
    EXPECT_EQ(counted.readBytes, kThings / 2 * 16u);
    EXPECT_EQ(counted.requestedWrittenBytes, kThings * 4u);
    EXPECT_EQ(counted.writtenBytes, kThings * 4u);
    EXPECT_EQ(counted.threads, static_cast<unsigned>(kThings));
    EXPECT_EQ(counted.workGroups, kThings / 64u);
    EXPECT_EQ(counted.commands, 1u);
    EXPECT_EQ(counted.atomics, 0u);
}

TEST_F(CountedAccesses, TexelsOfABufferAreReadBySixteenBytes) {
    // The second of the two texels that every second thing has, each by two threads.
    const std::string shader = write("texels.comp",
                                     "layout(local_size_x = 64) in;\n"
                                     "uniform samplerBuffer things;\n"
                                     "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                     "void main() {\n"
                                     "    int i = int(gl_GlobalInvocationID.x);\n"
                                     "    vec4 texel = texelFetch(things, (i / 2) * 4 + 1);\n"
                                     "    numbers[i] = uint(texel.x) + 7u;\n"
                                     "}\n");
    std::vector<Number> found;
    const gl::PassAccesses counted =
        count([&](const Resources& made, const Resources& own, gl::PassContext& pass) {
            std::vector<Thing> things(kThings);
            for (std::size_t i = 0; i < things.size(); ++i)
                things[i].weight = static_cast<float>(i);
            pass.buffer(made.things).upload(0, things.size() * sizeof(Thing), things.data());
            pass.compute(shader)
                .texels("things", made.things, graph::Format::rgba32f)
                .storage("Numbers", own.numbers)
                .dispatch(kThings / 64);
            found = pass.buffer(own.numbers).read<Number>();
        });
    constexpr std::uint64_t kTexel = 16;
    EXPECT_EQ(counted.requestedReadBytes, kTexel * kThings);
    EXPECT_EQ(counted.readBytes, kTexel * kThings / 2);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(kThings));
    for (unsigned i = 0; i < found.size(); ++i)
        EXPECT_EQ(found[i].value, i / 2 * 2 + 7) << i;
}

TEST_F(CountedAccesses, TexelsOfOneWordAreReadByFourBytes) {
    // The weights of the first 256 things, which are words 4, 12, …: half of their pieces.
    constexpr unsigned kRead = 256;
    const std::string shader = write("words.comp",
                                     "layout(local_size_x = 64) in;\n"
                                     "uniform usamplerBuffer things;\n"
                                     "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                     "void main() {\n"
                                     "    int i = int(gl_GlobalInvocationID.x);\n"
                                     "    numbers[i] = texelFetch(things, 8 * i + 4).x + 1u;\n"
                                     "}\n");
    const gl::PassAccesses counted =
        count([&](const Resources& made, const Resources& own, gl::PassContext& pass) {
            pass.compute(shader)
                .texels("things", made.things, graph::Format::r32ui)
                .storage("Numbers", own.numbers)
                .dispatch(kRead / 64);
        });
    EXPECT_EQ(counted.requestedReadBytes, 4u * kRead);
    EXPECT_EQ(counted.readBytes, 16u * kRead);
}

TEST_F(CountedAccesses, AtomicsAreToldApartAndLocalsOfTheSameNameAreNone) {
    const std::string shader = write("atomic.comp",
                                     "layout(local_size_x = 64) in;\n"
                                     "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                     "uint first(uint numbers[2]) { return numbers[0]; }\n"
                                     "void main() {\n"
                                     "    uint i = gl_GlobalInvocationID.x;\n"
                                     "    // numbers[i] in a comment\n"
                                     "    if (i % 4u == 0u) atomicAdd(numbers[i % 8u], 1u);\n"
                                     "    numbers[512u] += first(uint[2](0u, 1u));\n"
                                     "}\n");
    const gl::PassAccesses counted =
        count([&](const Resources&, const Resources& own, gl::PassContext& pass) {
            pass.compute(shader).storage("Numbers", own.numbers).dispatch(kThings / 64);
        });
    EXPECT_EQ(counted.atomics, kThings / 4u);
    EXPECT_EQ(counted.requestedReadBytes, kThings * 4u);
    EXPECT_EQ(counted.requestedWrittenBytes, kThings * 4u);
    // Two words of the atomics lie in two pieces, and the sum in a third.
    EXPECT_EQ(counted.readBytes, 3u * 16u);
    EXPECT_EQ(counted.writtenBytes, 3u * 16u);
}

TEST_F(CountedAccesses, ADrawWritesThePixelsThatItDoesNotDiscard) {
    const std::string shader = write("draw.frag",
                                     "uniform sampler2D image;\n"
                                     "layout(location = 0) out vec4 color;\n"
                                     "void main() {\n"
                                     "    ivec2 pixel = ivec2(gl_FragCoord.xy);\n"
                                     "    if (pixel.y >= 8) discard;\n"
                                     "    color = texelFetch(image, pixel / 2, 0);\n"
                                     "}\n");
    const gl::PassAccesses counted =
        count([&](const Resources& made, const Resources& own, gl::PassContext& pass) {
            pass.fullscreen(shader).texture("image", made.image).target(own.image).draw();
        });
    constexpr unsigned kDrawn = kWidth * 8;
    EXPECT_EQ(counted.writtenBytes, kDrawn * 16u);
    EXPECT_EQ(counted.requestedWrittenBytes, kDrawn * 16u);
    EXPECT_EQ(counted.readBytes, kDrawn / 4 * 16u);
    EXPECT_EQ(counted.requestedReadBytes, kDrawn * 16u);
    // Three vertices, and every pixel whether it is discarded or not.
    EXPECT_EQ(counted.threads, 3u + kWidth * kHeight);
}

TEST_F(CountedAccesses, WhatIsClearedIsWrittenWholeAndBlendingReads) {
    const std::string shader = write("add.frag",
                                     "layout(location = 0) out vec4 color;\n"
                                     "void main() { color = vec4(1.0); }\n");
    const gl::PassAccesses counted =
        count([&](const Resources&, const Resources& own, gl::PassContext& pass) {
            pass.fullscreen(shader)
                .target(own.image)
                .clear()
                .blend(gl::Blend::add)
                .viewport(0, 0, 16, 16)
                .draw();
        });
    EXPECT_EQ(counted.writtenBytes, kWidth * kHeight * 16u);
    EXPECT_EQ(counted.requestedWrittenBytes, 16u * 16u * 16u);
    EXPECT_EQ(counted.readBytes, 16u * 16u * 16u);
}

// stage.inner loops by itself, which never goes on, within a loop that runs twice.
TEST_F(CountedAccesses, AReadBackIsOfThePassThatEndedLast) {
    const std::string inner = write("inner.comp",
                                    "layout(local_size_x = 1) in;\n"
                                    "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                    "void main() { numbers[0] += 1u; numbers[1] = 0u; }\n");
    const std::string outer = write("outer.comp",
                                    "layout(local_size_x = 1) in;\n"
                                    "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                    "void main() { numbers[2] = numbers[0] < 2u ? 1u : 0u; }\n");
    graph::Graph graph;
    struct Data {
        graph::Buffer<Number> numbers;
    };
    const auto start = graph.addPass<Data, gl::PassContext>(
        {"stage.start", ""},
        [](graph::PassSetup& setup, Data& data) {
            data.numbers = setup.createBuffer<Number>("numbers", 4);
        },
        [](const Data& data, gl::PassContext& pass) { pass.buffer(data.numbers).clear(); });
    const auto add = [&](const std::string& name, const std::string& shader, const Data& before) {
        return graph.addPass<Data, gl::PassContext>(
            {name, ""},
            [&](graph::PassSetup& setup, Data& data) {
                data.numbers = setup.write(before.numbers);
            },
            [shader](const Data& data, gl::PassContext& pass) {
                pass.compute(shader).storage("Numbers", data.numbers).dispatch(1);
            });
    };
    graph.beginLoop();
    graph.beginLoop();
    const Data afterInner = add("stage.inner", inner, start);
    graph.endLoop(afterInner.numbers, 1);
    const Data afterOuter = add("stage.outer", outer, afterInner);
    graph.endLoop(afterOuter.numbers, 2);
    graph.request(afterOuter.numbers);
    const std::vector<gl::PassAccesses> passes = countFrame(graph);
    EXPECT_EQ(passNamed(passes, "stage.start").readBacks, 0u);
    EXPECT_EQ(passNamed(passes, "stage.inner").readBacks, 2u);
    EXPECT_EQ(passNamed(passes, "stage.outer").readBacks, 2u);
}

// A loop that runs as often as a word of a buffer that the processor fills says, and then idly. In
// a graph's first frame the processor asks twice: once after the last run but one, which another
// one follows, and then. In those that follow it asks for nothing, and what was wrong with that is
// found.
TEST_F(CountedAccesses, ALoopThatMayRunIdleIsAskedForItsEndAlone) {
    const std::string shader = write("steps.comp",
                                     "layout(local_size_x = 1) in;\n"
                                     "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                     "layout(std430) readonly buffer Wanted { uint wanted[]; };\n"
                                     "void main() {\n"
                                     "    if (numbers[0] < wanted[0]) numbers[0] += 1u;\n"
                                     "    numbers[1] = numbers[0] < wanted[0] ? 1u : 0u;\n"
                                     "    numbers[2] += 1u;\n"
                                     "}\n");
    graph::Graph graph;
    struct Data {
        graph::Buffer<Number> numbers;
    };
    const gl::Buffer wanted(sizeof(Number), nullptr, "wanted");
    const auto start = graph.addPass<Data, gl::PassContext>(
        {"stage.start", ""},
        [](graph::PassSetup& setup, Data& data) {
            data.numbers = setup.createBuffer<Number>("numbers", 4);
        },
        [](const Data& data, gl::PassContext& pass) { pass.buffer(data.numbers).clear(); });
    graph.beginLoop();
    const auto stepped = graph.addPass<Data, gl::PassContext>(
        {"stage.step", ""},
        [&](graph::PassSetup& setup, Data& data) { data.numbers = setup.write(start.numbers); },
        [&](const Data& data, gl::PassContext& pass) {
            pass.compute(shader)
                .storage("Numbers", data.numbers)
                .storage("Wanted", wanted)
                .dispatch(1);
        });
    graph.endLoop(stepped.numbers, 1, true);
    graph.request(stepped.numbers);
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    executor.prepare(graph.compile());
    gl::AccessCounter counter(programs);
    executor.countAccesses(&counter);
    gl::PassTimer timer(gl::TimerMode::finish);
    struct Expected {
        unsigned wanted;
        unsigned runs;
        std::uint64_t readBacks;
    };
    // The first frame knows nothing; of fewer runs it finds one less a frame, and of more each.
    for (const Expected& expected : std::vector<Expected>{{6, 6, 6},
                                                          {6, 6, 2},
                                                          {3, 5, 1},
                                                          {3, 4, 1},
                                                          {3, 3, 1},
                                                          {3, 3, 2},
                                                          {5, 5, 4},
                                                          {1, 4, 1}}) {
        SCOPED_TRACE(testing::Message() << expected.wanted << ", " << expected.runs);
        wanted.upload(0, sizeof(unsigned), &expected.wanted);
        executor.prepare(graph.compile());
        executor.runFrame(timer);
        const std::vector<Number> numbers = executor.buffer(stepped.numbers).read<Number>();
        EXPECT_EQ(numbers[0].value, expected.wanted);
        EXPECT_EQ(numbers[2].value, expected.runs);
        EXPECT_EQ(passNamed(counter.take(), "stage.step").readBacks, expected.readBacks);
    }
    const auto renderFrame = [&](unsigned times, const Expected& expected) {
        SCOPED_TRACE(testing::Message() << times << ", " << expected.runs);
        wanted.upload(0, sizeof(unsigned), &times);
        executor.runFrame(timer);
        const std::vector<Number> numbers = executor.buffer(stepped.numbers).read<Number>();
        EXPECT_EQ(numbers[0].value, expected.wanted);
        EXPECT_EQ(numbers[2].value, expected.runs);
        EXPECT_EQ(passNamed(counter.take(), "stage.step").readBacks, expected.readBacks);
    };
    renderFrame(1, {1, 4, 0});
    renderFrame(4, {4, 4, 0});
    EXPECT_EQ(executor.takeCutShort(true), 0u);
    renderFrame(6, {4, 4, 0});
    EXPECT_EQ(executor.takeCutShort(true), 1u);
    renderFrame(6, {6, 6, 4});
    renderFrame(6, {6, 6, 0});
    EXPECT_EQ(executor.takeCutShort(true), 0u);
}

// Of a list that lives to the frame's end the pass writes 64 numbers; zeros are written before.
TEST_F(CountedAccesses, WhatIsClearedBeforeThePassThatFirstWritesItIsWrittenWhole) {
    const std::string shader = write("first.comp",
                                     "layout(local_size_x = 64) in;\n"
                                     "layout(std430) buffer Numbers { uint numbers[]; };\n"
                                     "void main() { numbers[gl_GlobalInvocationID.x] = 1u; }\n");
    graph::Graph graph;
    struct Data {
        graph::Buffer<Number> numbers;
    };
    const Data list = graph.addPass<Data, gl::PassContext>(
        {"stage.list", ""},
        [](graph::PassSetup& setup, Data& data) {
            data.numbers = setup.createBuffer<Number>("numbers", kThings);
        },
        [&](const Data& data, gl::PassContext& pass) {
            pass.compute(shader).storage("Numbers", data.numbers).dispatch(1);
        });
    graph.request(list.numbers);
    const gl::PassAccesses counted = passNamed(countFrame(graph), "stage.list");
    EXPECT_EQ(counted.requestedWrittenBytes, 64u * 4u);
    EXPECT_EQ(counted.writtenBytes, kThings * 4u);
}

// Of a frame, with and without counting: all that the picture is made of, to the bit.
class CountedFrame : public ::testing::TestWithParam<const char*> {};

TEST_P(CountedFrame, IsTheSameFrameAndTouchesNoMoreThanIsThere) {
    const scene::Scene scene =
        scene::loadSceneFile(projectRoot() / "experiments/scenes/glass-sphere.toml");
    Settings settings = {{"emit.photons", "48x48"}};
    // By shaders, as on a GPU.
    if (GetParam() == std::string("exact_rays")) settings.emplace_back("trace", "bvh");
    Frame frame(scene, 64, 48, settings, {}, false, GetParam());
    const auto read = [&] {
        const Renderer& renderer = frame.renderer();
        std::vector<float> all = renderer.texture(renderer.outputs().picture.radiance).read();
        const std::vector<float> caustic =
            renderer.texture(renderer.outputs().caustic.irradiance).read();
        all.insert(all.end(), caustic.begin(), caustic.end());
        return all;
    };
    const std::vector<float> before = read();
    ASSERT_TRUE(std::any_of(before.begin(), before.end(), [](float v) { return v > 0.0f; }));
    gl::AccessCounter counter(frame.renderer().programs());
    frame.renderer().executor().countAccesses(&counter);
    gl::PassTimer timer(gl::TimerMode::finish);
    frame.renderer().renderFrame(timer);
    EXPECT_EQ(before, read());
    const std::vector<gl::PassAccesses> passes = counter.take();
    std::size_t steps = 0;
    for (const gl::PassAccesses& pass : passes) {
        ++steps;
        for (const gl::PassAccesses::Resource& resource : pass.resources) {
            EXPECT_LE(resource.readBytes, resource.bytes) << pass.name << " " << resource.name;
            EXPECT_LE(resource.writtenBytes, resource.bytes) << pass.name << " " << resource.name;
        }
    }
    EXPECT_GT(steps, 5u);
    // One that is known: each pixel of radiance is read once and makes four bytes.
    const auto display =
        std::find_if(passes.begin(), passes.end(),
                     [](const gl::PassAccesses& pass) { return pass.name == "compose.display"; });
    ASSERT_NE(display, passes.end());
    EXPECT_EQ(display->readBytes, 64u * 48u * 16u);
    EXPECT_EQ(display->writtenBytes, 64u * 48u * 4u);
}

INSTANTIATE_TEST_SUITE_P(Of, CountedFrame, ::testing::Values("screen_space_photons", "exact_rays"));

}  // namespace
}  // namespace kaustik::test
