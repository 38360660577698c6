// SPDX-License-Identifier: MIT
// One row a run: runs.csv.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "framework/experiment/plan.h"

namespace kaustik::experiment {

// Columns in their order; numbers, texts and, for an empty cell, null.
using Row = std::vector<std::pair<std::string, nlohmann::json>>;

// folder, hash, repeat, status ("done" or "failed"), message.
[[nodiscard]] Row identityColumns(const PlannedRun& run, int repeat, const std::string& message);

// frame_ms.median …, startup_ms, pass:NAME (median, ms), and every number below photons, layers,
// hits, error, energy and memory by its dotted name; warnings (how many), device, cpu, threads and
// version. What the report lacks has no column.
[[nodiscard]] Row resultColumns(const nlohmann::json& report);

// RFC 4180. The columns of all rows: one that only some have stands after the one that it follows
// there.
[[nodiscard]] std::string toCsv(const std::vector<Row>& rows);

}  // namespace kaustik::experiment
