// SPDX-License-Identifier: MIT
// The files that an imported scene names: where they lie, or copies of them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "framework/reading/reader_process.h"
#include "framework/scene/foreign/foreign_meshes.h"

namespace kaustik::scene {

class ForeignFiles {
  public:
    explicit ForeignFiles(const std::filesystem::path& sceneFile);

    // How the scene file names them, each relative to its folder: as they lie where that is below
    // it, else as a copy. A mesh is read before it is copied, and a picture must be called one: a
    // scene of somebody else's is to copy nothing but these.
    [[nodiscard]] std::string mesh(const std::filesystem::path& file,
                                   reading::ReaderProcess& reader);
    [[nodiscard]] std::string picture(const std::filesystem::path& file, const std::string& place);
    // A mesh that is written as PLY, under a name like this.
    [[nodiscard]] std::string baked(const std::string& name, const WorldMesh& mesh,
                                    const glm::dvec3& origin);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::size_t count() const { return names_.size(); }

  private:
    [[nodiscard]] std::string placeBelow(const std::filesystem::path& file) const;
    [[nodiscard]] std::string copy(const std::filesystem::path& file);
    [[nodiscard]] std::string freeName(const std::string& stem, const std::string& extension);

    std::filesystem::path sceneFolder_;
    std::filesystem::path folder_;               // scene_meshes
    std::set<std::string> names_;                // of files in it
    std::map<std::string, std::string> copies_;  // by source
};

}  // namespace kaustik::scene
