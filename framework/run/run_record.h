// SPDX-License-Identifier: MIT
// From timed frames to what a run leaves behind: the same for the command line and the workbench.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/pipeline/renderer.h"
#include "framework/report/run_report.h"
#include "framework/run/run_reference.h"

namespace kaustik::run {

// What the renderer's graph, built for what is timed, says of itself; without frames.
[[nodiscard]] report::RunRecord startRecord(const Renderer& renderer, gl::TimerMode timer);

// Renders one more frame, which is not timed, for the ledger, the pictures, the resources `saved`
// and the reference's judgement, and completes the record but for that. The renderer is left with
// this frame. `goesOn` as Renderer::renderFrame's; false where it has said no.
bool measureRun(Renderer& renderer, const RunReference& reference, report::RunRecord& record,
                const std::vector<std::string>& saved,
                const std::function<bool(std::size_t)>& goesOn = {});

// The same, and the judgement; writes everything into `folder`: all of it or nothing. Gives the
// files. The renderer is left built for something else.
std::vector<std::filesystem::path> finishRun(Renderer& renderer, const RunReference& reference,
                                             report::RunRecord& record,
                                             const std::filesystem::path& folder,
                                             const std::vector<std::string>& saved,
                                             const gl::DeviceInfo& device);

}  // namespace kaustik::run
