// SPDX-License-Identifier: MIT
// In a frame of the same input as the one before, the processor waits for nothing and compiles
// nothing. libepoxy calls each function by a pointer of its own, which is replaced here.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <type_traits>

#include "framework/core/error.h"
#include "framework/run/settings.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

// Calls by which the processor waits for the device, or has a program made, by name.
std::map<std::string, int> calls;

// Stands in place of one of OpenGL's functions, whose pointer is `function`.
template <auto* function, class Pointer = std::remove_pointer_t<decltype(function)>>
struct Counted;
template <auto* function, class Result, class... In>
struct Counted<function, Result (*)(In...)> {
    static inline Result (*before)(In...) = nullptr;
    static inline const char* name = "";
    static Result call(In... in) {
        ++calls[name];
        return before(in...);
    }
};

class Watch {
  public:
    Watch() {
        calls.clear();
        watch<&glFinish>("glFinish");
        watch<&glGetNamedBufferSubData>("glGetNamedBufferSubData");
        watch<&glGetTextureImage>("glGetTextureImage");
        watch<&glGetTextureSubImage>("glGetTextureSubImage");
        watch<&glReadPixels>("glReadPixels");
        watch<&glMapNamedBuffer>("glMapNamedBuffer");
        watch<&glGetQueryObjectuiv>("glGetQueryObjectuiv");
        watch<&glCreateProgram>("glCreateProgram");
        // To ask whether something is done is no wait.
        static PFNGLCLIENTWAITSYNCPROC wait = nullptr;
        wait = reinterpret_cast<PFNGLCLIENTWAITSYNCPROC>(eglGetProcAddress("glClientWaitSync"));
        restores_.emplace_back([before = glClientWaitSync] { glClientWaitSync = before; });
        glClientWaitSync = [](GLsync sync, GLbitfield flags, GLuint64 time) {
            if (time > 0) ++calls["glClientWaitSync"];
            return wait(sync, flags, time);
        };
    }
    ~Watch() {
        for (const std::function<void()>& restore : restores_)
            restore();
    }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    // Those since the last call, in words; "" for none.
    [[nodiscard]] static std::string take() {
        std::string text;
        for (const auto& [name, count] : calls)
            text += fmt::format("{} {} ", count, name);
        calls.clear();
        return text;
    }

  private:
    template <auto* function>
    void watch(const char* name) {
        // What libepoxy has may look the function up first, by the pointer that is replaced here.
        using Pointer = std::remove_pointer_t<decltype(function)>;
        Counted<function>::before = reinterpret_cast<Pointer>(eglGetProcAddress(name));
        Counted<function>::name = name;
        restores_.emplace_back([before = *function] { *function = before; });
        *function = &Counted<function>::call;
    }
    std::vector<std::function<void()>> restores_;
};

class SteadyFrames : public testing::Test {
  protected:
    [[nodiscard]] RenderSettings settings(const std::string& technique,
                                          std::vector<params::Assignment> assignments = {}) const {
        for (const auto& [name, value] : {std::pair("emit.photons", "32x32"),
                                          {"refine.finest", "64"},
                                          {"refine.start", "16"},
                                          {"refine.check", "32"},
                                          {"emit.deferred.size", "64"},
                                          {"refine.memory", "1"},
                                          {"shadow.map.size", "64"}})
            assignments.insert(assignments.begin(), {name, value, "test"});
        RenderSettings settings =
            run::makeSettings({.technique = technique, .assignments = assignments}, registry_);
        run::setSize(settings, {48, 36});
        // Where the device is the processor it traces, for which it reads what there is to trace.
        settings.asOnGpu = true;
        return settings;
    }
    Registry registry_ = registerAll();
    scene::Scene scene_ = sceneFromText(kWavyWater);
};

// trace.raytraced has the processor trace, for which it must read what there is to trace.
bool waitsByItsNature(const Renderer& renderer) {
    return renderer.settings().params.choice(TraceStage::name) == "raytraced";
}

TEST_F(SteadyFrames, OfAllTechniquesWaitForNothing) {
    bool hasWaited = false;
    int rendered = 0;
    for (const Technique& technique : registry_.techniques()) {
        SCOPED_TRACE(technique.name);
        try {
            Renderer renderer(context(), registry_, scene_, settings(technique.name));
            renderer.build(Purpose::picture);
            gl::PassTimer timer(gl::TimerMode::timestamps);
            const Watch watch;
            renderer.renderFrame(timer);
            EXPECT_EQ(calls.count("glCreateProgram"), 0u) << "a program was not known before";
            const std::string first = Watch::take();
            hasWaited = hasWaited || !first.empty();
            if (waitsByItsNature(renderer)) continue;
            for (int frame = 0; frame < 3; ++frame) {
                renderer.renderFrame(timer);
                EXPECT_EQ(Watch::take(), "") << "frame " << frame + 2;
            }
            EXPECT_EQ(renderer.executor().takeCutShort(true), 0u);
            ++rendered;
        } catch (const ConfigError& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_TRUE(hasWaited) << "the first frame waits for its loops";
    EXPECT_GT(rendered, 8);
}

// For all that is asked for, and by a graph that is built for something else afterwards.
TEST_F(SteadyFrames, CompileNoProgramThatWasNotListed) {
    for (const char* technique : {"screen_space_photons", "adaptive_caustic_map",
                                  "hierarchical_caustic_map", "exact_rays"}) {
        for (const bool asOnGpu : {true, false}) {
            SCOPED_TRACE(fmt::format("{} {}", technique, asOnGpu));
            RenderSettings wanted = settings(technique);
            wanted.asOnGpu = asOnGpu;
            Renderer renderer(context(), registry_, scene_, wanted);
            for (const Purpose purpose :
                 {Purpose::picture, Purpose::measurement, Purpose::audit, Purpose::view}) {
                renderer.build(purpose);
                gl::PassTimer timer(gl::TimerMode::finish);
                const Watch watch;
                renderer.renderFrame(timer);
                EXPECT_EQ(calls.count("glCreateProgram"), 0u) << static_cast<int>(purpose);
            }
        }
    }
}

// The rounds of frames that wait for nothing are as many, in several batches too.
TEST_F(SteadyFrames, OfAnAdaptiveDriverEmitTheSamePhotons) {
    for (const char* technique : {"adaptive_caustic_map", "hierarchical_caustic_map"}) {
        SCOPED_TRACE(technique);
        Renderer renderer(context(), registry_, scene_,
                          settings(technique, {{"refine.finest", "256", "test"}}));
        renderer.build(Purpose::measurement);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer.renderFrame(timer);
        const EnergyLedger first = renderer.ledger();
        EXPECT_GT(first.events[transport::kAccountEmitted], 0u);
        for (int frame = 0; frame < 3; ++frame) {
            renderer.renderFrame(timer);
            EXPECT_EQ(renderer.ledger().events, first.events);
        }
        EXPECT_EQ(renderer.executor().takeCutShort(true), 0u);
    }
}

// What a filter over time remembers is not touched by asking which programs there are.
TEST_F(SteadyFrames, AreTheSameWhetherOrNotTheirProgramsWereListedBetween) {
    const auto third = [&](bool lists) {
        Renderer renderer(
            context(), registry_, scene_,
            settings("screen_space_photons", {{"temporal", "reproject", "test"},
                                              {"temporal.reproject.weight", "0.5", "test"}}));
        gl::PassTimer timer(gl::TimerMode::finish);
        for (int frame = 0; frame < 3; ++frame) {
            renderer.build(Purpose::picture);
            if (lists) {
                EXPECT_GT(renderer.listPrograms().size(), 10u);
            }
            renderer.renderFrame(timer);
        }
        return renderer.texture(renderer.outputs().picture.radiance).read();
    };
    EXPECT_EQ(third(true), third(false));
}

}  // namespace
}  // namespace kaustik::test
