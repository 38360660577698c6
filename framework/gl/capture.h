// SPDX-License-Identifier: MIT
// Frames for RenderDoc, where it has been loaded into this program ("renderdoccmd capture kaustik
// run … --capture"). Nothing here needs it to build or to run.
#pragma once

#include <filesystem>
#include <functional>

namespace kaustik::gl {

// Throws ConfigError that says how to load it where RenderDoc is not there.
void requireRenderDoc();

// Has RenderDoc capture all commands that `frame` issues, as frame_capture.rdc or the like in
// `folder`; gives the file. The context must be current. Throws IoError where RenderDoc wrote none.
[[nodiscard]] std::filesystem::path captureFrame(const std::filesystem::path& folder,
                                                 const std::function<void()>& frame);

}  // namespace kaustik::gl
