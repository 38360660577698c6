// SPDX-License-Identifier: MIT
// A short name for a long text that is the same on every machine: FNV-1a with 128 bits (Fowler,
// Noll and Vo). Not for secrets: it tells settings apart, it does not resist forgery.
#pragma once

#include <string>
#include <string_view>

namespace kaustik::experiment {

// 32 lower-case hexadecimal digits.
[[nodiscard]] std::string fingerprint(std::string_view bytes);

}  // namespace kaustik::experiment
