// SPDX-License-Identifier: MIT
#include "framework/numerics/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/files.h"

namespace kaustik::numerics {
namespace {

const char* verdict(const Row& row) {
    return row.passes() ? "pass" : "FAIL";
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

std::string exactNumber(double value) {
    return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}

std::string shortNumber(double value) {
    return fmt::format("{:.7g}", value);
}

// With its bound: the columns of numbers hold numbers alone.
std::string quantityOf(const Row& row) {
    if (row.bound == Bound::near) return row.what;
    return row.what + (row.bound == Bound::atLeast ? ", at least" : ", at most");
}

nlohmann::json jsonNumber(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

std::string summary(const Table& table) {
    const std::size_t failures = countFailures(table);
    return fmt::format("{} cases, {} rows: {}", table.cases.size(), table.rows.size(),
                       failures == 0 ? "all pass" : fmt::format("{} FAIL", failures));
}

}  // namespace

std::size_t countFailures(const Table& table) {
    return static_cast<std::size_t>(std::count_if(table.rows.begin(), table.rows.end(),
                                                  [](const Row& row) { return !row.passes(); }));
}

std::string makeCsv(const Table& table) {
    std::string text = "case,subject,what,expected,measured,tolerance,verdict,reason\n";
    for (const Row& row : table.rows) {
        text += fmt::format("{},{},{},{},{},{},{},{}\n", row.caseId, quoted(row.subject),
                            quoted(quantityOf(row)), exactNumber(row.expected),
                            exactNumber(row.measured), exactNumber(row.tolerance), verdict(row),
                            quoted(row.reason));
    }
    return text;
}

nlohmann::json makeJson(const Table& table) {
    nlohmann::json json = {{"schema", "kaustik.numerics/1"},
                           {"version", versionString()},
                           {"device", table.device},
                           {"failures", countFailures(table)}};
    json["cases"] = nlohmann::json::array();
    for (const Case& c : table.cases) {
        nlohmann::json rows = nlohmann::json::array();
        for (const Row& row : table.rows) {
            if (row.caseId != c.id) continue;
            rows.push_back({{"subject", row.subject},
                            {"what", quantityOf(row)},
                            {"expected", jsonNumber(row.expected)},
                            {"measured", jsonNumber(row.measured)},
                            {"tolerance", jsonNumber(row.tolerance)},
                            {"verdict", row.passes() ? "pass" : "fail"},
                            {"reason", row.reason}});
        }
        json["cases"].push_back({{"case", c.id}, {"sentence", c.sentence}, {"rows", rows}});
    }
    return json;
}

std::string makeMarkdown(const Table& table) {
    std::string text = fmt::format("# Hard cases\n\n{}. On {}.\n", summary(table), table.device);
    for (const Case& c : table.cases) {
        text += fmt::format("\n## {}\n\n{}\n\n", c.id, c.sentence);
        text +=
            "| subject | what | expected | measured | tolerance | verdict | why this tolerance "
            "|\n| --- | --- | --- | --- | --- | --- | --- |\n";
        for (const Row& row : table.rows) {
            if (row.caseId != c.id) continue;
            text +=
                fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", row.subject, quantityOf(row),
                            shortNumber(row.expected), shortNumber(row.measured),
                            shortNumber(row.tolerance), verdict(row), row.reason);
        }
    }
    return text;
}

std::string makeText(const Table& table) {
    std::size_t subjectWidth = 7;
    std::size_t whatWidth = 4;
    for (const Row& row : table.rows) {
        subjectWidth = std::max(subjectWidth, row.subject.size());
        whatWidth = std::max(whatWidth, quantityOf(row).size());
    }
    const auto line = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:<{}}  {:>13}  {:>13}  {:>10}  {}\n", cells...);
    };
    std::string text;
    for (const Case& c : table.cases) {
        text += fmt::format("{}  {}\n", c.id, c.sentence);
        text += "  " + line("subject", subjectWidth, "what", whatWidth, "expected", "measured",
                            "tolerance", "");
        for (const Row& row : table.rows) {
            if (row.caseId != c.id) continue;
            text += "  " + line(row.subject, subjectWidth, quantityOf(row), whatWidth,
                                shortNumber(row.expected), shortNumber(row.measured),
                                fmt::format("{:.3g}", row.tolerance), verdict(row));
        }
    }
    return text + summary(table) + "\n";
}

}  // namespace kaustik::numerics
