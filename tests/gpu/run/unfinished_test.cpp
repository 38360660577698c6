// SPDX-License-Identifier: MIT
// A device that is lost at any moment of a run: what was done by then is kept, what was not is
// named, and nothing that was read from a lost device passes for a result.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/image.h"
#include "framework/run/session.h"
#include "framework/run/settings.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

// From the n-th time on that it is asked, counted from 0, OpenGL says that the device was lost, and
// gives nothing but ones and NaN when it is read from. libepoxy calls it by pointers.
class LostFrom {
  public:
    explicit LostFrom(int questions) {
        // Reading is looked up here, since libepoxy does so by the pointers that are replaced.
        read_ = reinterpret_cast<PFNGLGETNAMEDBUFFERSUBDATAPROC>(
            eglGetProcAddress("glGetNamedBufferSubData"));
        readTexture_ =
            reinterpret_cast<PFNGLGETTEXTUREIMAGEPROC>(eglGetProcAddress("glGetTextureImage"));
        current_ = this;
        left_ = questions;
        glGetGraphicsResetStatus = []() -> GLenum {
            return current_->left_-- <= 0 ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR;
        };
        // Lost before it was asked the last time.
        glGetNamedBufferSubData = [](GLuint buffer, GLintptr at, GLsizeiptr bytes, void* data) {
            current_->read_(buffer, at, bytes, data);
            if (current_->left_ <= 0) std::memset(data, 0x7f, static_cast<std::size_t>(bytes));
        };
        glGetTextureImage = [](GLuint texture, GLint level, GLenum format, GLenum type,
                               GLsizei bytes, void* data) {
            current_->readTexture_(texture, level, format, type, bytes, data);
            if (current_->left_ <= 0) std::memset(data, 0xff, static_cast<std::size_t>(bytes));
        };
    }
    ~LostFrom() {
        glGetGraphicsResetStatus = status_;
        glGetNamedBufferSubData = buffer_;
        glGetTextureImage = texture_;
    }
    LostFrom(const LostFrom&) = delete;
    LostFrom& operator=(const LostFrom&) = delete;

  private:
    static inline LostFrom* current_ = nullptr;
    int left_ = 0;
    PFNGLGETNAMEDBUFFERSUBDATAPROC read_;
    PFNGLGETTEXTUREIMAGEPROC readTexture_;
    PFNGLGETGRAPHICSRESETSTATUSPROC status_ = glGetGraphicsResetStatus;
    PFNGLGETNAMEDBUFFERSUBDATAPROC buffer_ = glGetNamedBufferSubData;
    PFNGLGETTEXTUREIMAGEPROC texture_ = glGetTextureImage;
};

class Unfinished : public testing::Test {
  protected:
    Unfinished()
        : folder_(fs::temp_directory_path() /
                  ("kaustik-unfinished-" + std::to_string(::getpid()))) {
        fs::remove_all(folder_);
    }
    ~Unfinished() override { fs::remove_all(folder_); }

    // As the command line does it.
    void run(int questions, const std::string& wanted) {
        RenderSettings settings = run::makeSettings(
            {.technique = "screen_space_photons",
             .assignments = {{"emit.photons", "16x16", "test"}, {"shadow.map.size", "64", "test"}}},
            registry_);
        run::setSize(settings, {24, 18});
        run::Session session(context(), registry_, scene_, settings);
        session.prepare();
        const run::FrameSeries series{.frames = 2, .warmup = 1};
        run::RunReference reference = session.referenceFor(series, wanted, 2000);
        const LostFrom lost(questions);
        const std::vector<std::string> saved;
        try {
            session.render(series, {}, &reference, &saved);
        } catch (const DeviceError& error) {
            throw session.keepUnfinished(error, folder_, reference);
        }
        static_cast<void>(session.finish(reference, folder_, saved));
    }

    // What is to be there when the run has ended with that message.
    void expectWhatWasDone(const std::string& message) const {
        EXPECT_FALSE(fs::exists(folder_ / "report.json")) << message;
        const fs::path place = folder_ / "unfinished";
        if (message.find("nothing is kept") != std::string::npos) {
            EXPECT_FALSE(fs::exists(place)) << message;
            return;
        }
        ASSERT_TRUE(fs::exists(place / "report.json")) << message;
        EXPECT_NE(message.find(place.string()), std::string::npos) << message;
        const json report = json::parse(readFile(place / "report.json"));
        const std::size_t frames = report.at("frames").get<std::size_t>();
        EXPECT_TRUE(frames == 1 || frames == 2) << message;
        EXPECT_GT(report.at("frame_ms").at("min").get<double>(), 0.0);
        EXPECT_EQ(json::parse(readFile(place / "samples.json")).at("frame_samples_ms").size(),
                  frames);
        const json& ended = report.at("ended_early");
        std::string why = ended.at("why").get<std::string>();
        ASSERT_TRUE(why.ends_with('.')) << why;
        why.pop_back();
        EXPECT_TRUE(message.starts_with(why + "; what was done, ")) << message;
        const auto missing = ended.at("missing").get<std::set<std::string>>();
        for (const std::string& what : missing)
            EXPECT_NE(message.find(what), std::string::npos) << message;
        for (const char* key : {"energy", "photons", "layers", "violations"})
            EXPECT_EQ(report.contains(key), !missing.contains("ledger")) << key << ": " << message;
        if (report.contains("energy")) {
            EXPECT_LT(report.at("energy").at("balance").get<double>(), 1e-5) << message;
            EXPECT_GT(report.at("energy").at("balance").get<double>(), -1e-5) << message;
        }
        const fs::path picture = place / ("caustic" + std::string(floatImageExtension()));
        ASSERT_EQ(fs::exists(picture), !missing.contains("pictures")) << message;
        if (fs::exists(picture)) {
            for (const float value : readImage(picture).values)
                ASSERT_TRUE(value >= 0.0f) << message;
        }
    }

    // Loses the device at one moment after the other; gives what the runs lacked.
    std::set<std::string> loseEverywhere(const std::string& wanted) {
        std::set<std::string> lacked;
        std::set<std::string> places;
        for (int questions = 0;; ++questions) {
            fs::remove_all(folder_);
            try {
                run(questions, wanted);
                EXPECT_TRUE(fs::exists(folder_ / "report.json"));
                break;
            } catch (const DeviceError& error) {
                const std::string message = error.what();
                EXPECT_EQ(error.exitCode(), kExitDeviceLost) << message;
                EXPECT_EQ(message.find("The device was lost "), 0u) << message;
                EXPECT_EQ(message.find('\n'), std::string::npos) << message;
                expectWhatWasDone(message);
                places.insert(message.substr(0, message.find(';')));
                const std::size_t without = message.find("without ");
                if (without != std::string::npos)
                    lacked.insert(message.substr(without, message.find(", is in") - without));
            }
            if (HasFatalFailure()) break;
        }
        EXPECT_GT(places.size(), 20u) << "passes of pictures and of what is measured";
        return lacked;
    }

    Registry registry_ = registerAll();
    scene::Scene scene_ = sceneFromText(kWavyWater);
    fs::path folder_;
};

TEST_F(Unfinished, AtEveryMomentOfARun) {
    if (!context().info().robust) GTEST_SKIP() << "this driver does not tell";
    EXPECT_EQ(loseEverywhere("none"),
              (std::set<std::string>{"without ledger and pictures", "without pictures"}));
}

TEST_F(Unfinished, AtEveryCheckOfARunWithAReference) {
    if (!context().info().robust) GTEST_SKIP() << "this driver does not tell";
    if (lacksExactTracer()) GTEST_SKIP() << "this build has no reference";
    EXPECT_EQ(loseEverywhere("auto"),
              (std::set<std::string>{"without ledger, pictures and judgement by the reference",
                                     "without pictures and judgement by the reference",
                                     "without judgement by the reference"}));
}

// And the next run that is done leaves nothing of it.
TEST_F(Unfinished, IsGoneOnceARunIsDone) {
    if (!context().info().robust) GTEST_SKIP() << "this driver does not tell";
    for (int questions = 0; !fs::exists(folder_ / "unfinished/report.json"); questions += 4)
        ASSERT_THROW(run(questions, "none"), DeviceError);
    run(1 << 20, "none");
    EXPECT_TRUE(fs::exists(folder_ / "report.json"));
    EXPECT_FALSE(fs::exists(folder_ / "unfinished"));
}

}  // namespace
}  // namespace kaustik::test
