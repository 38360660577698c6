// SPDX-License-Identifier: MIT
// What a session of Python's holds and does on its thread.
#pragma once

#include "framework/gl/context.h"
#include "framework/params/assignment.h"
#include "framework/python/session.h"
#include "framework/run/session.h"

namespace kaustik::python {

// The assignments of the settings that Python hands over.
[[nodiscard]] std::vector<params::Assignment> assignmentsOf(
    const std::map<std::string, std::string>& settings);

// {frames, frame_ms, passes}, as in report.json.
[[nodiscard]] nlohmann::json timesOf(const report::RunRecord& record);

struct Session::Device {
    Device(scene::Scene loaded, const SessionOptions& options);

    // Renders the last frame once more where it is not there any more. ConfigError before the
    // first.
    void requireFrame(const ShouldContinue& shouldContinue);
    // Has the resource kept, and a frame rendered that has it. Throws ConfigError for what is no
    // texture.
    graph::ResourceRef requireTexture(const std::string& name,
                                      const ShouldContinue& shouldContinue);
    Json step(const StepRequest& request, const ShouldContinue& shouldContinue);
    Json report(const Judgement& judgement, const ShouldContinue& shouldContinue);
    std::vector<std::filesystem::path> save(const std::filesystem::path& folder,
                                            const std::vector<std::string>& resources,
                                            const Judgement& judgement,
                                            const ShouldContinue& shouldContinue);
    [[nodiscard]] run::RunReference referenceFor(const Judgement& judgement,
                                                 const ShouldContinue& shouldContinue);
    // Other settings from the next frame on; the second at once, or everything is as it was.
    void change(RenderSettings settings);
    void adopt(RenderSettings settings);
    // The scene was changed.
    void noteEdit();

    scene::Scene scene;
    std::unique_ptr<gl::Context> context;
    std::optional<run::Session> session;
    std::set<std::string> read;  // resources that somebody has read
    bool hasStepped = false;
    bool isStale = false;  // something was changed after the last frame of a step
};

}  // namespace kaustik::python
