// SPDX-License-Identifier: MIT
// What a case measures with: a device, the registry, and the rows that it writes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/gl/context.h"
#include "framework/numerics/frame.h"
#include "framework/numerics/suite.h"
#include "framework/pipeline/registry.h"

namespace kaustik::numerics {

struct Tolerance {
    double value = 0.0;
    std::string reason;
};
inline const Tolerance kExactly{0.0, "a count, or exact in 32 bits"};
inline constexpr const char* kTooFewReason = "of fewer the case would say little";

class Lab {
  public:
    // All must outlive the lab.
    Lab(gl::Context& context, const Registry& registry, const Suite& suite)
        : context_(context), registry_(registry), suite_(suite) {}

    // Runs one case.
    [[nodiscard]] std::vector<Row> run(const Case& hardCase);

    // Writes a row of the case that runs.
    void expect(const std::string& subject, const std::string& what, double expected,
                double measured, const Tolerance& tolerance);
    // The largest deviation of many numbers from what they must be: one row, expected 0.
    void expectDeviation(const std::string& subject, const std::string& what, double worst,
                         const Tolerance& tolerance) {
        expect(subject, what, 0.0, worst, tolerance);
    }
    // A number that is bounded on one side alone: how many photons a case compares, say. `reason`:
    // why the bound is what it is.
    void expectAtLeast(const std::string& subject, const std::string& what, double minimum,
                       double measured, const std::string& reason);
    void expectAtMost(const std::string& subject, const std::string& what, double maximum,
                      double measured, const std::string& reason);

    // That what `render` asks for is refused, in a sentence, before anything is rendered.
    void expectRefused(const std::string& subject, const std::string& what,
                       const std::function<void()>& render);

    // The nodes that answer a stage, and the settings that choose one: those of the first technique
    // that uses it, else of the first technique with this node put into it, and the filter that a
    // reconstruction needs.
    [[nodiscard]] std::vector<std::string> nodesOf(const std::string& stage) const;
    struct Choice {
        std::string technique;
        Settings settings;
        std::string subject;  // "trace.lines"
    };
    [[nodiscard]] Choice choose(const std::string& stage, const std::string& node) const;
    // All nodes of a stage so.
    template <class Stage>
    [[nodiscard]] std::vector<Choice> each() const {
        std::vector<Choice> choices;
        for (const std::string& node : nodesOf(Stage::name))
            choices.push_back(choose(Stage::name, node));
        return choices;
    }

    // What a tracer can find.
    [[nodiscard]] TracerReach tracerReach(const Choice& tracer) const;

    // Whether it finds no specular surface at all.
    [[nodiscard]] bool seesReceiversOnly(const Choice& tracer) const;
    // Whether photons that enter a body go on from where they leave it.
    [[nodiscard]] bool goesThroughBodies(const Choice& specular) const;

    // Renders with every texture kept, and memory that starts as NaN; each texture is scanned, and
    // the case gets a row that says how many values were none.
    [[nodiscard]] Frame render(const Technique& technique, const scene::Scene& scene,
                               FrameRequest request);
    [[nodiscard]] Frame render(const Choice& choice, const scene::Scene& scene,
                               FrameRequest request);

    [[nodiscard]] gl::Context& context() { return context_; }
    [[nodiscard]] const Registry& registry() const { return registry_; }
    [[nodiscard]] const Suite& suite() const { return suite_; }

  private:
    gl::Context& context_;
    const Registry& registry_;
    const Suite& suite_;
    std::string caseId_;
    std::vector<Row> rows_;
    std::size_t framesScanned_ = 0;
    std::size_t texturesScanned_ = 0;
    std::size_t valuesNotFinite_ = 0;
};

}  // namespace kaustik::numerics
