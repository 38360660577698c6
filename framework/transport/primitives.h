// SPDX-License-Identifier: MIT
// By what a reconstruction gives pixels light, where it has several ways: sums next to the accounts
// in the ledger's buffer, and in its units. They are parts of what is deposited, and in no balance.
// C++ and GLSL both read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::transport {
#endif

const uint kSumTriangles = kAccountCount;   // between photons that are joined
const uint kSumBeams = kAccountCount + 1u;  // of photons that are not, by what they cover alone
const uint kLedgerEntryCount = kAccountCount + 2u;

#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
