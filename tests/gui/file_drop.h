// SPDX-License-Identifier: MIT
// What a file manager does while files are dragged from it and dropped: the source's part of
// XDND, version 5 (https://www.freedesktop.org/wiki/Specifications/XDND).
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

struct _XDisplay;

namespace kaustik::test {

// The files as text/uri-list (RFC 2483): a line each, absolute, all but plain letters in %XX.
[[nodiscard]] std::string uriList(const std::vector<std::filesystem::path>& files);

// Drops them onto the window at that place of the root window. Throws std::runtime_error when there
// is none that takes files, or when it hasn't finished within `limit`.
void dropFiles(_XDisplay* display, const std::vector<std::filesystem::path>& files, int x, int y,
               std::chrono::milliseconds limit);

}  // namespace kaustik::test
