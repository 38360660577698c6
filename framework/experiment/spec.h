// SPDX-License-Identifier: MIT
// An experiment as its TOML file states it, before anything is resolved:
//
//   name = "epsilon"              names the folder of results: letters, digits, '-' and '_'
//   description = ""              for the report
//   repeats = 1                   each a process of its own, so that their spread is real
//   [base]                        what all runs share; see setting.h for the keys
//   scene = "pool"
//   "trace.lines.width" = 512     a dotted name in quotes, or as a table: trace.epsilon = 0.01
//   [permute]                     every combination of one value from each key
//   trace = ["lines", "march"]
//   "trace.epsilon" = {from = 0.001, to = 0.1, factor = 10}
//
// A range is written in one line, ends included: {from, to, factor} multiplies, {from, to, step}
// adds, {from, to, steps} gives that many values at equal distances. Where there are several
// [[permute]] tables each is a cross product of its own; what two of them share is run once.
//
// Instead of repeats, [base] and [permute] there may be
//
//   suite = "numerics"            the hard cases (framework/numerics), measured in one process
//   cases = ["A*", "B13"]         only these; all without the key
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/experiment/setting.h"

namespace kaustik::experiment {

// A key with all the values that it is to take, in order; at least one.
struct Axis {
    std::string key;
    std::vector<Setting> values;
    std::string place;
};

// One cross product: the last axis varies fastest.
using Product = std::vector<Axis>;

struct Spec {
    std::filesystem::path file;
    std::string name;
    std::string description;
    std::string suite;               // "" or "numerics"
    std::vector<std::string> cases;  // of the suite; empty: all
    std::string casesPlace;          // "file:line"
    int repeats = 1;
    std::vector<Setting> base;
    std::vector<Product> products;  // at least one; without axes it is the base alone
};

inline constexpr int kMaxRepeats = 1000;

// Throws ConfigError "file:line: …" for whatever makes no sense, and IoError for a file that cannot
// be read.
[[nodiscard]] Spec readSpec(const std::filesystem::path& file);

}  // namespace kaustik::experiment
