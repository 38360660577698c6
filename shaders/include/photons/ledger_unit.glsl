// SPDX-License-Identifier: MIT
// Of every sum of watts in fixed point: the ledger's and the maps'.
uniform float ledgerUnitsPerWatt;

// As two words, low and high. A float has 24 bits, so that both halves are exact.
uvec2 unitsOfWatts(float watts) {
    float units = floor(watts * ledgerUnitsPerWatt);
    float high = floor(units * (1.0 / 4294967296.0));
    return uvec2(uint(units - high * 4294967296.0), uint(high));
}

// Photons that another batch brings as well have flux that no sum resolves (emit/grid.comp), and
// count there.
bool isOfOtherBatch(float watts) {
    return watts > 0.0 && watts * ledgerUnitsPerWatt < 0.25;
}
