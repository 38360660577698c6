// SPDX-License-Identifier: MIT
// In a file of its own, since the fuzz targets say that it is they.
#include "framework/core/files.h"
#include "framework/reading/reader_process.h"

namespace kaustik::reading {

std::filesystem::path ReaderProcess::defaultProgram() {
    return helperFolder() / "kaustik_reader";
}

}  // namespace kaustik::reading
