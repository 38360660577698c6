// SPDX-License-Identifier: MIT
// What there is to choose from: stages, the nodes that answer them, and techniques, which are rows
// of answers. Built explicitly by techniques/register_all.cpp; a technique of one's own is added
// the same way, from anywhere:
//
//     struct MineParams {
//         float gain = 1.0f;
//         template <class R>
//         void reflect(R& r) {
//             r.field(gain, "gain", "Factor on the flux", "", params::range(0.0f, 10.0f));
//         }
//     };
//     Hits traceMine(FrameBuilder&, const MineParams&, Photons, Surfaces);
//
//     void registerMine(Registry& registry) {
//         registry.node<TraceStage>(
//             "mine", {"What it does.", "Paper, section", "What it cannot do."}, &traceMine);
//         registry.technique({"mine", "What it shows.", "Paper", {{"trace", "mine"}}});
//     }
//
// where traceMine declares its passes. MineParams then appear as trace.mine.*.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/params/param_set.h"
#include "framework/pipeline/stages.h"

namespace kaustik {

class FrameBuilder;

// The settings that a frame is built with.
[[nodiscard]] const params::ParamSet& settingsOf(const FrameBuilder& frame);

// What people are told of a node: `kaustik list nodes`, `kaustik doc`, the workbench.
struct NodeDescription {
    std::string sentence;
    std::string source;  // paper, section, equation; "" for our own
    std::string limits;  // one to three sentences: what it assumes, refuses or cannot do
    // Parameters that the node reads besides its own and its stage's: full names, or all of a node
    // or a stage ("layers.lists").
    std::vector<std::string> reads = {};
};

// A paper that descriptions cite by a short name, which `kaustik doc` spells out.
struct Paper {
    std::string name;      // "K06"
    std::string citation;  // authors, title, where and when, in Markdown
};

// What a technique hands to the report, besides the picture.
struct FrameOutputs {
    Picture picture;
    IrradianceMap caustic;
    EyeBuffer eye;
    LayeredDepth layers;  // invalid handles where a technique has none
    Hits hits;
    Ledger ledger;  // with everything but what was deposited
    InScattered inScattered;
    Shadows shadows;
    CausticMap map;  // what was stored, filtered too; without maps where nothing is
    graph::Buffer<transport::CellCounts> cells;  // where the driver chooses its photons
    Geometry geometry = {};
};

using BuildFrame = std::function<FrameOutputs(FrameBuilder&)>;

struct Technique {
    std::string name;
    std::string sentence;
    std::string source;
    // Its answers and other defaults: {"trace", "lines"}, {"emit.photons", "256x256"}.
    std::vector<std::pair<std::string, std::string>> defaults;
    // What the paper's own row has in their place, or besides: its method to the letter, where the
    // defaults are what is right. Empty where it is no paper's.
    std::vector<std::pair<std::string, std::string>> asPublished = {};
    // How its stages are put together; empty: the usual order (buildFrame in frame_builder.h).
    BuildFrame build = {};
    bool isAsPublished = false;  // `defaults` are the paper's row
};

class Registry {
  public:
    // Says where a stage comes in lists: after those that were named before. One that is not
    // named comes with its first node.
    template <class Stage>
    void stage() {
        addStage({Stage::name, Stage::question, Stage::takes, Stage::gives, Stage::whyIdle});
    }

    // Declares the parameters that all nodes of a stage share.
    template <class Stage, class Params>
    void sharedParams() {
        declarations_.push_back([](params::ParamSet& set) { set.declare<Params>(Stage::name); });
    }

    // Adds a node that answers a stage, a function or a closure. The first one added is the stage's
    // default. `traits`: what others need to know of it (Stage::Traits).
    template <class Stage, class Params, class... In>
    void node(const std::string& name, NodeDescription description,
              typename Stage::Output (*build)(FrameBuilder&, const Params&, In...)) {
        node<Stage>(name, std::move(description), typename Stage::Traits{}, std::function(build));
    }
    template <class Stage, class Params, class... In>
    void node(const std::string& name, NodeDescription description, typename Stage::Traits traits,
              typename Stage::Output (*build)(FrameBuilder&, const Params&, In...)) {
        node<Stage>(name, std::move(description), std::move(traits), std::function(build));
    }
    template <class Stage, class Params, class... In>
    void node(const std::string& name, NodeDescription description,
              std::function<typename Stage::Output(FrameBuilder&, const Params&, In...)> build) {
        node<Stage>(name, std::move(description), typename Stage::Traits{}, std::move(build));
    }
    template <class Stage, class Params, class... In>
    void node(const std::string& name, NodeDescription description, typename Stage::Traits traits,
              std::function<typename Stage::Output(FrameBuilder&, const Params&, In...)> build) {
        using Build = typename Stage::Build;
        static_assert(
            std::is_same_v<Build, std::function<typename Stage::Output(FrameBuilder&, In...)>>,
            "a node takes and gives what its stage says");
        const std::string scope = std::string(Stage::name) + "." + name;
        auto bound = std::make_shared<Build>([scope, build](FrameBuilder& frame, In... in) {
            return build(frame, settingsOf(frame).template get<Params>(scope), std::move(in)...);
        });
        stage<Stage>();
        addNode({Stage::name, name, std::move(description), std::move(bound),
                 std::make_shared<typename Stage::Traits>(std::move(traits))});
        declarations_.push_back([scope](params::ParamSet& set) { set.declare<Params>(scope); });
    }

    void technique(Technique technique);
    void paper(Paper paper);

    // A folder of shaders that are not the project's own, for programs built elsewhere: a node of
    // theirs names a file in it, which includes the project's as any other
    // ("include/photons/hits.glsl").
    void shaders(std::filesystem::path folder) { shaderFolders_.push_back(std::move(folder)); }
    [[nodiscard]] const std::vector<std::filesystem::path>& shaderFolders() const {
        return shaderFolders_;
    }

    struct StageEntry {
        std::string name;
        std::string question;
        std::string takes;
        std::string gives;
        std::string (*whyIdle)(const FrameFacts&) = nullptr;  // as Stage::whyIdle has it
    };
    [[nodiscard]] const std::vector<StageEntry>& stages() const { return stages_; }

    struct Node {
        std::string stage;
        std::string name;
        NodeDescription description;
        std::shared_ptr<void> build;         // of the stage's own signature
        std::shared_ptr<const void> traits;  // of the stage's own type
    };
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<Technique>& techniques() const { return techniques_; }
    [[nodiscard]] const std::vector<Paper>& papers() const { return papers_; }

    // Throws ConfigError with the nearest name.
    [[nodiscard]] const Technique& findTechnique(const std::string& name) const;
    // The same with its paper's row for its defaults, where that is asked for. Throws ConfigError
    // too where the technique is no paper's.
    [[nodiscard]] Technique findTechnique(const std::string& name, bool isAsPublished) const;
    [[nodiscard]] const Node& findNode(const std::string& stage, const std::string& name) const;

    // Throws ConfigError as findNode.
    template <class Stage>
    [[nodiscard]] const typename Stage::Traits& traits(const std::string& name) const {
        return *static_cast<const typename Stage::Traits*>(
            findNode(Stage::name, name).traits.get());
    }

    // Every parameter with its default, then the technique's own defaults.
    [[nodiscard]] params::ParamSet makeParams(const Technique& technique) const;

  private:
    void addStage(StageEntry stage);
    void addNode(Node node);

    std::vector<StageEntry> stages_;
    std::vector<Node> nodes_;
    std::vector<Technique> techniques_;
    std::vector<Paper> papers_;
    std::vector<std::filesystem::path> shaderFolders_;
    std::vector<std::function<void(params::ParamSet&)>> declarations_;
};

}  // namespace kaustik
