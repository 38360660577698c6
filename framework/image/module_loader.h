// SPDX-License-Identifier: MIT
// Loads a module for images at its first use, so that a start that touches no EXR or PNG does not
// pay for the hundreds of shared libraries that OpenImageIO brings.
#pragma once

#include <filesystem>
#include <string>

#include "framework/image/module_interface.h"

namespace kaustik {

struct ImageModule {
    const KaustikImageFunctions* functions = nullptr;  // null: not to be had
    std::string problem;  // why `functions` is null and what to do; "" otherwise
};

// Loads `file`; it stays loaded until the program ends. Never throws for a missing or broken
// module.
[[nodiscard]] ImageModule loadImageModule(const std::filesystem::path& file);

// The first of the modules next to the executable that can be loaded, loaded once: OpenImageIO's,
// which knows the more formats, or the one that brings its own EXR and PNG.
[[nodiscard]] const ImageModule& imageModule();

}  // namespace kaustik
