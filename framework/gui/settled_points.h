// SPDX-License-Identifier: MIT
// The settings of a session that have settled and been judged, each a point of time and error, and
// which of them no other one beats in both. Knows no window.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/gui/frame_result.h"
#include "framework/gui/reference_worker.h"

namespace kaustik::gui {

struct SettledPoint {
    Document document;  // its own settings as A
    bool isPrecise = false;
    double frameMs = 0.0;       // median
    nlohmann::json errors;      // of the caustic irradiance, by the report's keys
    std::uint64_t photons = 0;  // of the reference
    std::string reference;      // noteOf() of it
    // None where it was not judged by this measure.
    [[nodiscard]] std::optional<double> error(const std::string& measure) const;
};

// What there is of a variant of the frame; none before it is settled and judged.
[[nodiscard]] std::optional<SettledPoint> settledPoint(const FrameResult& result,
                                                       std::size_t variant,
                                                       const ReferenceState& reference,
                                                       bool isPrecise);

inline constexpr std::size_t kMaxPoints = 500;

// In the place of one of the same settings, where there is one; else the oldest makes room.
void addPoint(std::vector<SettledPoint>& points, SettledPoint point);

// Whether times and errors of both say something of each other: the same scene, view and size, the
// same way of timing and as good a reference.
[[nodiscard]] bool areComparable(const SettledPoint& a, const SettledPoint& b);

struct TimeAndError {
    double milliseconds = 0.0;
    double error = 0.0;
};

// Indices of those that none is at least as good as in both and better in one, by rising time. Of
// equal ones the first.
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<TimeAndError>& points);

}  // namespace kaustik::gui
