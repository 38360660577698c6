// SPDX-License-Identifier: MIT
// Of every sum of watts in fixed point: the ledger's and the maps'.
uniform float ledgerUnitsPerWatt;
