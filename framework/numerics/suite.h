// SPDX-License-Identifier: MIT
// The hard cases as a suite: each a row of framework/numerics/README.md, "The cases", with
// functions that measure. Common cases (framework/numerics/cases) ask the registry for the nodes
// that answer a stage, so that a new tracer joins by being registered; a technique adds cases of
// its own nodes to the suite (techniques/register_hard_cases.cpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace kaustik::numerics {

class Lab;

// What a measured number is held to: within the tolerance of what is expected, or no further than
// that below or above it.
enum class Bound { near, atLeast, atMost };

// One measured number next to what it must be.
struct Row {
    std::string caseId;
    std::string subject;  // the node or the shader file that was measured
    std::string what;
    double expected = 0.0;  // in double precision, independent of the code under test
    double measured = 0.0;
    double tolerance = 0.0;  // largest |measured - expected|, where it is bounded
    std::string reason;      // why the tolerance, or the bound, is what it is
    Bound bound = Bound::near;
    [[nodiscard]] bool passes() const;  // what is not a number never does
    // "12", "at least 12", "at most 12".
    [[nodiscard]] std::string expectedText() const;
};

struct Case {
    std::string
        id;  // "A5", "C28a"; those of section E, which has no numbers, are words: "E.lacking"
    std::string sentence;
    std::vector<std::function<void(Lab&)>> measure;
};

class Suite {
  public:
    // Adds measurements to a case; whoever comes first gives it its sentence.
    void add(const std::string& id, const std::string& sentence, std::function<void(Lab&)> measure);
    // Textures of such names may hold what was not written: memory that is only read where it was.
    // All others are scanned for what is not a number.
    void allowUnwritten(const std::string& namePrefix) { unwritten_.push_back(namePrefix); }

    // The cases in the order of section, number and letter.
    [[nodiscard]] const std::vector<Case>& cases() const { return cases_; }
    [[nodiscard]] bool mayBeUnwritten(const std::string& name) const;

  private:
    std::vector<Case> cases_;
    std::vector<std::string> unwritten_;
};

// The cases that all nodes of a stage share.
[[nodiscard]] Suite commonCases();

// The cases that any of the patterns names: "A5", "B*". Throws ConfigError, with the nearest that
// exists, for one that names none.
[[nodiscard]] std::vector<Case> selectCases(const Suite& suite,
                                            const std::vector<std::string>& patterns);

}  // namespace kaustik::numerics
