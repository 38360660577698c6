// SPDX-License-Identifier: MIT
// Handles of photons and of their hits, as lists in textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/graph/graph.h"
#include "framework/transport/light_cells.h"
#include "framework/transport/texels.h"
#include "framework/transport/types.h"

namespace kaustik {

using Ledger = graph::Buffer<transport::LedgerEntry>;

// The paths that photons stand for, of all that light takes: what a technique claims to model. The
// reference can be restricted to the same.
struct ModelledPaths {
    bool transmissionOnly = false;  // at dielectrics the refracted branch, unless all is reflected
    bool reflectionOnly = false;    // at dielectrics the reflected branch
    int interactions = 0;           // most specular interactions of a photon
    bool end = false;               // whoever sent the photons on cannot do so again
    // Some may be inside of closed dielectrics: only a tracer that finds specular surfaces has a
    // way out for them.
    bool insideBodies = false;
};

// The cells of lights' grids, or the vertices of a mesh's grid, that photons of a list stand for,
// row by row: by them neighbours are found. PhotonOrigin::cell counts from the grid's first row.
struct CellGrid {
    int width = 0;  // cells; 0: photons have no neighbours
    int firstRow = 0;
    int rows = 0;
    int firstLight = 0;
    int lights = 0;
    // Rows that are the list's own, of the grid, from and before; what is around them other batches
    // bring as well, and here it is only to be joined with.
    int firstOwn = 0;
    int endOwn = 0;
    int splits = 0;  // a cell may have 2^splits photons in the list, told apart by so many first
                     // interactions of their paths
    [[nodiscard]] bool isOwn(std::uint32_t cell) const {
        const auto row = width > 0 ? static_cast<int>(cell) / width : 0;
        return width == 0 || (row >= firstOwn && row < endOwn);
    }
    [[nodiscard]] std::size_t places() const {
        return (static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) *
                static_cast<std::size_t>(lights))
               << static_cast<unsigned>(splits);
    }
};

// What photons of a list have next to place, direction and flux.
struct PhotonExtras {
    bool beams = false;
    bool lightSpread = false;
};

// A list of photons, as texels of the transfer map (K06, section 2; PhotonList says how many), with
// the account of what they have lost so far. Names in shaders: include/photons/photons.glsl.
struct Photons {
    graph::Texture<PhotonPosition> position;
    graph::Texture<PhotonDirection> direction;
    graph::Texture<PhotonFlux> flux;
    graph::Texture<OriginTexel> origin;
    // Both are invalid where no node uses beams (FrameBuilder::usesBeams).
    graph::Texture<BeamPlace> beamPlace;
    graph::Texture<BeamTurn> beamTurn;
    // How the disc that the photon's light stands for spreads it; invalid where none does
    // (FrameBuilder::widensByLights).
    graph::Texture<BeamPlace> spreadPlace;
    graph::Texture<BeamTurn> spreadTurn;
    graph::Buffer<transport::PhotonList> list;
    Ledger ledger;
    ModelledPaths paths;
    CellGrid cells;
    graph::Texture<CellExtentTexel> extents;  // by cell; invalid where each stands for itself
    // The size of the textures, which have room for so many photons. Only the device knows how many
    // there are.
    int width = 0;
    int height = 0;
    // Rows that suffice for those that go on: fewer where a list holds photons more than once.
    int nextRows = 0;
    std::string batch;   // the suffix of its batch of emission
    std::string suffix;  // tells the names of its resources from those of other lists
    [[nodiscard]] int capacity() const { return width * height; }
    [[nodiscard]] bool hasBeams() const { return beamPlace.valid(); }
    [[nodiscard]] bool hasLightSpread() const { return spreadPlace.valid(); }
    [[nodiscard]] PhotonExtras extras() const { return {hasBeams(), hasLightSpread()}; }

    // New textures, to be filled by the pass, and a new list, unless it is that of `cells`.
    static Photons create(graph::PassSetup& setup, int width, int height, const std::string& suffix,
                          PhotonExtras extras, const LightCells& cells = {});
    // New textures for how lights spread them.
    void createSpread(graph::PassSetup& setup);
    // Declares what a pass reads of photons: "photonPosition", "photonDirection", "photonFlux",
    // "photonOrigin" and the block "Photons"; with beams, for which the shaders of the pass are
    // compiled as PHOTON_BEAMS, also "photonBeamPlace" and "photonBeamTurn"; with the spread of
    // their lights, as LIGHT_SPREAD, "photonSpreadPlace" and "photonSpreadTurn".
    void sample(graph::PassSetup& setup) const;
    // Declares what a pass writes that makes photons: images under the same names with "next"
    // instead of "photon", and the block "NextPhotons".
    void store(graph::PassSetup& setup) const;
    // Declares that a pass goes on filling textures that an earlier pass has created.
    void rewrite(graph::PassSetup& setup);
    [[nodiscard]] std::vector<graph::ResourceRef> textures() const;
    // What all passes do that lose flux; block "LedgerEntries".
    void account(graph::PassSetup& setup);
};

// The places where photons arrived, each at the texel that the photon has in `incoming`.
struct Hits {
    graph::Texture<HitPosition> position;
    graph::Texture<HitSurface> surface;
    graph::Texture<HitFlux> flux;
    graph::Texture<HitShape> shape;  // where the photons have beams
    Photons incoming;                // the photons that made them
    graph::Texture<HitOrder> order;  // where one tile of the screen was searched alone

    static Hits create(graph::PassSetup& setup, const Photons& incoming);
    // "hitPosition", "hitSurface", "hitFlux", "hitShape": to read, or as images of the pass that
    // makes them.
    void sample(graph::PassSetup& setup) const;
    void store(graph::PassSetup& setup) const;
    // Declares that a pass goes on filling what an earlier pass has created.
    void rewrite(graph::PassSetup& setup);
    // The textures in the order of a fragment shader's outputs.
    [[nodiscard]] std::vector<graph::ResourceRef> textures() const;
};

}  // namespace kaustik
