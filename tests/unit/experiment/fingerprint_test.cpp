// SPDX-License-Identifier: MIT
#include "framework/experiment/fingerprint.h"

#include <gtest/gtest.h>

#include <set>

namespace kaustik::experiment {
namespace {

TEST(Fingerprint, IsFnv1aWith128Bits) {
    // Of the offset basis, and of the published test vectors.
    EXPECT_EQ(fingerprint(""), "6c62272e07bb014262b821756295c58d");
    EXPECT_EQ(fingerprint("a"), "d228cb696f1a8caf78912b704e4a8964");
    EXPECT_EQ(fingerprint("foobar"), "343e1662793c64bf6f0d3597ba446f18");
}

TEST(Fingerprint, TellsTextsApartThatDifferInOneByte) {
    std::set<std::string> seen;
    for (int byte = 0; byte < 256; ++byte)
        seen.insert(fingerprint("trace.epsilon=" + std::string(1, static_cast<char>(byte))));
    EXPECT_EQ(seen.size(), 256u);
}

}  // namespace
}  // namespace kaustik::experiment
