// SPDX-License-Identifier: MIT
// Renders mixtures, all in one process on one context, of the scenes as they are and of scenes that
// are the same but for their size, place, light or order.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "framework/reference/reference.h"
#include "framework/run/caustic_errors.h"
#include "tests/mixtures/mixture.h"

namespace kaustik::mixtures {

// What is rendered of a mixture beside the mixture itself.
struct Variation {
    // All lengths by this factor: positions, parameters in metres, and what is per metre by its
    // inverse. A sun gives the same irradiance then; a point light or a spot does where its
    // intensity grows by the square, which is done, and else 1 / scale² of it.
    double scale = 1.0;
    double turnDegrees = 0.0;  // of everything about +Y
    double light = 1.0;        // all lights by this factor, and what lights the background
    std::uint64_t order = 0;   // of the objects, drawn by this seed; 0: the scene's
    int threads = 0;           // of the processor; 0: all
    // Keeps every texture to the end, and begins all memory as NaN.
    bool keepsAll = false;
    bool poison = true;
    Settings settings = {};  // after the mixture's
};

// What a frame leaves behind.
struct Shot {
    // caustic_irradiance, W/m², and where they are caustic_radiance and in_scattered, W/m²/sr.
    run::Outputs outputs;
    Image picture;  // radiance, W/m²/sr
    Image display;
    EnergyLedger ledger;
    std::vector<std::string> warnings;
    std::vector<ReachedLimit> limits;
    // Textures that hold something that is no number; where all were kept.
    std::vector<std::string> notFinite;
    // W, the mean of the channels: on the receivers of the picture, and in the maps as filters have
    // left them (none where there is no such map).
    double shownWatts = 0.0;
    std::optional<double> filteredWatts;
    bool isStoredOnScreen = false;
    ModelledPaths paths;
    std::set<std::string> idle;  // parameters without an effect
};

class Bench {
  public:
    explicit Bench(gl::Context& context) : context_(context) {}

    // Throws what a renderer does.
    [[nodiscard]] Shot render(const Mixture& mixture, const Variation& variation = {});
    // The same by a renderer that has rendered nothing before.
    [[nodiscard]] Shot renderFresh(const Mixture& mixture, const Variation& variation = {});
    void forgetRenderers() { stations_.clear(); }
    void setFresh(bool fresh) { isFresh_ = fresh; }

    // Of the paths that a technique claims to model.
    [[nodiscard]] const reference::Reference& referenceOf(const std::string& scene,
                                                          const ModelledPaths& paths);
    [[nodiscard]] static const scene::Scene& sceneOf(const std::string& name);
    [[nodiscard]] int renders() const { return renders_; }

  private:
    // A scene and its renderer, which outlives many mixtures.
    struct Station {
        std::string key;
        std::unique_ptr<scene::Scene> scene;
        std::unique_ptr<Renderer> renderer;
        int builds = 0;
    };
    [[nodiscard]] Renderer& rendererOf(const Mixture& mixture, const Variation& variation,
                                       RenderSettings settings);

    gl::Context& context_;
    std::list<Station> stations_;  // the one that was used last first
    std::map<std::string, reference::Reference> references_;
    bool isFresh_ = false;
    int renders_ = 0;
};

}  // namespace kaustik::mixtures
