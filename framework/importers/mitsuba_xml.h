// SPDX-License-Identifier: MIT
// One XML file by pugixml as a tree of elements with their lines. Nothing of a document type is
// taken: entities of its own are how a few lines of XML become gigabytes.
#pragma once

#include <filesystem>

#include "framework/importers/mitsuba_document.h"

namespace kaustik::scene {

// The file's element, with nothing included and nothing replaced. Throws ConfigError "file:line: …"
// for what is no XML or nested too deep, and IoError for a file that cannot be read.
[[nodiscard]] MitsubaElement readXml(const std::filesystem::path& file);

}  // namespace kaustik::scene
