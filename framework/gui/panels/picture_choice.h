// SPDX-License-Identifier: MIT
// A scene or a technique chosen by its picture, in a window over the workbench.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/gui/bench.h"

namespace kaustik::gui {

struct PictureOption {
    std::string name;
    std::string sentence;
    ThumbnailSubject subject;
};

// A button that opens it, and the index of the one that was chosen. `name` is the button's in the
// screen map; a picture is called NAME=ITS NAME there, and its value is how far it is. `current`
// has a frame.
[[nodiscard]] std::optional<std::size_t> chooseByPicture(Bench& bench, const std::string& name,
                                                         const std::string& title,
                                                         const std::vector<PictureOption>& options,
                                                         const std::string& current);

}  // namespace kaustik::gui
