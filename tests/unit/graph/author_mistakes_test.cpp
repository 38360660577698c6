// SPDX-License-Identifier: MIT
// What a technique's author can get wrong about the graph is an error with names, in every build.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "framework/core/error.h"
#include "framework/graph/graph.h"

namespace kaustik::graph {
namespace {

struct Color {
    static constexpr Format format = Format::rgba32f;
};
struct Element {
    float value[4];
};
struct Resources {
    Texture<Color> image;
    Buffer<Element> list;
};

// A pass whose setup creates an image and a list, and does `more`.
Resources addPass(
    Graph& graph, const std::string& name,
    const std::function<void(PassSetup&, const Resources&)>& more = [](PassSetup&,
                                                                       const Resources&) {}) {
    return graph.addPass<Resources, ExecuteContext>(
        {name, ""},
        [&](PassSetup& setup, Resources& data) {
            data.image = setup.create<Color>(name + ".image", 8, 8);
            data.list = setup.createBuffer<Element>(name + ".list", 8);
            more(setup, data);
        },
        [](const Resources&, ExecuteContext&) {});
}

template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const GraphError& error) {
        return error.what();
    }
    return "no error";
}

std::string problemsOf(const Graph& graph) {
    return errorOf([&] { static_cast<void>(graph.compile()); });
}

void expectIn(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
}

TEST(AuthorMistakes, AStandInForWhatThePassDoesNotMakeIsNamed) {
    Graph graph;
    const Resources a = addPass(graph, "s.a");
    addPass(graph, "s.b", [&](PassSetup& setup, const Resources& own) {
        setup.bypass(a.image, {0, 0, 0, 0});
        setup.bypass(Texture<Color>{}, own.image);
    });
    const std::string problems = problemsOf(graph);
    expectIn(problems, "pass 's.b' says what stands in for 's.a.image', which it does not make");
    expectIn(problems, "pass 's.b' says what stands in for a handle that no pass has made");
}

TEST(AuthorMistakes, OneVersionIsWrittenOnce) {
    Graph graph;
    const Resources a = addPass(graph, "s.a");
    addPass(graph, "s.b", [&](PassSetup& setup, const Resources&) {
        static_cast<void>(setup.write(a.image));
        static_cast<void>(setup.write(a.image));
    });
    expectIn(problemsOf(graph), "pass 's.b' writes 's.a.image' twice from one version");
}

TEST(AuthorMistakes, AHandleOfAnotherGraphIsNotTakenForOneOfThis) {
    Graph other;
    Texture<Color> late;
    const Resources first = addPass(other, "s.a");
    addPass(other, "s.b",
            [&](PassSetup& setup, const Resources&) { late = setup.write(first.image); });
    Graph graph;
    addPass(graph, "s.a");
    addPass(graph, "s.c", [&](PassSetup& setup, const Resources&) { setup.read(late); });
    graph.request(late, "the caustic");
    const std::string problems = problemsOf(graph);
    expectIn(problems, "pass 's.c' reads a handle that no pass has made");
    expectIn(problems, "the caustic is asked for that no pass has made");
}

TEST(AuthorMistakes, AskingAboutAHandleThatNoPassHasMadeIsAnError) {
    Graph graph;
    addPass(graph, "s.a");
    const std::string message = "a handle that none of its passes has made";
    expectIn(errorOf([&] { static_cast<void>(graph.nameOf({})); }), message);
    expectIn(errorOf([&] { static_cast<void>(graph.descOf(graph.find("s.typo"))); }), message);
    expectIn(errorOf([&] { static_cast<void>(graph.descOf({7, 0})); }), message);
}

// s.a ──▶ s.b, which reads s.a.image and nothing else of s.a
class AuthorMistakesInExecute : public testing::Test {
  protected:
    using Kind = Compiled::Kind;
    AuthorMistakesInExecute() {
        a = addPass(graph, "s.a");
        b = addPass(graph, "s.b", [&](PassSetup& setup, const Resources&) { setup.read(a.image); });
        graph.request(b.image);
        compiled = graph.compile();
    }
    [[nodiscard]] std::string useOf(const ResourceRef& handle, Kind kind) const {
        return errorOf(
            [&] { static_cast<void>(compiled.slotToUse(compiled.steps.at(1), handle, kind)); });
    }

    Graph graph;
    Resources a, b;
    Compiled compiled;
};

TEST_F(AuthorMistakesInExecute, WhatWasDeclaredMayBeUsed) {
    const Step& step = compiled.steps.at(1);
    EXPECT_EQ(compiled.slotToUse(step, a.image, Kind::texture), compiled.slotOf(a.image));
    EXPECT_EQ(compiled.slotToWrite(step, b.image, Kind::texture), compiled.slotOf(b.image));
    EXPECT_TRUE(compiled.writes(step, b.list));
    EXPECT_FALSE(compiled.writes(step, a.image));
}

TEST_F(AuthorMistakesInExecute, AnUndeclaredReadNamesPassAndResource) {
    expectIn(useOf(a.list, Kind::buffer),
             "Pass 's.b' uses 's.a.list' (version 0) without having declared it");
    expectIn(useOf({}, Kind::texture), "Pass 's.b' uses a handle that no pass has made");
    expectIn(useOf({99, 0}, Kind::texture), "Pass 's.b' uses a handle that no pass has made");
    expectIn(useOf({a.image.index, 1}, Kind::texture), "a handle that no pass has made");
}

TEST_F(AuthorMistakesInExecute, ABufferIsNoTexture) {
    expectIn(useOf(b.list, Kind::texture), "Pass 's.b' uses the buffer 's.b.list' as a texture");
    expectIn(useOf(b.image, Kind::buffer), "Pass 's.b' uses the texture 's.b.image' as a buffer");
}

TEST_F(AuthorMistakesInExecute, WhatIsOnlyReadIsNotDrawnTo) {
    const std::string message = errorOf([&] {
        static_cast<void>(compiled.slotToWrite(compiled.steps.at(1), a.image, Kind::texture));
    });
    expectIn(message, "Pass 's.b' draws to 's.a.image', which it has declared only to read");
}

TEST_F(AuthorMistakesInExecute, WhatNothingKeepsCannotBeReadAfterTheFrame) {
    EXPECT_EQ(compiled.slotAfterwards(b.image, Kind::texture), compiled.slotOf(b.image));
    const auto readingOf = [&](const ResourceRef& handle, Kind kind) {
        return errorOf([&] { static_cast<void>(compiled.slotAfterwards(handle, kind)); });
    };
    expectIn(readingOf(a.image, Kind::texture), "'s.a.image' is read after the frame");
    expectIn(readingOf({}, Kind::texture), "a handle that no pass has made");
    expectIn(readingOf(b.image, Kind::buffer), "the texture 's.b.image' as a buffer");
}

}  // namespace
}  // namespace kaustik::graph
