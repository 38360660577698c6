// SPDX-License-Identifier: MIT
// The tables of the panels as text and CSV, with what they are of.
#pragma once

#include <string>
#include <vector>

#include "framework/gui/frame_result.h"
#include "framework/gui/reference_worker.h"

namespace kaustik::gui {

struct Table {
    std::vector<std::string> columns;  // with units
    std::vector<std::vector<std::string>> rows;
};

// Columns in line, for a message or a notebook.
[[nodiscard]] std::string toText(const Table& table);
// RFC 4180: commas, CRLF, and quotes around what has either or quotes.
[[nodiscard]] std::string toCsv(const Table& table);

// Of every pass whether it ran and why, and what it took: the median without the first frame, ms.
[[nodiscard]] Table passTable(const VariantResult& result);
// Of every output that is judged, by all paths and by modelled ones.
[[nodiscard]] Table errorTable(const ReferenceState& reference, std::size_t variants);
[[nodiscard]] Table ledgerTable(const EnergyLedger& ledger);

}  // namespace kaustik::gui
