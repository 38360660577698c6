// SPDX-License-Identifier: MIT
// Which programs frames ask for and which of them this device cannot run, known before any runs.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "framework/gl/program_needs.h"
#include "framework/pipeline/renderer.h"

namespace kaustik::run {

class ProgramAccount {
  public:
    // `given`: of the device; that of the current context, but for tests.
    explicit ProgramAccount(gl::Given given = gl::givenOf) : given_(std::move(given)) {}

    // Those of what the renderer was built for last, without a frame. What its textures held is
    // gone.
    void add(Renderer& renderer);

    // Different ones, so far.
    [[nodiscard]] std::size_t count() const { return known_.size(); }
    // A sentence a program that does not compile here or takes more than the device gives, with its
    // files and the first pass that asks for it.
    [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

    // "all 31 programs of WHAT fit this device", or a line for each that does not.
    [[nodiscard]] std::string text(const std::string& what) const;

  private:
    gl::Given given_;
    std::set<gl::ProgramKey> known_;
    std::vector<std::string> problems_;
};

}  // namespace kaustik::run
