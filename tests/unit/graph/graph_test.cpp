// SPDX-License-Identifier: MIT
// The graph without any device. The pictures in the comments are the graphs under test.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/unit/graph/fake_passes.h"

namespace kaustik::graph {
namespace {

using namespace test;

TEST(Graph, RunsPassesInOrderAndCullsWhatNothingAsksFor) {
    //  a ──▶ b ──▶ (asked for)
    //  └───▶ c          c is culled
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto b = filter(graph, "s.b", a);
    filter(graph, "s.c", a);
    graph.request(b);
    const Compiled compiled = graph.compile();
    EXPECT_EQ(run(compiled), (std::vector<std::string>{"s.a", "s.b"}));
    ASSERT_EQ(compiled.records.size(), 3u);
    EXPECT_EQ(compiled.records[2].state, PassState::culled);
    EXPECT_EQ(compiled.records[2].reason, "nothing asks for s.c.out");
    // What is culled has declared all the same what it would read and write.
    EXPECT_EQ(compiled.records[2].reads, std::vector<std::string>{"s.a.out"});
    EXPECT_EQ(compiled.records[2].writes, std::vector<std::string>{"s.c.out"});
}

TEST(Graph, KeepsAPassWithASideEffectAndAllThatLeadsToIt) {
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    graph.addPass<None, FakeContext>(
        {"s.print", ""},
        [&](PassSetup& setup, None&) {
            setup.read(a);
            setup.sideEffect();
        },
        [](const None&, FakeContext& context) { context.ran.push_back("s.print"); });
    EXPECT_EQ(run(graph.compile()), (std::vector<std::string>{"s.a", "s.print"}));
}

TEST(Graph, AStaleHandleIsAnErrorThatNamesPassAndResource) {
    //  a ──▶ image v0 ──▶ draw ──▶ image v1
    //              └──────────────────▶ late reads v0
    Graph graph;
    const auto image = filter(graph, "s.a", {});
    draw(graph, "s.draw", image);
    graph.request(filter(graph, "s.late", image));
    const std::string problems = problemsOf(graph);
    EXPECT_TRUE(contains(problems, "pass 's.late' reads version 0 of 's.a.out', which is stale"));
    EXPECT_TRUE(contains(problems, "pass 's.draw' has written version 1"));
}

// A pass that makes a texture that lasts, and one that adds `input` to it.
Texture<Color> remember(Graph& graph, Texture<Color> input) {
    const auto before = graph.addPass<Texture<Color>, FakeContext>(
        {"s.begin", ""},
        [&](PassSetup& setup, Texture<Color>& texture) {
            texture = setup.createPersistent<Color>("s.history", 8, 8);
        },
        [](const auto&, FakeContext& context) { context.ran.push_back("s.begin"); });
    graph.addPass<Texture<Color>, FakeContext>(
        {"s.end", ""},
        [&](PassSetup& setup, Texture<Color>& texture) {
            setup.read(input);
            texture = setup.write(before);
        },
        [](const auto&, FakeContext& context) { context.ran.push_back("s.end"); });
    return before;
}

TEST(Graph, GivesWhatLastsMemoryOfItsOwn) {
    //  a ──▶ b ──▶ history ──▶ c ──▶ (asked for)       all of one shape
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto b = filter(graph, "s.b", a);
    graph.request(filter(graph, "s.c", remember(graph, b)));
    const std::string problems = problemsOf(graph);
    // s.c reads the history as it was before s.end has written it.
    EXPECT_TRUE(contains(problems, "pass 's.c' reads version 0 of 's.history', which is stale"));

    Graph ordered;
    const auto first = filter(ordered, "s.a", {});
    const auto second = filter(ordered, "s.b", first);
    const auto third = filter(ordered, "s.c", second);
    remember(ordered, third);
    ordered.request(ordered.find("s.history"));
    const Compiled compiled = ordered.compile();
    std::size_t persistent = 0;
    for (const Slot& slot : compiled.slots)
        persistent += slot.isPersistent ? 1 : 0;
    EXPECT_EQ(persistent, 1u);
    const std::size_t slot = compiled.slotOf(ordered.find("s.history"));
    EXPECT_TRUE(compiled.slots[slot].isPersistent);
    for (const Step& step : compiled.steps) {
        for (const std::size_t undefinedSlot : step.undefinedSlots)
            EXPECT_NE(undefinedSlot, slot) << step.name;
    }
}

TEST(Graph, RunsWhatIsWrittenForTheNextFrame) {
    //  begin ──▶ history v0 ──▶ mean ──▶ (asked for)
    //                 └──▶ end ──▶ history v1           nobody in this frame reads v1
    Graph graph;
    const auto history = graph.addPass<Texture<Color>, FakeContext>(
        {"s.begin", ""},
        [&](PassSetup& setup, Texture<Color>& texture) {
            texture = setup.createPersistent<Color>("s.history", 8, 8);
        },
        [](const auto&, FakeContext& context) { context.ran.push_back("s.begin"); });
    graph.request(filter(graph, "s.mean", history));
    const auto input = filter(graph, "s.input", {});
    filter(graph, "s.unused", input);
    graph.addPass<Texture<Color>, FakeContext>(
        {"s.end", ""},
        [&](PassSetup& setup, Texture<Color>& texture) {
            setup.read(input);
            texture = setup.write(history);
        },
        [](const auto&, FakeContext& context) { context.ran.push_back("s.end"); });
    EXPECT_EQ(run(graph.compile()),
              (std::vector<std::string>{"s.begin", "s.mean", "s.input", "s.end"}));
}

TEST(Graph, ReportsAllProblemsTogether) {
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    filter(graph, "s.a", {});  // creates s.a.out twice
    graph.addPass<None, FakeContext>(
        {"s.lost", ""}, [&](PassSetup& setup, None&) { setup.read(Texture<Color>{}); },
        [](const None&, FakeContext&) {});
    graph.disable("s.b");  // no such pass
    graph.request(a);
    const std::string problems = problemsOf(graph);
    EXPECT_TRUE(contains(problems, "'s.a.out', which pass 's.a' has created already"));
    EXPECT_TRUE(contains(problems, "pass 's.lost' reads a handle that no pass has made"));
    EXPECT_TRUE(contains(problems, "there is no pass 's.b' to disable; did you mean 's.a'?"));
}

TEST(Graph, WhatAPassBindsItHasDeclared) {
    Graph graph;
    const Texture<Color> source = filter(graph, "source", {});
    struct Data {
        Texture<Color> made;
    };
    const Data& data = graph.addPass<Data, FakeContext>(
        {"binds", "test"},
        [&](PassSetup& setup, Data& made) {
            setup.sample("source", source);
            made.made = setup.image("made", setup.create<Color>("made", 8, 8));
        },
        [](const Data&, FakeContext&) {});
    graph.request(data.made);
    const Compiled compiled = graph.compile();
    ASSERT_EQ(compiled.steps.size(), 2u);  // the source's pass is needed
    const Step& step = compiled.steps.back();
    ASSERT_EQ(step.bindings.size(), 2u);
    EXPECT_EQ(step.bindings[0].name, "source");
    EXPECT_EQ(step.bindings[0].as, BindAs::sampler);
    EXPECT_EQ(step.bindings[1].name, "made");
    EXPECT_EQ(step.bindings[1].as, BindAs::image);
    EXPECT_EQ(step.reads.size(), 1u);  // what it makes it does not read
}

TEST(Graph, TwoResourcesOfOneNameAreAnErrorThatNamesPassAndName) {
    Graph graph;
    const Texture<Color> one = filter(graph, "one", {});
    const Texture<Color> two = filter(graph, "two", {});
    graph.addPass<None, FakeContext>(
        {"binds", "test"},
        [&](PassSetup& setup, None&) {
            setup.sample("source", one);
            setup.sample("source", two);
            setup.sideEffect();
        },
        [](const None&, FakeContext&) {});
    try {
        static_cast<void>(graph.compile());
        FAIL() << "no error";
    } catch (const GraphError& error) {
        EXPECT_NE(std::string(error.what()).find("pass 'binds' binds two resources as 'source'"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Graph, ADisabledPassForwardsItsInput) {
    //  a ──▶ [b] ──▶ c     b disabled: c reads a's memory
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto b = filter(graph, "s.b", a, true);
    const auto c = filter(graph, "s.c", b);
    graph.request(c);
    graph.disable("s.b");
    const Compiled compiled = graph.compile();
    EXPECT_EQ(run(compiled), (std::vector<std::string>{"s.a", "s.c"}));
    EXPECT_EQ(compiled.slotOf(b), compiled.slotOf(a));
    EXPECT_NE(compiled.slotOf(c), compiled.slotOf(a));
    EXPECT_EQ(compiled.records[1].state, PassState::bypassed);
    EXPECT_TRUE(contains(compiled.records[1].reason, "'s.b.out' is 's.a.out' unchanged"));
}

TEST(Graph, ADisabledPassWithoutInputIsReplacedByANeutralValue) {
    Graph graph;
    const auto a = filter(graph, "s.a", {}, true);
    graph.request(filter(graph, "s.b", a));
    graph.disable("s.a");
    const Compiled compiled = graph.compile();
    ASSERT_EQ(compiled.steps.size(), 2u);
    ASSERT_EQ(compiled.steps[0].clears.size(), 1u);
    EXPECT_EQ(compiled.steps[0].clears[0].slot, compiled.slotOf(a));
    EXPECT_EQ(compiled.steps[0].clears[0].value[0], 0.5f);
    EXPECT_EQ(run(compiled), (std::vector<std::string>{"s.b"}));
}

TEST(Graph, BypassingAPassAlsoCullsWhatOnlyItNeeded) {
    //  a ──▶ b ──▶ [c] ──▶ d     c's bypass is neutral: a and b have no reader left
    Graph graph;
    const auto b = filter(graph, "s.b", filter(graph, "s.a", {}));
    struct Data {
        Texture<Color> out;
    };
    const auto c = graph
                       .addPass<Data, FakeContext>(
                           {"s.c", ""},
                           [&](PassSetup& setup, Data& data) {
                               setup.read(b);
                               data.out = setup.create<Color>("s.c.out", 8, 8);
                               setup.bypass(data.out, {0, 0, 0, 0});
                           },
                           [](const Data&, FakeContext&) {})
                       .out;
    graph.request(filter(graph, "s.d", c));
    graph.disable("s.c");
    EXPECT_EQ(run(graph.compile()), (std::vector<std::string>{"s.d"}));
}

TEST(Graph, ARequiredPassCannotBeDisabled) {
    Graph graph;
    graph.request(filter(graph, "s.a", {}));
    graph.disable("s.a");
    EXPECT_TRUE(contains(problemsOf(graph),
                         "pass 's.a' cannot be disabled: nothing stands in for its output"));
}

TEST(Graph, DisablingAPassThatDrawsInPlaceLeavesTheImageAlone) {
    Graph graph;
    const auto image = filter(graph, "s.a", {});
    const auto one = draw(graph, "s.one", image);
    const auto two = draw(graph, "s.two", one);
    graph.request(two);
    graph.disable("s.one");
    const Compiled compiled = graph.compile();
    EXPECT_EQ(run(compiled), (std::vector<std::string>{"s.a", "s.two"}));
    EXPECT_EQ(compiled.slotOf(two), compiled.slotOf(image));
}

TEST(Graph, AForwardedInputIsNotOverwrittenBehindItsReadersBack) {
    //  a ──▶ [b] ──▶ draw writes b.out, which now is a.out, which c still reads
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto b = filter(graph, "s.b", a, true);
    const auto drawn = draw(graph, "s.draw", b);
    graph.request(drawn);
    graph.request(filter(graph, "s.c", a));
    graph.disable("s.b");
    EXPECT_TRUE(contains(problemsOf(graph),
                         "pass 's.draw' writes 's.b.out', which stands for "
                         "'s.a.out'"));
}

TEST(Graph, ForwardingIntoAnotherSizeIsAProblem) {
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    graph.request(filter(graph, "s.b", a, true, 16));
    EXPECT_TRUE(contains(problemsOf(graph), "of another size or format"));
}

TEST(Graph, ResourcesWithDisjointLifetimesShareMemory) {
    //  a ▶ b ▶ c ▶ d: only two are alive at once, so a and c share, and b and d
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto b = filter(graph, "s.b", a);
    const auto c = filter(graph, "s.c", b);
    const auto d = filter(graph, "s.d", c);
    graph.request(d);
    const Compiled compiled = graph.compile();
    EXPECT_EQ(compiled.slots.size(), 2u);
    EXPECT_EQ(compiled.slotOf(a), compiled.slotOf(c));
    EXPECT_EQ(compiled.slotOf(b), compiled.slotOf(d));
    EXPECT_EQ(compiled.peakBytes, 2u * 8 * 8 * 16);
    EXPECT_EQ(compiled.allocatedBytes, compiled.peakBytes);
    EXPECT_EQ(compiled.textureBytes, compiled.peakBytes);
    // The first pass has nothing but what it makes.
    ASSERT_EQ(compiled.steps.size(), 4u);
    EXPECT_EQ(compiled.steps[0].liveTextureBytes, 8u * 8 * 16);
    EXPECT_EQ(compiled.steps[3].liveTextureBytes, 2u * 8 * 8 * 16);
    EXPECT_EQ(compiled.steps[3].liveBufferBytes, 0u);
}

TEST(Graph, KeepingEverythingSharesNothing) {
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto c = filter(graph, "s.c", filter(graph, "s.b", a));
    graph.request(c);
    graph.keepAll();
    const Compiled compiled = graph.compile();
    EXPECT_EQ(compiled.slots.size(), 3u);
    EXPECT_EQ(compiled.resources.size(), 3u);
}

TEST(Graph, WhatIsAskedForOutlivesThePassesAfterIt) {
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    const auto b = filter(graph, "s.b", a);
    const auto c = filter(graph, "s.c", b);
    graph.request(a);
    graph.request(c);
    const Compiled compiled = graph.compile();
    EXPECT_NE(compiled.slotOf(a), compiled.slotOf(c));
    EXPECT_EQ(compiled.resources.size(), 2u);
}

TEST(Graph, BuffersOfDifferentSizesDoNotShare) {
    Graph graph;
    struct Data {
        Buffer<Element> small, large;
    };
    const auto& data = graph.addPass<Data, FakeContext>(
        {"s.a", ""},
        [](PassSetup& setup, Data& d) {
            d.small = setup.createBuffer<Element>("small", 3);
            d.large = setup.createBuffer<Element>("large", 5);
        },
        [](const Data&, FakeContext&) {});
    graph.request(data.small);
    graph.request(data.large);
    const Compiled compiled = graph.compile();
    EXPECT_EQ(compiled.bufferBytes, 8u * sizeof(Element));
    EXPECT_NE(compiled.slotOf(data.small), compiled.slotOf(data.large));
}

TEST(Graph, BatchesOfOneNodeAreOneRecord) {
    Graph graph;
    auto image = filter(graph, "s.a", {});
    for (int batch = 0; batch < 4; ++batch)
        image = draw(graph, "s.batch", image);
    graph.skip("s.rays", "the scene has no medium");
    graph.request(image);
    const Compiled compiled = graph.compile();
    EXPECT_EQ(compiled.steps.size(), 5u);
    ASSERT_EQ(compiled.records.size(), 3u);
    EXPECT_EQ(compiled.records[1].repeats, 4u);
    EXPECT_EQ(compiled.records[1].writes, std::vector<std::string>{"s.a.out"}) << "each name once";
    EXPECT_EQ(compiled.records[2].state, PassState::skipped);
    EXPECT_EQ(compiled.records[2].reason, "the scene has no medium");
    EXPECT_TRUE(compiled.records[2].writes.empty()) << "a skipped pass declares nothing";
}

TEST(Graph, PrintsItselfAsGraphviz) {
    Graph graph;
    const auto a = filter(graph, "s.a", {});
    graph.request(a);
    filter(graph, "s.b", a);
    const std::string dot = graph.toDot();
    EXPECT_TRUE(contains(dot, "digraph kaustik {"));
    EXPECT_TRUE(contains(dot, "label=\"s.a.out\\n8x8 RGBA32F\""));
    EXPECT_TRUE(contains(dot, "label=\"s.b\", color=gray"));
}

}  // namespace
}  // namespace kaustik::graph
