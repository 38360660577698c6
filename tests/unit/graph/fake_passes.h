// SPDX-License-Identifier: MIT
// Passes that draw nothing, for tests of the graph without any device.
#pragma once

#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/graph/graph.h"

namespace kaustik::graph::test {

struct Depth {
    static constexpr Format format = Format::r32f;
};
struct Color {
    static constexpr Format format = Format::rgba32f;
};
struct Element {
    float value[4];
};

struct FakeContext : ExecuteContext {
    std::vector<std::string> ran;
};
struct None {};

// A pass that turns `input` (if valid) into a new texture `output`.
inline Texture<Color> filter(Graph& graph, const std::string& name, Texture<Color> input,
                             bool withBypass = false, int size = 8) {
    struct Data {
        Texture<Color> output;
    };
    return graph
        .addPass<Data, FakeContext>(
            {name, "test"},
            [&](PassSetup& setup, Data& data) {
                if (input.valid()) setup.read(input);
                data.output = setup.create<Color>(name + ".out", size, size);
                if (withBypass && input.valid()) setup.bypass(data.output, input);
                if (withBypass && !input.valid()) setup.bypass(data.output, {0.5f, 0, 0, 0});
            },
            [name](const Data&, FakeContext& context) { context.ran.push_back(name); })
        .output;
}

// A pass that writes on `image` in place.
inline Texture<Color> draw(Graph& graph, const std::string& name, Texture<Color> image) {
    struct Data {
        Texture<Color> image;
    };
    return graph
        .addPass<Data, FakeContext>(
            {name, "test"},
            [&](PassSetup& setup, Data& data) {
                data.image = setup.write(image);
                setup.bypass(data.image, image);
            },
            [name](const Data&, FakeContext& context) { context.ran.push_back(name); })
        .image;
}

inline std::vector<std::string> run(const Compiled& compiled) {
    FakeContext context;
    for (const Step& step : compiled.steps) {
        if (step.execute) step.execute(context);
    }
    return context.ran;
}

inline std::string problemsOf(const Graph& graph) {
    try {
        static_cast<void>(graph.compile());
    } catch (const GraphError& error) {
        return error.what();
    }
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace kaustik::graph::test
