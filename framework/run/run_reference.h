// SPDX-License-Identifier: MIT
// The ray-traced reference of a run (`--reference`): where it comes from, and what a rendered frame
// is found to be worth next to it. `none` needs no Embree; the rest is a ConfigError without it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/pipeline/renderer.h"
#include "framework/report/run_report.h"
#include "framework/run/progress.h"

namespace kaustik::run {

class RunReference {
  public:
    // `wanted`: none, auto (of at least so many photons) or the file of a reference. Reads or
    // computes what there is to compare with, for the renderer's scene and size, as of its last
    // build. Throws ConfigError for a reference of another scene or size, IoError for a damaged
    // one. `watch` is told how far a computation has come and may end it; without one, standard
    // error shows it and Ctrl-C ends it.
    RunReference(const std::string& wanted, std::uint64_t photons, const Renderer& renderer,
                 const Watch& watch = {});
    ~RunReference();
    RunReference(RunReference&&) noexcept;
    RunReference& operator=(RunReference&&) noexcept;

    // What the frame must be built for.
    [[nodiscard]] Purpose purpose() const;

    // Has judge() also tell how much the caustic flickers between the last two frames of different
    // times: obtains the truth at the earlier one's, of the renderer's scene as it is else. `auto`
    // only; a file is of one time, and the report then says why there is no number.
    // `earlierSeconds` is none where there is no such frame.
    void watchFlicker(std::optional<double> earlierSeconds, const Renderer& renderer);
    // Keeps the caustic of the frame that was rendered last, for that. Waits for the device.
    void recordMoment(const Renderer& renderer);

    // Judges the frame that was rendered for purpose(): fills the record's hits and error, and the
    // causes in its ledger. Writes pictures into `folder` and gives their names.
    std::vector<std::filesystem::path> judge(const Renderer& renderer,
                                             const std::filesystem::path& folder,
                                             report::RunRecord& record) const;

    // Judges what the eye sees through specular surfaces, without caustics on either side: renders
    // a frame of its own and fills `view` of the record's error. Writes pictures as judge() does.
    // The renderer is left with that frame.
    std::vector<std::filesystem::path> judgeView(Renderer& renderer,
                                                 const std::filesystem::path& folder,
                                                 report::RunRecord& record) const;

  private:
    struct Loaded;
    std::unique_ptr<Loaded> loaded_;
};

}  // namespace kaustik::run
