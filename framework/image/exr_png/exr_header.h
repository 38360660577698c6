// SPDX-License-Identifier: MIT
// What an OpenEXR file's header claims, looked at before OpenEXR is asked to read it.
#pragma once

#include <string_view>

namespace kaustik {

// OpenEXR makes room for as much as an attribute says it has, up to 2 GiB, before it reads. Throws
// std::runtime_error, with the end of a sentence that begins with the file's name, where one has
// more than the file, or another size than its type. By OpenEXR's "File Layout".
void requireWholeAttributes(std::string_view bytes);

}  // namespace kaustik
