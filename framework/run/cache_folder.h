// SPDX-License-Identifier: MIT
// Where what takes long to make is kept: references, censuses, certificates.
#pragma once

#include <filesystem>

namespace kaustik::run {

// $KAUSTIK_CACHE, else $XDG_CACHE_HOME/kaustik, else ~/.cache/kaustik. Throws IoError where there
// is none of them.
[[nodiscard]] std::filesystem::path cacheFolder();

}  // namespace kaustik::run
