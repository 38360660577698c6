// SPDX-License-Identifier: MIT
// Whether files below a folder have been written since one last looked.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace kaustik::gui {

class FileWatch {
  public:
    explicit FileWatch(std::filesystem::path folder) : folder_(std::move(folder)), known_(look()) {}

    // True once for every change: a file that is new, gone, or has another time.
    [[nodiscard]] bool hasChanged();

  private:
    using Times = std::map<std::string, std::filesystem::file_time_type>;
    [[nodiscard]] Times look() const;

    std::filesystem::path folder_;
    Times known_;
};

}  // namespace kaustik::gui
