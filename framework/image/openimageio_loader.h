// SPDX-License-Identifier: MIT
// Loads the OpenImageIO module at its first use, so that a start that touches no EXR or PNG does
// not pay for the hundreds of shared libraries that OpenImageIO brings.
#pragma once

#include <filesystem>
#include <string>

#include "framework/image/openimageio_interface.h"

namespace kaustik {

struct OpenImageIoModule {
    const KaustikOpenImageIoFunctions* functions = nullptr;  // null: not to be had
    std::string problem;  // why `functions` is null and what to do; "" otherwise
};

// Loads `file`; it stays loaded until the program ends. Never throws for a missing or broken
// module.
[[nodiscard]] OpenImageIoModule loadOpenImageIoModule(const std::filesystem::path& file);

// The module next to the executable, loaded once.
[[nodiscard]] const OpenImageIoModule& openImageIo();

}  // namespace kaustik
