// SPDX-License-Identifier: MIT
// A folder of its own for a test that loads scene files, and a small mesh for those that need one.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <optional>
#include <string>

#include "framework/core/files.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::scene::test {

// A tetrahedron with its longest side along y: 1 x 2 x 1.
inline constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class SceneFile : public testing::Test {
  protected:
    SceneFile() {
        std::string pattern = (std::filesystem::temp_directory_path() / "kaustik-XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
        if (const char* before = ::getenv("KAUSTIK_MESHES")) meshesBefore_ = before;
        ::unsetenv("KAUSTIK_MESHES");
    }
    ~SceneFile() override {
        std::filesystem::remove_all(folder);
        if (meshesBefore_) ::setenv("KAUSTIK_MESHES", meshesBefore_->c_str(), 1);
    }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        writeFileWhole(folder / name, text);
        return folder / name;
    }
    Scene load(const std::string& text) const { return loadSceneFile(write("scene.toml", text)); }

    // The message of the ConfigError or IoError that loading ends with; "" when there is none.
    template <class Expected>
    std::string messageOf(const std::string& text) const {
        try {
            (void)load(text);
        } catch (const Expected& error) {
            return error.what();
        }
        return "";
    }

    std::filesystem::path folder;

  private:
    std::optional<std::string> meshesBefore_;
};

}  // namespace kaustik::scene::test
