// SPDX-License-Identifier: MIT
// The framework's own files but for the shaders, of which there are copies to be edited.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/core/files.h"

namespace kaustik::test {

class ShaderCopies {
  public:
    explicit ShaderCopies(std::filesystem::path root) : root_(std::move(root)) {
        namespace fs = std::filesystem;
        fs::create_directories(root_);
        for (const auto& entry : fs::directory_iterator(projectRoot())) {
            if (entry.path().filename() != "shaders")
                fs::create_symlink(entry.path(), root_ / entry.path().filename());
        }
        fs::copy(projectRoot() / "shaders", root_ / "shaders", fs::copy_options::recursive);
    }
    // Of a program that is to read these.
    [[nodiscard]] std::map<std::string, std::string> environment() const {
        return {{"KAUSTIK_ROOT", root_.string()}};
    }
    // `name` is below shaders/.
    [[nodiscard]] std::string read(const std::string& name) const {
        return readFile(root_ / "shaders" / name);
    }
    void write(const std::string& name, const std::string& text) const {
        writeFileWhole(root_ / "shaders" / name, text);
    }

  private:
    std::filesystem::path root_;
};

}  // namespace kaustik::test
