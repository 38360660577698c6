// SPDX-License-Identifier: MIT
// A scene, a technique and settings, ready to render frames. The command line, the GUI and the
// tests are thin users of this.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/gl/executor.h"
#include "framework/graph/graph.h"
#include "framework/pipeline/eye_rays.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/ledger.h"
#include "framework/scene/needs.h"

namespace kaustik {

struct RenderSettings {
    Technique technique;
    params::ParamSet params;
    std::set<std::string> disabledPasses;
    std::string disabledBy = "--disable";  // what names them, for messages
    int width = 800;
    int height = 600;
    std::uint64_t seed = 1;  // of everything random; equal ones give equal bits
    // Whether frames for pictures sum up the ledger too, which those for measurement always do.
    bool hasLedger = true;
    // Nodes that choose by the kind of device choose as on a GPU, whatever the device: for what is
    // counted or compiled here for one.
    bool asOnGpu = false;
    // Null unless the first hits of photons are, or are to be, found on tiles of the screen.
    std::shared_ptr<const TileFrame> tiles = {};
};

// What a frame is asked for.
enum class Purpose {
    picture,      // what a user of the technique wants: this is what is timed
    measurement,  // also the ledger, the layer statistics, what tells which limits were reached,
                  // and every resource kept by name
    audit,        // also what every tracing was given and what it found, the layers, the receivers
    view          // what the eye sees through specular surfaces, without photons
};

class Renderer {
  public:
    // Uploads the scene. `scene` and `registry` must outlive the renderer.
    Renderer(gl::Context& context, const Registry& registry, const scene::Scene& scene,
             RenderSettings settings);

    // Takes over other settings, and what has changed of the scene's camera, lights, medium, time
    // and waves; its meshes, materials and images must be as they were, and where they were.
    // Programs and memory that still fit are kept. build() must follow.
    void update(RenderSettings settings);

    // Forgets the passes that the settings switch off and that no frame of them has, as those of a
    // node that is no longer chosen, and gives their names: build() refuses them. It must follow.
    std::vector<std::string> forgetAbsentPasses();

    // Builds and compiles the graph, and allocates its memory. `resources` are kept until the
    // frame's end so that they can be saved: those that nothing asks for are asked for; an unknown
    // name is a ConfigError with the nearest one. The driver is handed all programs that settings
    // and purpose ask for, when these are new. Throws GraphError, ConfigError and DeviceError.
    void build(Purpose purpose, const std::vector<std::string>& resources = {});
    // The programs of what was built; what textures held is gone (Executor::listPrograms).
    [[nodiscard]] std::vector<gl::UsedProgram> listPrograms() { return executor_.listPrograms(); }
    // Only declares and compiles: what a frame would take is known before any memory is taken.
    [[nodiscard]] graph::Compiled compile(Purpose purpose,
                                          const std::vector<std::string>& resources = {});
    // `shouldContinue` is asked before each pass (its number among compiled().steps); where it says
    // no, the rest of the frame is skipped and the result is false.
    bool renderFrame(gl::PassTimer& timer,
                     const std::function<bool(std::size_t)>& shouldContinue = {});

    // These give what the last build has made.
    [[nodiscard]] const graph::Graph& graph() const { return *graph_; }
    [[nodiscard]] const graph::Compiled& compiled() const { return executor_.compiled(); }
    [[nodiscard]] const FrameOutputs& outputs() const { return outputs_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    // Why a parameter has no effect in this frame (framework/pipeline/effect.h): by what is
    // declared, and, of nodes that another one chooses from, by which of them have run.
    [[nodiscard]] std::string whyNoEffect(const std::string& name) const;
    [[nodiscard]] double buildMilliseconds() const { return buildMilliseconds_; }
    // Whether the frame depends on the settings' seed.
    [[nodiscard]] bool isRandom() const { return isRandom_; }

    // The traces of the last build for Purpose::audit.
    [[nodiscard]] const std::vector<TraceRecord>& traces() const { return traces_; }

    // What the last build traces on one tile of the screen, and after how many interactions there
    // may be a tracing.
    [[nodiscard]] const std::vector<Hits>& tileHits() const { return tileHits_; }
    [[nodiscard]] int maxRounds() const { return maxRounds_; }

    // What was rendered; these wait for the device. The first two, the layers' statistics and the
    // eye's rays need Purpose::measurement.
    [[nodiscard]] EnergyLedger ledger() const;
    // Those that nodes keep to, of several passes with one limit all together.
    [[nodiscard]] std::vector<ReachedLimit> reachedLimits() const;
    // What nodes have found out of the frame, a sentence each; Purpose::measurement too.
    [[nodiscard]] std::vector<std::string> foundWarnings() const;
    // A ledger as it stood where the handle was written.
    [[nodiscard]] EnergyLedger ledger(const Ledger& handle) const;
    [[nodiscard]] transport::LayerStatistics layerStatistics() const;
    // Nothing where no such ray is followed.
    [[nodiscard]] std::optional<EyeRays> eyeRays() const;
    [[nodiscard]] const gl::Texture& texture(const graph::ResourceRef& handle) const;
    [[nodiscard]] const gl::Buffer& buffer(const graph::ResourceRef& handle) const;

    // Renders only what counts the fragments of each pixel and notes the result in needs().
    void measureDepthComplexity();
    [[nodiscard]] const scene::SceneNeeds& needs() const { return needs_; }
    [[nodiscard]] const Registry& registry() const { return registry_; }
    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    // What is rendered; with eye.samples it is finer than the picture, whose pixels pictureView()
    // has.
    [[nodiscard]] const render::RasterView& view() const { return view_; }
    [[nodiscard]] render::RasterView pictureView() const;
    [[nodiscard]] int samplesPerSide() const { return inputs_.samplesPerSide; }
    [[nodiscard]] const render::GpuScene& gpuScene() const { return gpuScene_; }
    [[nodiscard]] const RenderSettings& settings() const { return settings_; }
    [[nodiscard]] gl::Executor& executor() { return executor_; }
    [[nodiscard]] gl::ProgramCache& programs() { return programs_; }

  private:
    [[nodiscard]] FrameBuilder declareFrame(bool recordsTraces = false, bool skipsCaustic = false);

    [[nodiscard]] std::string whyNoEffect(const std::string& name,
                                          const graph::Compiled& compiled) const;
    void bindToAll(Purpose purpose);
    void meanOverPixelsOfCaustic(FrameBuilder& frame);
    void requestForMaps();
    void requestForAudit();
    void requestExits();
    [[nodiscard]] graph::Compiled compileTile(FrameBuilder& frame);
    [[nodiscard]] graph::Compiled keepFindings(const graph::Compiled& compiled,
                                               const FrameBuilder& frame);

    gl::Context& context_;
    const Registry& registry_;
    const scene::Scene& scene_;
    RenderSettings settings_;
    render::RasterView view_;
    render::GpuScene gpuScene_;
    gl::Buffer viewBlock_;
    gl::Buffer lights_;
    gl::Buffer bands_;
    render::ViewInstances instances_;
    scene::SceneShapes shapes_;
    scene::SceneNeeds needs_;
    float ledgerQuantumWatts_;
    std::map<std::string, std::shared_ptr<void>> ofScene_;
    FrameInputs inputs_;
    gl::ProgramCache programs_;
    gl::Executor executor_;

    std::unique_ptr<graph::Graph> graph_;
    std::vector<std::shared_ptr<void>> keptObjects_;  // what nodes keep alive for their frame
    FrameOutputs outputs_;
    Ledger closedLedger_;
    std::vector<TraceRecord> traces_;
    std::vector<NodeLimit> limits_;
    std::vector<std::string> warnings_;
    double buildMilliseconds_ = 0.0;
    bool isRandom_ = false;
    bool hasLayerStatistics_ = false;
    bool hasEyeRays_ = false;
    std::set<Purpose> startedFor_;  // since the settings have changed
    std::vector<Hits> tileHits_;
    int maxRounds_ = 0;
    std::vector<NodeWarning> nodeWarnings_;
};

}  // namespace kaustik
