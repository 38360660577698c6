// SPDX-License-Identifier: MIT
// Every hard case of the suite as a test of its own.
#include <gtest/gtest.h>

#include <memory>

#include "framework/numerics/lab.h"
#include "techniques/register_all.h"
#include "techniques/register_hard_cases.h"

namespace kaustik::numerics {
namespace {

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

const Suite& suite() {
    static const Suite instance = [] {
        Suite all = commonCases();
        registerHardCases(all);
        return all;
    }();
    return instance;
}

class HardCase : public testing::TestWithParam<Case> {};

TEST_P(HardCase, MeasuresWhatIsRight) {
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(true);
    Lab lab(*context, registry(), suite());
    const std::vector<Row> rows = lab.run(GetParam());
    EXPECT_FALSE(rows.empty());
    for (const Row& row : rows) {
        EXPECT_TRUE(row.passes()) << row.subject << ": " << row.what << " should be "
                                  << row.expectedText() << " within " << row.tolerance << " and is "
                                  << row.measured << " (" << row.reason << ")";
    }
}

INSTANTIATE_TEST_SUITE_P(Suite, HardCase, testing::ValuesIn(suite().cases()),
                         [](const auto& tested) {
                             std::string name = tested.param.id;
                             for (char& c : name)
                                 c = c == '.' ? '_' : c;
                             return name;
                         });

}  // namespace

// What GoogleTest prints a parameter as.
void PrintTo(const Case& hardCase, std::ostream* out) {
    *out << hardCase.id << ": " << hardCase.sentence;
}

}  // namespace kaustik::numerics
