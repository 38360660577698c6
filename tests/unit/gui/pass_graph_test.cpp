// SPDX-License-Identifier: MIT
// How passes are laid out, and what flows between them.
#include "framework/gui/pass_graph.h"

#include <gtest/gtest.h>

namespace kaustik::gui::test {
namespace {

using graph::PassRecord;
using graph::PassState;
using Names = std::vector<std::string>;

PassRecord pass(const std::string& name, Names reads, Names writes,
                PassState state = PassState::ran) {
    return {name, state, "", 1, "", std::move(reads), std::move(writes)};
}

//  eye.a ─ depth ─▶ trace.b ─ hits ─▶ gather.d        eye.c (culled) reads depth
const std::vector<PassRecord>& passes() {
    static const std::vector<PassRecord> all = {
        pass("eye.a", {}, {"depth"}),
        pass("eye.c", {"depth"}, {"hits"}, PassState::culled),
        pass("trace.b", {"depth"}, {"hits"}),
        pass("media.lines", {}, {}, PassState::skipped),
        pass("gather.d", {"hits", "depth"}, {"sum"}),
        pass("gather.e", {}, {"sum"})};
    return all;
}

TEST(PassGraph, HasStagesInColumnsInTheOrderInWhichTheyCome) {
    const PassGraph graph = passGraphOf(passes());
    EXPECT_EQ(graph.columns, (Names{"eye", "trace", "gather"})) << "what is skipped has none";
    ASSERT_EQ(graph.nodes.size(), 5u);
    EXPECT_EQ(graph.rows, 2u);
    EXPECT_EQ(graph.nodes[1].column, 0u);
    EXPECT_EQ(graph.nodes[1].row, 1u) << "below eye.a";
    EXPECT_EQ(graph.nodes[3].record, 4u);
    EXPECT_EQ(graph.nodes[3].column, 2u);
}

TEST(PassGraph, LeadsFromWhoHasWrittenLastToWhoReadsOrWritesOn) {
    const PassGraph graph = passGraphOf(passes());
    const auto edge = [&](const std::string& from, const std::string& to) -> Names {
        for (const PassGraph::Edge& one : graph.edges) {
            if (passes()[graph.nodes[one.from].record].name == from &&
                passes()[graph.nodes[one.to].record].name == to)
                return one.resources;
        }
        return {};
    };
    EXPECT_EQ(edge("eye.a", "trace.b"), Names{"depth"});
    EXPECT_EQ(edge("trace.b", "gather.d"), Names{"hits"}) << "not from the culled pass";
    EXPECT_EQ(edge("eye.c", "gather.d"), Names{});
    EXPECT_EQ(edge("eye.a", "eye.c"), Names{"depth"});
    EXPECT_EQ(edge("gather.d", "gather.e"), Names{"sum"}) << "it adds to what is there";
    for (const PassGraph::Edge& one : graph.edges)
        EXPECT_LT(one.from, one.to);
}

TEST(PassGraph, NamesWhoWritesAndReadsAResource) {
    EXPECT_EQ(writersOf(passes(), "sum"), (Names{"gather.d", "gather.e"}));
    EXPECT_EQ(writersOf(passes(), "hits"), Names{"trace.b"}) << "the culled one writes nothing";
    EXPECT_EQ(readersOf(passes(), "depth"), (Names{"trace.b", "gather.d"}));
    EXPECT_EQ(resourcesOf(pass("s.a", {"x", "y"}, {"y", "z"})), (Names{"x", "y", "z"}));
}

}  // namespace
}  // namespace kaustik::gui::test
