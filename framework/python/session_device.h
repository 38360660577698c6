// SPDX-License-Identifier: MIT
// What a session holds and does on its thread.
#pragma once

#include <chrono>

#include "framework/gl/context.h"
#include "framework/python/session.h"

namespace kaustik::python {

// WxH. Throws ConfigError.
void setSize(RenderSettings& settings, const std::string& text);

// {frames, frame_ms, passes}, as in report.json.
[[nodiscard]] nlohmann::json timesOf(const report::RunRecord& record);

struct Session::Device {
    Device(scene::Scene loaded, const SessionOptions& options);

    // Brings the renderer to the settings and the scene, built for pictures and what is kept.
    void prepare();
    // One frame; throws Stopped.
    void render(const GoesOn& goesOn);
    // Renders the last frame once more where it is not there any more. ConfigError before the
    // first.
    void requireFrame(const GoesOn& goesOn);
    // Has the resource kept, and a frame rendered that has it. Throws ConfigError for what is no
    // texture.
    graph::ResourceRef requireTexture(const std::string& name, const GoesOn& goesOn);
    void goToTime(double seconds);
    Json step(const StepRequest& request, const GoesOn& goesOn);
    Json report(const Judgement& judgement, const GoesOn& goesOn);
    std::vector<std::filesystem::path> save(const std::filesystem::path& folder,
                                            const std::vector<std::string>& resources,
                                            const Judgement& judgement, const GoesOn& goesOn);
    // The renderer holds another graph, or was changed.
    void forgetBuild() { isBuilt = hasFrame = false; }
    // Settings or scene are to be other ones from the next frame on.
    void change() { isChanged = isStale = true; }
    // Has these settings at once; where they cannot be, everything is as it was.
    void adopt(RenderSettings wanted);

    scene::Scene scene;
    RenderSettings settings;  // as asked for
    std::unique_ptr<gl::Context> context;
    std::unique_ptr<Renderer> renderer;
    std::unique_ptr<gl::PassTimer> timer;
    report::RunRecord record;    // of the frames since something was changed
    std::set<std::string> kept;  // resources that somebody has read
    bool isChanged = false;      // settings or scene are not the renderer's
    bool isBuilt = false;        // for pictures and what is kept
    bool hasFrame = false;       // the textures of the last build hold a whole frame
    bool hasStepped = false;
    bool isStale = false;  // something was changed after the last frame of a step
};

}  // namespace kaustik::python
