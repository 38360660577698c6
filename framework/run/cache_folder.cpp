// SPDX-License-Identifier: MIT
#include "framework/run/cache_folder.h"

#include <cstdlib>

#include "framework/core/error.h"

namespace kaustik::run {

namespace fs = std::filesystem;

fs::path cacheFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr ? fs::path(value) : fs::path();
    };
    if (const fs::path own = variable("KAUSTIK_CACHE"); !own.empty()) return own;
    if (const fs::path xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) return xdg / "kaustik";
    if (const fs::path home = variable("HOME"); !home.empty()) return home / ".cache/kaustik";
    throw IoError(
        "There is no folder to keep references in; set KAUSTIK_CACHE to one that can be written.");
}

}  // namespace kaustik::run
