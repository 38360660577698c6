// SPDX-License-Identifier: MIT
// Sums next to the accounts in the ledger's buffer, and in its units; they are in no balance. By
// what a reconstruction gives pixels light, where it has several ways: parts of what is deposited.
// And by how much a map holds more, or less, than the flux that was deposited: a pixel that shows
// several surfaces has the mean of their irradiances over its area, times the area of the one at
// its middle. C++ and GLSL both read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::transport {
#endif

const uint kSumTriangles = kAccountCount;   // between photons that are joined
const uint kSumBeams = kAccountCount + 1u;  // of photons that are not, by what they cover alone
const uint kSumMapExcess = kAccountCount + 2u;
const uint kSumMapDeficit = kAccountCount + 3u;
const uint kLedgerEntryCount = kAccountCount + 4u;

#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
