// SPDX-License-Identifier: MIT
#include "framework/gl/program.h"

#include <epoxy/egl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <type_traits>

#include "framework/core/error.h"
#include "framework/gl/executor.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;

// Shader files in a folder of their own; an absolute path is looked up as it is.
class Shaders : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("kaustik-shaders-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    static std::string errorOf(const std::string& file) {
        static_cast<void>(context());
        try {
            gl::Program program({{file}, ""});
        } catch (const ShaderError& error) {
            return error.what();
        }
        return "";
    }
    fs::path folder_;
};

TEST_F(Shaders, ASyntaxErrorNamesFileAndLineAsWritten) {
    const std::string file =
        write("bad.comp", "layout(local_size_x = 1) in;\n\nvoid main() {\n  int a = ;\n}\n");
    EXPECT_NE(errorOf(file).find("bad.comp:4:"), std::string::npos) << errorOf(file);
}

TEST_F(Shaders, AnErrorInAnIncludedFileNamesThatFileAndOneAfterItTheOuter) {
    const std::string inner = write("inner.glsl", "\n\nfloat f() { return missing; }\n");
    const std::string outer = write("outer.comp", "layout(local_size_x = 1) in;\n#include \"" +
                                                      inner + "\"\nvoid main() { f(); }\n");
    EXPECT_NE(errorOf(outer).find("inner.glsl:3:"), std::string::npos) << errorOf(outer);
    write("inner.glsl", "\n\nfloat f() { return 1.0; }\n");
    write("outer.comp",
          "layout(local_size_x = 1) in;\n#include \"" + inner + "\"\nvoid main() { g(); }\n");
    EXPECT_NE(errorOf(outer).find("outer.comp:3:"), std::string::npos) << errorOf(outer);
}

TEST_F(Shaders, AMissingIncludeNamesTheLineThatAsksForIt) {
    const std::string file = write("a.comp", "\n#include \"nowhere/b.glsl\"\nvoid main() {}\n");
    const std::string message = errorOf(file);
    EXPECT_NE(message.find("nowhere/b.glsl"), std::string::npos);
    EXPECT_NE(message.find("a.comp:2"), std::string::npos);
    EXPECT_NE(errorOf("nowhere/c.comp").find("does not exist"), std::string::npos);
}

TEST_F(Shaders, AFileThatIncludesItselfIsAnErrorAndNotALoop) {
    const std::string a = (folder_ / "a.glsl").string();
    write("a.glsl", "#include \"" + a + "\"\n");
    const std::string file = write("b.comp", "#include \"" + a + "\"\nvoid main() {}\n");
    EXPECT_NE(errorOf(file).find("includes itself"), std::string::npos);
}

TEST_F(Shaders, ReloadTakesWhatCompilesAndKeepsTheRest) {
    const std::string good = write("good.comp",
                                   "layout(local_size_x = 1) in;\nuniform int a;\n"
                                   "layout(r32f) uniform image2D image;\nvoid main() {\n"
                                   "    imageStore(image, ivec2(0), vec4(a));\n}\n");
    const std::string bad = write("bad.comp", "layout(local_size_x = 1) in;\nvoid main() {}\n");
    static_cast<void>(context());
    gl::ProgramCache programs;
    static_cast<void>(programs.get({{good}, ""}));
    const GLuint kept = programs.get({{bad}, ""}).id();
    EXPECT_TRUE(programs.reload().empty());

    const GLuint before = programs.get({{bad}, ""}).id();
    write("bad.comp", "layout(local_size_x = 1) in;\nvoid main() { mistake; }\n");
    write("good.comp",
          "layout(local_size_x = 1) in;\nuniform int b;\n"
          "layout(r32f) uniform image2D image;\nvoid main() {\n"
          "    imageStore(image, ivec2(0), vec4(b));\n}\n");
    const std::vector<std::string> errors = programs.reload();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("bad.comp:2"), std::string::npos) << errors[0];
    EXPECT_EQ(programs.get({{bad}, ""}).id(), before);
    EXPECT_NE(kept, 0u);
    EXPECT_GE(programs.get({{good}, ""}).uniform("b"), 0);
    EXPECT_THROW(static_cast<void>(programs.get({{good}, ""}).uniform("a")), ShaderError);
}

// What the driver is told and asked, in order; libepoxy calls it by pointers.
std::string calls;

class Calls {
  public:
    Calls() {
        const auto lookUp = [](const char* name, auto& function) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
                eglGetProcAddress(name));
        };
        lookUp("glCompileShader", compile_);
        lookUp("glLinkProgram", link_);
        lookUp("glGetShaderiv", ofShader_);
        lookUp("glGetProgramiv", ofProgram_);
        calls.clear();
        current_ = this;
        glCompileShader = [](GLuint shader) {
            calls += 'c';
            current_->compile_(shader);
        };
        glLinkProgram = [](GLuint program) {
            calls += 'l';
            current_->link_(program);
        };
        glGetShaderiv = [](GLuint shader, GLenum name, GLint* value) {
            calls += '?';
            current_->ofShader_(shader, name, value);
        };
        glGetProgramiv = [](GLuint program, GLenum name, GLint* value) {
            if (name == GL_LINK_STATUS) calls += '?';
            current_->ofProgram_(program, name, value);
        };
    }
    ~Calls() {
        glCompileShader = compile_;
        glLinkProgram = link_;
        glGetShaderiv = ofShader_;
        glGetProgramiv = ofProgram_;
    }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

  private:
    static inline Calls* current_ = nullptr;
    PFNGLCOMPILESHADERPROC compile_;
    PFNGLLINKPROGRAMPROC link_;
    PFNGLGETSHADERIVPROC ofShader_;
    PFNGLGETPROGRAMIVPROC ofProgram_;
};

// The tests run without a store, from which programs would be loaded.
TEST_F(Shaders, OfSeveralProgramsAreAllWithTheDriverBeforeItIsAskedAboutOne) {
    static_cast<void>(context());
    const std::string plain = write("plain.comp", "layout(local_size_x = 1) in;\nvoid main() {}\n");
    const std::string wrong =
        write("wrong.comp", "layout(local_size_x = 1) in;\nvoid main() { mistake; }\n");
    const std::vector<gl::ProgramKey> keys = {{{plain}, ""},
                                              {{plain}, "#define OTHER\n"},
                                              {{wrong}, ""},
                                              {{(folder_ / "none.comp").string()}, ""}};
    gl::ProgramCache programs;
    const Calls watched;
    programs.start(keys);
    EXPECT_EQ(calls, "clclcl");
    programs.start(keys);
    EXPECT_EQ(calls, "clclcl") << "what is there is not handed over again";
    EXPECT_TRUE(programs.get(keys[0]).isFinished());
    EXPECT_TRUE(programs.get(keys[1]).isFinished());
    EXPECT_EQ(calls, "clclcl??");
    static_cast<void>(programs.get(keys[0]));
    EXPECT_EQ(calls, "clclcl??") << "it is asked once";
    for (const auto& [key, part] : {std::pair(keys[2], "wrong.comp:2"), {keys[3], "none.comp"}}) {
        for (int i = 0; i < 2; ++i) {
            try {
                static_cast<void>(programs.get(key));
                ADD_FAILURE() << part;
            } catch (const ShaderError& error) {
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
            }
        }
    }
}

TEST(ShaderLog, IsReadInTheFormatsOfTheDriversThatThereAre) {
    const std::vector<gl::SourceLine> lines = {{"a.glsl", 1}, {"b.glsl", 7}, {"b.glsl", 8}};
    EXPECT_EQ(gl::readableShaderLog("0:2(5): error: x", lines), "  b.glsl:7: error: x");
    EXPECT_EQ(gl::readableShaderLog("0(3) : error C0000: x", lines), "  b.glsl:8: error C0000: x");
    EXPECT_EQ(gl::readableShaderLog("ERROR: 0:1: 'x' : undeclared", lines),
              "  a.glsl:1: 'x' : undeclared");
    EXPECT_EQ(gl::readableShaderLog("something else", lines), "  something else");
}

// Runs one pass and gives the error that it ends with.
template <class Error>
std::string runPass(const std::function<void(gl::PassContext&)>& execute) {
    struct None {};
    graph::Graph graph;
    graph.addPass<None, gl::PassContext>(
        {"stage.culprit", ""}, [](graph::PassSetup& setup, None&) { setup.sideEffect(); },
        [&](const None&, gl::PassContext& pass) { execute(pass); });
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    executor.prepare(graph.compile());
    gl::PassTimer timer(gl::TimerMode::finish);
    try {
        executor.runFrame(timer);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Executor, AnOpenGlErrorFailsTheRunAndNamesThePass) {
    const std::string message = runPass<DeviceError>([](gl::PassContext&) { glEnable(0xdead); });
    EXPECT_NE(message.find("stage.culprit"), std::string::npos) << message;
    // The error is not carried into the next run.
    EXPECT_EQ(runPass<DeviceError>([](gl::PassContext&) {}), "");
}

TEST(Executor, AMisspeltUniformIsAnError) {
    const std::string message = runPass<ShaderError>([](gl::PassContext& pass) {
        pass.compute("numerics/fresnel.comp").set("caseCuont", 1).dispatch(1);
    });
    EXPECT_NE(message.find("caseCuont"), std::string::npos) << message;
}

TEST(Executor, AskingForMoreMemoryThanTheDeviceHasIsAClearError) {
    struct Data {
        graph::Texture<RadianceTexel> texture;
    };
    graph::Graph graph;
    const Data& data = graph.addPass<Data, gl::PassContext>(
        {"stage.greedy", ""},
        [](graph::PassSetup& setup, Data& d) {
            d.texture = setup.create<RadianceTexel>("huge", 1 << 20, 4);
        },
        [](const Data&, gl::PassContext&) {});
    graph.request(data.texture);
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    try {
        executor.prepare(graph.compile());
        FAIL() << "a texture of 2^20 texels a side cannot be had";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("huge"), std::string::npos) << error.what();
    }
}

TEST(PassTimer, TimestampsGiveEveryFrameOnceAndInOrder) {
    struct None {};
    graph::Graph graph;
    for (const char* name : {"s.a", "s.b"}) {
        graph.addPass<None, gl::PassContext>(
            {name, ""}, [](graph::PassSetup& setup, None&) { setup.sideEffect(); },
            [](const None&, gl::PassContext&) {});
    }
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    executor.prepare(graph.compile());
    gl::PassTimer timer(gl::TimerMode::timestamps);
    std::vector<gl::FrameTime> frames;
    for (int i = 0; i < 10; ++i) {
        executor.runFrame(timer);
        context().finish();
        for (gl::FrameTime& frame : timer.takeFinished())
            frames.push_back(std::move(frame));
    }
    for (gl::FrameTime& frame : timer.takeFinished(true))
        frames.push_back(std::move(frame));
    ASSERT_EQ(frames.size() + timer.droppedFrames(), 10u);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        EXPECT_GT(frames[i].frame, frames[i - 1].frame);
    }
    for (const gl::FrameTime& frame : frames) {
        ASSERT_EQ(frame.passes.size(), 2u);
        EXPECT_GE(frame.passes[0].gpuMs, 0.0);
        EXPECT_LE(frame.passes[0].startMs, frame.passes[1].startMs);
        EXPECT_GE(frame.frameMs, frame.passes[1].startMs);
    }
}

TEST(PassTimer, MeasuringTakesTimeInBothModes) {
    static_cast<void>(context());  // makes one current
    for (const gl::TimerMode mode : {gl::TimerMode::timestamps, gl::TimerMode::finish}) {
        const double each = gl::measuringMilliseconds(mode);
        EXPECT_GT(each, 0.0);
        EXPECT_LT(each, 1000.0);
    }
}

}  // namespace
}  // namespace kaustik::test
