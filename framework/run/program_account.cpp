// SPDX-License-Identifier: MIT
#include "framework/run/program_account.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "framework/core/error.h"

namespace kaustik::run {

void ProgramAccount::add(Renderer& renderer) {
    const std::vector<gl::UsedProgram> used = renderer.listPrograms();
    std::vector<gl::ProgramKey> keys;
    for (const gl::UsedProgram& program : used)
        keys.push_back(program.key);
    renderer.programs().start(keys);
    for (const gl::UsedProgram& program : used) {
        if (!known_.insert(program.key).second) continue;
        const std::string name =
            fmt::format("{} ({})", fmt::join(program.key.files, " + "), program.pass);
        try {
            const gl::Program& linked = renderer.programs().get(program.key);
            std::vector<gl::StageText> stages;
            for (const std::string& file : program.key.files) {
                stages.push_back({file, gl::loadShaderText(file, program.key.declarations,
                                                           renderer.programs().folders())
                                            .text});
            }
            const std::vector<std::string> lacked =
                gl::lackedBy(gl::takenBy(linked.id(), stages), given_);
            if (!lacked.empty())
                problems_.push_back(fmt::format("{} takes {}", name, fmt::join(lacked, "; ")));
        } catch (const ShaderError& error) {
            problems_.push_back(fmt::format("{}: {}", name, error.what()));
        }
    }
}

std::string ProgramAccount::text(const std::string& what) const {
    if (problems_.empty())
        return fmt::format("all {} programs of {} fit this device\n", count(), what);
    std::string text = fmt::format("{} of the {} programs of {} do not fit this device\n",
                                   problems_.size(), count(), what);
    for (const std::string& problem : problems_)
        text += fmt::format("  ! {}\n", problem);
    return text;
}

}  // namespace kaustik::run
