// SPDX-License-Identifier: MIT
// The table of the hard cases, for programs (CSV, JSON), for reading (Markdown) and for a terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/numerics/suite.h"

namespace kaustik::numerics {

// What was run, and what it gave.
struct Table {
    std::vector<Case> cases;
    std::vector<Row> rows;
    std::string device;
};

// case,subject,what,expected,measured,tolerance,verdict,reason; a number that is none is empty.
[[nodiscard]] std::string makeCsv(const Table& table);
// "schema": "kaustik.numerics/1"; a number that is none is null, and its verdict says fail.
[[nodiscard]] nlohmann::json makeJson(const Table& table);
[[nodiscard]] std::string makeMarkdown(const Table& table);
[[nodiscard]] std::string makeText(const Table& table);

[[nodiscard]] std::size_t countFailures(const Table& table);

}  // namespace kaustik::numerics
