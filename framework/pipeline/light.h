// SPDX-License-Identifier: MIT
// Handles of light that has arrived, and of what becomes of it.
#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/photons.h"
#include "framework/pipeline/surfaces.h"

namespace kaustik {

// What a map of flux holds of each view.
struct FluxSets {
    // Maps of all the flux, where it is stored in several ways: a splat's sizes, levels of
    // resolution.
    int flux = 1;
    int parts = 1;              // of these sets add up to all flux; the ledger counts them
    bool counts = false;        // and how many photons each of them has by texel
    bool hasIntensity = false;  // and what goes to the eye, W/sr; the eye's view alone
    // And the flux of all channels times 1 + the direction in which it arrives, eye view space: its
    // mean is what a glossy receiver needs where the eye's is not known yet.
    bool hasDirection = false;
    // Of the intensity or the direction.
    [[nodiscard]] int last() const { return flux; }
    [[nodiscard]] int perView() const { return flux + (hasIntensity || hasDirection ? 1 : 0); }
};

// Flux that has arrived, W a texel, on what some views see: sums that depend neither on the order
// nor on the batches of what was added. Names in shaders: include/maps/flux_sum.glsl.
struct FluxMap {
    graph::Texture<FluxWord> flux;
    graph::Texture<PhotonCountTexel> counts;  // array, a layer a set of flux; where `sets` has them
    // What a filter has made of it, in floats: a layer of flux a view, and one of what the last
    // set holds; invalid before.
    graph::Texture<FilteredTexel> filtered;
    FluxSets sets;
    ReceiverView on;
    int light = -1;      // whose photons alone it holds; -1: all lights'
    int generator = -1;  // the same of what they have left last; -1: of all
    // Which of its light's maps: those after the first hold a part of the same light again, in
    // finer texels, each map a part of the one before.
    int cascade = 0;
    // Layers of `filtered` and of `flux` that each view has.
    [[nodiscard]] int filteredPerView() const { return 1 + sets.perView() - sets.flux; }
    [[nodiscard]] int wordsPerView() const {
        return static_cast<int>(transport::kFluxWords) * sets.perView();
    }

    // For a pass that adds to what `before` holds, as the images "fluxSums" and, where there are
    // counts, "photonCounts"; where `before` is invalid, to a new map, which the pass has to clear
    // first.
    static FluxMap deposit(graph::PassSetup& setup, const FluxMap& before, const ReceiverView& on,
                           const FluxSets& sets, const std::string& name);
};

// All the light of a frame that has arrived: one map on the screen, or one of each light.
struct CausticMap {
    std::vector<FluxMap> maps;
    Ledger ledger;
};

// In screen space, at the eye buffer's receivers.
struct IrradianceMap {
    graph::Texture<IrradianceTexel> irradiance;
    Ledger ledger;
    // The same light toward the eye (transport/brdf.h); invalid where no receiver is glossy.
    graph::Texture<RadianceTexel> radiance;
};

struct Radiance {
    graph::Texture<RadianceTexel> radiance;
};

// Caustic light that the medium scatters once towards the eye along the straight eye ray, with the
// transmittance to the eye; invalid where the scene has no medium that scatters.
struct InScattered {
    graph::Texture<RadianceTexel> radiance;
    // The sums that it is made of, in fixed point, for nodes that add to them (K06, section 3.2).
    graph::Texture<FluxWord> sums;
};

// Which direct light reaches the receivers; invalid where the scene has no light.
struct Shadows {
    graph::Texture<VisibilityTexel> visibility;  // array, a layer a light
};

// What the eye sees through or in specular objects, and where its transmitted rays left them for
// good; the latter is invalid where a node does not follow rays.
struct View {
    graph::Texture<RadianceTexel> radiance;
    graph::Texture<ExitPosition> exitPosition;
    graph::Texture<ExitDirection> exitDirection;
};

// All light that the picture is made of.
struct LightParts {
    Shadows shadows;
    IrradianceMap caustic;
    InScattered inScattered;
    CausticMap map;  // without maps where no light is stored
};

struct Picture {
    graph::Texture<RadianceTexel> radiance;
    graph::Texture<DisplayTexel> display;
    View view;
};

}  // namespace kaustik
