// SPDX-License-Identifier: MIT
// What each account of the energy ledger holds, a sentence for people; framework/README.md, "The
// energy ledger", says it at length.
#pragma once

namespace kaustik {

// `account`: one of kAccount…; "" for those that are shown by none.
[[nodiscard]] const char* accountSentence(unsigned account);

}  // namespace kaustik
