// SPDX-License-Identifier: MIT
// Handles of light that has arrived at receivers, and of the images that are made of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/pipeline/photons.h"
#include "framework/pipeline/surfaces.h"

namespace kaustik {

// What the sets of a map are to each other, which whoever reads it has to know. one: all flux in
// one set. sizes: all of it in each of four, of splats of four sizes (reconstruct.four_radii).
// levels: two, the map's own resolution and all coarser ones side by side, each of which has all
// flux (reconstruct.levels). sharedLevels: the same two, but each photon is in one level alone, so
// that all of them together are all flux (reconstruct.multi_level).
enum class SetLayout { one, sizes, levels, sharedLevels };

// What is kept of light for glossy receivers, which irradiance alone does not tell. intensity: what
// goes to the eye, W/sr; the eye's view alone. direction: the flux of all channels times 1 + the
// direction in which it arrives, eye view space: its mean is what a glossy receiver needs where the
// eye's is not known yet.
enum class GlossySets { none, intensity, direction };

// What a map of flux holds of each view: sets of flux, W, and where a receiver of the scene is
// glossy as many more, each of which belongs to a set of flux.
struct FluxSets {
    SetLayout layout = SetLayout::one;
    GlossySets glossy = GlossySets::none;
    bool counts = false;  // and how many photons each set of flux has by texel
    [[nodiscard]] int flux() const {
        if (layout == SetLayout::one) return 1;
        return layout == SetLayout::sizes ? 4 : 2;
    }
    // How many of them, from the first, add up to all flux; the ledger counts those.
    [[nodiscard]] int parts() const { return layout == SetLayout::sharedLevels ? 2 : 1; }
    [[nodiscard]] bool isGlossy() const { return glossy != GlossySets::none; }
    [[nodiscard]] bool hasIntensity() const { return glossy == GlossySets::intensity; }
    [[nodiscard]] bool hasDirection() const { return glossy == GlossySets::direction; }
    // The flux, and then, in the same order, what is kept for glossy receivers.
    [[nodiscard]] int perView() const { return isGlossy() ? 2 * flux() : flux(); }
};

struct PixelBlock;       // techniques/reconstruct/pixel_block.h
struct ProcessorPixels;  // techniques/reconstruct/processor_triangles.h

// Flux that has arrived, W a texel, on what some views see: sums that depend neither on the order
// nor on the batches of what was added. Names in shaders: include/maps/flux_sum.glsl.
struct FluxMap {
    graph::Texture<FluxWord> flux;
    graph::Texture<PhotonCountTexel> counts;  // array, a layer a set of flux; where `sets` has them
    // What a filter has made of it, in floats: a layer of flux a view, W, and one of what is kept
    // for glossy receivers, in the unit of its sets; invalid before.
    graph::Texture<FilteredTexel> filtered;
    // Flux that is in squares of pixels until all has come (ReconstructStage::Traits::close).
    graph::Buffer<PixelBlock> pixelBlocks;
    // The same of what the processor has put into pixels; null where the device alone puts.
    std::shared_ptr<ProcessorPixels> byProcessor;
    FluxSets sets;
    ReceiverView on;
    int light = -1;      // whose photons alone it holds; -1: all lights'
    int generator = -1;  // the same of what they have left last; -1: of all
    // The number of this map among those of its light. Those after the first hold a part of the
    // same light again, in finer texels, each map a part of the one before.
    int cascade = 0;
    // Whether there is one map of all flux to be looked up: a filter has made it, or no other was
    // stored.
    [[nodiscard]] bool isOne() const { return filtered.valid() || sets.layout == SetLayout::one; }
    // Layers of `filtered` and of `flux` that each view has.
    [[nodiscard]] int filteredPerView() const { return sets.isGlossy() ? 2 : 1; }
    [[nodiscard]] int wordsPerView() const {
        return static_cast<int>(transport::kFluxWords) * sets.perView();
    }

    // Declares what a pass does that adds to `before`, as the images "fluxSums" and, where there
    // are counts, "photonCounts". Where `before` is invalid there is a new map, which the pass has
    // to clear first.
    static FluxMap deposit(graph::PassSetup& setup, const FluxMap& before, const ReceiverView& on,
                           const FluxSets& sets, const std::string& name);
};

// All the light of a frame that has arrived: one map on the screen, or one of each light or caustic
// generator. All of them have the same sets.
struct CausticMap {
    std::vector<FluxMap> maps;
    Ledger ledger;
};

// Caustic irradiance in screen space, at the eye buffer's receivers.
struct IrradianceMap {
    graph::Texture<IrradianceTexel> irradiance;
    Ledger ledger;
    // The radiance that the same light has towards the eye (transport/brdf.h); invalid where no
    // receiver is glossy.
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

// The visibility of each light at the receivers; invalid where the scene has no light.
struct Shadows {
    graph::Texture<VisibilityTexel> visibility;  // array, a layer a light
};

// What the eye sees through or in specular objects, how its transmitted rays ended, and where they
// left for good; all but the first are invalid where a node does not follow rays. Nothing is stored
// in the last two but in a graph that one of them is asked of.
struct View {
    graph::Texture<RadianceTexel> radiance;
    graph::Texture<PathEnding> ending;
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
