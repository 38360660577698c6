// SPDX-License-Identifier: MIT
// Loops of the graph: passes that run again for as long as the device says so.
#include <gtest/gtest.h>

#include <set>

#include "tests/unit/graph/fake_passes.h"

namespace kaustik::graph {
namespace {

using namespace test;

// start -> [ step -> (work) -> count ] -> end: what a loop hands on nobody shares, and what its
// runs do not change is made once.
TEST(Loop, KeepsWhatItHandsOnAndMakesOnceWhatDoesNotChange) {
    Graph graph;
    struct Data {
        Buffer<Element> buffer;
    };
    const auto start = graph.addPass<Data, FakeContext>(
        {"s.start", ""},
        [](PassSetup& setup, Data& data) {
            data.buffer = setup.createBuffer<Element>("counter", 1);
        },
        [](const Data&, FakeContext&) {});
    const auto before = filter(graph, "s.before", {});
    graph.beginLoop();
    const auto fixed = filter(graph, "s.fixed", before);
    const auto step = graph.addPass<Data, FakeContext>(
        {"s.step", ""},
        [&](PassSetup& setup, Data& data) {
            setup.read(fixed);
            data.buffer = setup.write(start.buffer);
        },
        [](const Data&, FakeContext&) {});
    struct Work {
        Texture<Color> image;
    };
    const auto work = graph.addPass<Work, FakeContext>(
        {"s.work", ""},
        [&](PassSetup& setup, Work& data) {
            setup.read(step.buffer);
            data.image = setup.create<Color>("work", 8, 8);
        },
        [](const Work&, FakeContext&) {});
    const auto sum = filter(graph, "s.sum", work.image);
    const auto count = graph.addPass<Data, FakeContext>(
        {"s.count", ""},
        [&](PassSetup& setup, Data& data) { data.buffer = setup.write(step.buffer); },
        [](const Data&, FakeContext&) {});
    graph.endLoop(count.buffer, 2);
    const auto end = filter(graph, "s.end", sum);
    graph.request(end);
    const Compiled compiled = graph.compile();
    // Nothing reads what s.count writes but the loop itself.
    ASSERT_EQ(compiled.steps.size(), 8u);
    ASSERT_EQ(compiled.loops.size(), 1u);
    const Loop& loop = compiled.loops.front();
    EXPECT_EQ(compiled.steps[loop.first].name, "s.fixed");
    EXPECT_EQ(compiled.steps[loop.last].name, "s.count");
    EXPECT_EQ(loop.slot, compiled.slotOf(start.buffer));
    EXPECT_EQ(loop.word, 2u);
    EXPECT_EQ(loop.invariant, (std::set<std::size_t>{loop.first}));
    // What is made before, once, or read after the loop lives as long as all of it; what one run
    // alone needs does not. All four would fit into two otherwise.
    const std::set<std::size_t> slots{compiled.slotOf(before), compiled.slotOf(fixed),
                                      compiled.slotOf(work.image), compiled.slotOf(sum)};
    EXPECT_EQ(slots.size(), 4u);
    EXPECT_TRUE(slots.contains(compiled.slotOf(end)));
}

TEST(Loop, ThatNobodyNeedsIsCulledWhole) {
    Graph graph;
    const auto kept = filter(graph, "s.kept", {});
    graph.beginLoop();
    struct Data {
        Buffer<Element> buffer;
    };
    const auto count = graph.addPass<Data, FakeContext>(
        {"s.count", ""},
        [](PassSetup& setup, Data& data) { data.buffer = setup.createBuffer<Element>("n", 1); },
        [](const Data&, FakeContext&) {});
    graph.endLoop(count.buffer);
    graph.request(kept);
    const Compiled compiled = graph.compile();
    EXPECT_EQ(compiled.steps.size(), 1u);
    EXPECT_TRUE(compiled.loops.empty());
}

TEST(Loop, ThatAsksWhatNoneOfItsPassesWritesIsAProblem) {
    Graph graph;
    const auto image = filter(graph, "s.a", {});
    graph.beginLoop();
    const auto other = filter(graph, "s.b", {});
    graph.endLoop(image);
    graph.endLoop(other);
    graph.request(other);
    const std::string problems = problemsOf(graph);
    EXPECT_TRUE(contains(problems, "'s.a.out' whether to go on, which none of its passes writes"));
    EXPECT_TRUE(contains(problems, "a loop ends that has not begun"));
}

}  // namespace
}  // namespace kaustik::graph
