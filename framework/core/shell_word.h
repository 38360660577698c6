// SPDX-License-Identifier: MIT
// Words of a command line that is offered for a shell.
#pragma once

#include <string>
#include <string_view>

namespace kaustik {

// `text` as one word of a POSIX shell: as it is where no sign of it means anything there, else in
// single quotes.
[[nodiscard]] std::string shellWord(std::string_view text);

}  // namespace kaustik
