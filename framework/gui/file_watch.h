// SPDX-License-Identifier: MIT
// Whether files below some folders have been written since one last looked.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace kaustik::gui {

class FileWatch {
  public:
    explicit FileWatch(std::vector<std::filesystem::path> folders)
        : folders_(std::move(folders)), known_(look()) {}

    // True once for every change: a file that is new, gone, or has another time.
    [[nodiscard]] bool hasChanged();

  private:
    using Times = std::map<std::string, std::filesystem::file_time_type>;
    [[nodiscard]] Times look() const;

    std::vector<std::filesystem::path> folders_;
    Times known_;
};

}  // namespace kaustik::gui
