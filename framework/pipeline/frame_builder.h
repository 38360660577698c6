// SPDX-License-Identifier: MIT
// What a node is handed when it declares its passes: the graph, the parameters, the scene and its
// needs, and the view.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/gl/executor.h"
#include "framework/graph/graph.h"
#include "framework/pipeline/effect.h"
#include "framework/pipeline/limit.h"
#include "framework/pipeline/registry.h"
#include "framework/pipeline/trace_record.h"
#include "framework/render/gpu_scene.h"
#include "framework/render/raster_views.h"
#include "framework/scene/needs.h"

namespace kaustik {

// What a frame is made of, owned by the renderer; all of it outlives the graph. The view, the
// lights, the materials, the images and the ledger's unit are bound to every command.
struct FrameInputs {
    const Registry& registry;
    const params::ParamSet& params;
    const render::GpuScene& gpuScene;
    const scene::SceneNeeds& needs;
    const render::RasterView& view;
    const render::ViewInstances& instances;         // as the eye sees them
    const std::uint64_t& seed;                      // of whatever a node draws at random
    const std::shared_ptr<const TileFrame>& tiles;  // null where there are none
    const float& ledgerQuantumWatts;                // ledgerQuantum() of the scene
    // The view has so many pixels a side of each of the picture's (eye.samples).
    int samplesPerSide = 1;
    // The device is the processor: what runs there in place of a shader takes the same cores.
    bool isOnProcessor = false;
    // What nodes have made of the scene's meshes (FrameBuilder::onceForScene), by name.
    std::map<std::string, std::shared_ptr<void>>* ofScene = nullptr;
    // Of the frame that is built: what the processor does in place of a shader adds to the ledger.
    bool hasLedger = true;
};

// Issues a compute thread a photon of the list: shaders include include/photons/photon_thread.glsl.
void dispatchOver(gl::Command& command, const Photons& photons);
inline void dispatchOver(gl::Command&& command, const Photons& photons) {
    dispatchOver(command, photons);
}
// Draws a fragment a photon of the list; the targets are of the list's size. The command starts
// with framework/photon_rows.vert.
void drawOver(gl::Command& command);
// Tells a command which cells a list is of: shaders include include/photons/cells.glsl.
void setCells(gl::Command& command, const CellGrid& cells);
// Sets a list's length to all texels of its textures, each of which then holds a photon or an empty
// one.
void fillList(gl::PassContext& context, const Photons& photons);

// Throws ConfigError where `what`, which is given to a node that works on the screen alone, is not
// in the eye's view.
void needsEyesView(const std::string& node, const std::string& what, const Views& views);

class FrameBuilder;
// Throws ConfigError where a node uses beams and the emitter does not make any.
void needsBeams(FrameBuilder& frame, const std::string& node, const Photons& photons);

class FrameBuilder {
  public:
    // `recordsTraces`: keeps what each tracing was given and what it found (for the photon audit).
    // `skipsCaustic`: no photons, so that what the eye sees is judged apart.
    FrameBuilder(graph::Graph& graph, const FrameInputs& inputs, bool recordsTraces = false,
                 bool skipsCaustic = false)
        : graph_(graph),
          inputs_(inputs),
          recordsTraces_(recordsTraces),
          skipsCaustic_(skipsCaustic) {}

    // Runs the node that the settings choose for a stage.
    template <class Stage, class... In>
    typename Stage::Output run(In... in) {
        const Registry::Node& node = chosenNode(Stage::name);
        const auto& build = *static_cast<const typename Stage::Build*>(node.build.get());
        if constexpr (std::is_same_v<Stage, TraceStage>) {
            needsWayOut(in...);
            if (prefix_.empty()) return traced(build, std::move(in)...);
        }
        if constexpr (std::is_same_v<Stage, FilterStage>)
            return build(*this, closed(std::move(in)...));
        return build(*this, std::move(in)...);
    }
    [[nodiscard]] const Registry::Node& chosenNode(const std::string& stage);
    // The traits of the node that the settings choose for a stage. The node is not run by this.
    template <class Stage>
    [[nodiscard]] const typename Stage::Traits& traits() const {
        return inputs_.registry.traits<Stage>(inputs_.params.choice(Stage::name));
    }

    // Adds a pass; see graph::Graph::addPass. `reason` is what `explain` prints.
    template <class Data, class Setup, class Execute>
    const Data& pass(const std::string& name, const std::string& reason, Setup&& setup,
                     Execute&& execute) {
        return graph_.addPass<Data, gl::PassContext>(
            {prefix_ + name, reason}, std::forward<Setup>(setup), std::forward<Execute>(execute));
    }
    void skip(const std::string& name, const std::string& reason) {
        graph_.skip(prefix_ + name, reason);
    }
    // See graph::Graph::beginLoop.
    void beginLoop();
    void endLoop(const graph::ResourceRef& again, std::size_t word, bool mayRunIdle = false);

    // While it lives, passes are named "STAGE.…": for a stage that uses nodes of another one, a
    // tracer say. Such tracings are not part of what the photon audit records.
    class PassScope {
      public:
        PassScope(FrameBuilder& frame, const std::string& stage)
            : frame_(frame), before_(frame.prefix_) {
            frame.prefix_ += stage + ".";
        }
        // None: for what several stages share, whichever of them asks first.
        explicit PassScope(FrameBuilder& frame) : frame_(frame), before_(frame.prefix_) {
            frame.prefix_.clear();
        }
        ~PassScope() { frame_.prefix_ = before_; }
        PassScope(const PassScope&) = delete;
        PassScope& operator=(const PassScope&) = delete;

      private:
        FrameBuilder& frame_;
        std::string before_;
    };

    // The parameters of a node ("trace.lines") or those that a stage shares ("trace").
    template <class Params>
    [[nodiscard]] const Params& params(const std::string& scope) const {
        return inputs_.params.get<Params>(scope);
    }

    [[nodiscard]] const scene::Scene& scene() const { return inputs_.gpuScene.scene(); }
    [[nodiscard]] const render::GpuScene& gpuScene() const { return inputs_.gpuScene; }
    [[nodiscard]] const scene::SceneNeeds& needs() const { return inputs_.needs; }
    [[nodiscard]] FrameFacts facts() const {
        return {inputs_.registry, inputs_.params, &inputs_.needs};
    }
    [[nodiscard]] const render::RasterView& view() const { return inputs_.view; }
    // The eye's view for what works in any, and others, which live as long as the frame.
    [[nodiscard]] Views eyeViews();
    [[nodiscard]] Views makeViews(render::Space space, std::vector<render::RasterView> views);
    [[nodiscard]] int width() const { return inputs_.view.width; }
    [[nodiscard]] int height() const { return inputs_.view.height; }
    // Outlives the graph: what execute functions capture, by reference.
    [[nodiscard]] const FrameInputs& inputs() const { return inputs_; }

    // What several nodes or runs of one share, made by the first of them: an acceleration
    // structure, say. Lives as long as the frame.
    template <class T, class Make>
    std::shared_ptr<T> once(const std::string& name, Make&& make) {
        std::shared_ptr<void>& shared = shared_[name];
        if (!shared) {
            shared = make();
            keptObjects_.push_back(shared);
        }
        return std::static_pointer_cast<T>(shared);
    }
    // The same of what depends on nothing but the scene's meshes and materials where none of them
    // moves: lives as long as the renderer, and is not made anew when a setting changes.
    template <class T, class Make>
    std::shared_ptr<T> onceForScene(const std::string& name, Make&& make) {
        std::shared_ptr<void>& shared = (*inputs_.ofScene)[name];
        if (!shared) shared = make();
        return std::static_pointer_cast<T>(shared);
    }
    // What the chosen tracer can find.
    [[nodiscard]] TracerReach tracerReach() const;
    // Whether photons have beams: the emitter makes them, and a chosen node uses them.
    [[nodiscard]] bool usesBeams() const;
    // Whether a batch is to know the cells next to it too.
    [[nodiscard]] bool joinsCells() const;
    // How many photons each light emits, as rows of so many: what Samples are taken from.
    [[nodiscard]] params::Extent photonsOfALight() const;
    // Keeps `object` (a buffer of a node's own, say) alive as long as the frame.
    template <class T>
    const T& keep(T&& object) {
        auto owner = std::make_shared<std::decay_t<T>>(std::forward<T>(object));
        const auto& reference = *owner;
        keptObjects_.push_back(std::move(owner));
        return reference;
    }
    [[nodiscard]] std::vector<std::shared_ptr<void>> releaseKeptObjects() {
        return std::move(keptObjects_);
    }
    [[nodiscard]] const std::vector<TraceRecord>& traces() const { return traces_; }
    [[nodiscard]] bool skipsCaustic() const { return skipsCaustic_; }
    // Keeps a list, and hits, to the end of the frame for whoever reads them back
    // (photon_texels.h).
    void request(const Photons& photons);
    void request(const Hits& hits);
    // Adds a warning to the report.
    void warn(std::string warning) {
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
            warnings_.push_back(std::move(warning));
    }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    // Says that the frame depends on FrameInputs::seed.
    void usesRandomness() { isRandom_ = true; }
    [[nodiscard]] bool isRandom() const { return isRandom_; }
    // Has the report say after a frame that is measured whether a limit was reached. `limit.pass`
    // is the pass's name as it was given to pass().
    void reportLimit(NodeLimit limit) {
        limit.pass = prefix_ + limit.pass;
        limits_.push_back(std::move(limit));
    }
    [[nodiscard]] const std::vector<NodeLimit>& limits() const { return limits_; }
    // The same of what is no cap.
    void warnIfFound(NodeWarning warning) {
        warning.pass = prefix_ + warning.pass;
        nodeWarnings_.push_back(std::move(warning));
    }
    [[nodiscard]] const std::vector<NodeWarning>& nodeWarnings() const { return nodeWarnings_; }
    // The tile of the screen that is traced alone, without a picture (framework/pipeline/tiles.h).
    [[nodiscard]] std::optional<ScreenTile> tile() const;
    // Throws ConfigError where there are tiles, and the scene or a chosen node is none for them.
    void requireTileNodes() const;
    // Whether the tile is traced after this interaction of a photon, from 1 on, and then no more.
    // `interactions`: how often those of the batch may interact.
    [[nodiscard]] bool endsTile(int interaction, int interactions);
    // What the tile's tracings have found, and after how many interactions there may be one.
    [[nodiscard]] const std::vector<Hits>& tileHits() const { return tileHits_; }
    [[nodiscard]] int maxRounds() const { return maxRounds_; }
    // How often a stage has been run so far, the running one included.
    [[nodiscard]] int runsOf(const std::string& stage) const;

  private:
    // ConfigError where some of the photons may be inside of bodies, and the tracer finds no
    // surface there.
    void needsWayOut(const Photons& photons, const Surfaces& surfaces) const;
    // The maps with all that has come, whatever the node that the settings choose for `reconstruct`
    // has kept elsewhere until then.
    [[nodiscard]] CausticMap closed(CausticMap map);
    Hits traced(const TraceStage::Build& build, const Photons& photons, const Surfaces& surfaces);
    Hits recorded(const TraceStage::Build& build, const Photons& photons, const Surfaces& surfaces);
    // Of tiles: those that are known, or that the tile's tracer finds.
    Hits hitsOfTiles(const TraceStage::Build& build, const Photons& photons,
                     const Surfaces& surfaces);
    template <class Stage>
    void requireTiles() const;

    graph::Graph& graph_;
    const FrameInputs& inputs_;
    std::vector<std::shared_ptr<void>> keptObjects_;
    std::map<std::string, std::shared_ptr<void>> shared_;
    std::vector<std::string> warnings_;
    std::vector<NodeLimit> limits_;
    std::vector<std::string> stagesRun_;
    std::string prefix_;
    bool recordsTraces_ = false;
    bool skipsCaustic_ = false;
    bool isRandom_ = false;
    int loops_ = 0;  // that have begun and not ended
    std::vector<TraceRecord> traces_;
    std::vector<NodeWarning> nodeWarnings_;
    std::map<std::string, std::size_t> tracingsOfBatch_;
    std::vector<Hits> tileHits_;
    int maxRounds_ = 0;
};

// The usual order of the stages, from which a technique differs only if it must.
[[nodiscard]] FrameOutputs buildFrame(FrameBuilder& frame);

}  // namespace kaustik
