// SPDX-License-Identifier: MIT
// The stages of every technique as types: what each takes and gives (framework/README.md, "Stages,
// nodes, techniques"). A node is one answer to a stage; handles are the only thing that connects
// two nodes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/params/field.h"
#include "framework/pipeline/light.h"

namespace kaustik {

// Which surfaces a tracer can find. What it cannot see it cannot be expected to hit: the photon
// audit, the hard cases and nodes that trace rays of their own ask for this. flatReceivers: those
// of scene/flat_faces.h by photons outside of closed dielectrics, wherever the eye looks.
// lightFront: the first receiver that the photon's light sees in any direction. around: all that is
// larger than a texel of the faces around the generator that the photon has left.
enum class TracerReach { eyeLayers, everything, flatReceivers, lightFront, around };

// The part of the lights' photons (FrameBuilder::photonsOfALight) that is emitted at once: rows
// [firstRow, firstRow + rows) of each light's.
struct Samples {
    int firstLight = 0;
    int lights = 1;
    int firstRow = 0;
    int rows = 1;
    std::string suffix;     // of this batch's resources; "" of the first
    Ledger ledger;          // of the batches before; invalid before the first
    LightCells cells = {};  // valid: these instead, of any light; the ledger is valid too
    int borderRows = 0;     // next to these, brought along to be joined with (CellGrid::isOwn)
    // Where finer photons stand for some of the squares between four photons: cells by cells as
    // fine, `refinement` along a side. With `cells` it is they that are emitted, as LightCell has
    // squares; without, the rest: what those stand for is left out.
    int refinement = 1;
    // By square, (columns + 1) x (rows + 1) of each light of the batch: not 0 where it is refined.
    graph::Buffer<std::uint32_t> refined = {};
};

// What following photons leaves.
struct Caustic {
    Hits last;  // of the last tracing
    CausticMap map;
    InScattered inScattered;
    // What the choice of photons has come to once all are done; valid where the driver chooses
    // them.
    graph::Buffer<transport::CellCounts> cells;
};

// Rows of cells beside a batch that a reconstruction needs to know to join its own with them, and
// in how many rows at least a batch is cut, so that squares of cells which are drawn as one
// (reconstruct.triangles.merge) are whole in one batch.
constexpr int kJoinedRows = 2;
constexpr int kJoinedSquare = 16;

class FrameBuilder;

// Why a stage has nothing to do in such a frame; "" where it has, or may have.
[[nodiscard]] std::string noCausticReason(const FrameFacts& facts);
[[nodiscard]] std::string whyNoScattering(const FrameFacts& facts);
[[nodiscard]] std::string whyNoShadow(const FrameFacts& facts);
[[nodiscard]] std::string whyNothingSeenThrough(const FrameFacts& facts);

// A stage is its name, what it asks, takes and gives, in words and as a signature, and the traits
// that its nodes declare.
template <class Signature>
struct Stage;
template <class Out, class... In>
struct Stage<Out(In...)> {
    using Output = Out;
    using Build = std::function<Out(FrameBuilder&, In...)>;
    // What others need to know of a node of the stage; most stages need nothing.
    struct Traits {};
    // Why the choice of its node and all of its parameters have no effect; a stage that always has
    // one needs none.
    static constexpr std::string (*whyIdle)(const FrameFacts&) = nullptr;
};

struct GeometryStage : Stage<Geometry()> {
    static constexpr const char* name = "geometry";
    static constexpr const char* question = "Which vertices are made on the GPU?";
    static constexpr const char* takes = "the scene";
    static constexpr const char* gives = "vertices that are made on the GPU";
};
struct EyeStage : Stage<EyeBuffer(Geometry)> {
    static constexpr const char* name = "eye";
    static constexpr const char* question = "What does the eye see first?";
    static constexpr const char* takes = "geometry";
    static constexpr const char* gives =
        "eye buffer: first receiver and first specular surface of every pixel";
};
struct LayersStage : Stage<LayeredDepth(Geometry)> {
    static constexpr const char* name = "layers";
    static constexpr const char* question = "Which surfaces lie along each eye ray?";
    static constexpr const char* takes = "geometry";
    static constexpr const char* gives = "layered depth: all surfaces along every pixel's ray";
    struct Traits {
        bool tiles = false;  // it can make those of one tile of the screen alone
    };
};
// Drives the stages from emit to media: which photons are emitted, and when.
struct DriverStage : Stage<Caustic(Surfaces)> {
    static constexpr const char* name = "driver";
    static constexpr const char* question = "Which photons are followed, and in which order?";
    static constexpr const char* takes = "surfaces";
    static constexpr const char* gives =
        "map of flux, in-scattered light: runs the stages from `emit` to `media`";
    struct Traits {
        bool refines = false;  // a stage of its own says which photons there are, not emit.photons
        // The parameters by which it does: "refine.finest and refine.memory".
        std::string parameters = {};
        // Why its photons are nobody's neighbours, for a parameter's condition: they stand for
        // several cells. "" where they are; none: they always are.
        std::string (*whyNoNeighbours)(const FrameFacts&) = nullptr;
        // Its photons are known before any is traced, so that tiles of the screen can be apart.
        bool tiles = false;
    };
    static constexpr auto whyIdle = &noCausticReason;
};
struct EmitStage : Stage<Hits(Surfaces, Samples)> {
    static constexpr const char* name = "emit";
    static constexpr const char* question = "Where does light first hit a specular surface?";
    static constexpr const char* takes = "surfaces, samples";
    static constexpr const char* gives =
        "hits: where the light of one batch first hits specular surfaces";
    struct Traits {
        bool beams = false;       // its photons have beams where a node uses them
        bool emitsCells = false;  // it can be given cells one by one (Samples::cells)
        // Rows and columns of one light's photons, where emit.photons does not say it.
        std::function<params::Extent(const FrameBuilder&)> photons = {};
        std::string takes = {};  // what it does instead: "takes one photon a vertex"
    };
    static constexpr auto whyIdle = &noCausticReason;
};
// Gives the photons that go on, and no others, in the order of those that were there.
struct SpecularStage : Stage<Photons(Hits, Surfaces)> {
    static constexpr const char* name = "specular";
    static constexpr const char* question = "Where do photons go from a specular surface?";
    static constexpr const char* takes = "hits, surfaces";
    static constexpr const char* gives = "photons that go on, as a list without gaps";
    struct Traits {
        // Photons that enter a body go on from where they leave it; else one may be inside of a
        // closed dielectric when it is traced (ModelledPaths::insideBodies).
        bool throughBodies = false;
    };
    static constexpr auto whyIdle = &noCausticReason;
};
struct TraceStage : Stage<Hits(Photons, Surfaces)> {
    static constexpr const char* name = "trace";
    static constexpr const char* question = "Which surface does each photon reach first?";
    static constexpr const char* takes = "photons, surfaces";
    static constexpr const char* gives = "hits of this list";
    struct Traits {
        TracerReach reach = TracerReach::eyeLayers;
        // A photon may hit more than one surface with all of its flux: no energy balance holds.
        bool multipliesLight = false;
        // It finds no specular surface: photons inside of a body are lost to it, and are refused.
        bool onlyReceivers = false;
        // It can search the part of each ray that is on one tile of the screen
        // (LayeredDepth::tile).
        bool tiles = false;
    };
};
// Adds what arrives with these hits to what has arrived before.
struct ReconstructStage : Stage<CausticMap(Hits, Surfaces, CausticMap)> {
    static constexpr const char* name = "reconstruct";
    static constexpr const char* question = "How does flux at points become a map of flux?";
    static constexpr const char* takes = "hits, surfaces, map before";
    static constexpr const char* gives = "map of flux";
    struct Traits {
        bool beams = false;  // it uses photons' beams
        // Whether these settings of it widen them by the size of their lights.
        bool (*widensByLights)(const FrameFacts&) = nullptr;
        // It joins what neighbouring cells bring, across batches too: what one does is known from
        // those no more than kJoinedRows away.
        bool joinsCells = false;
        // The filter that makes one map of the several that it stores; "" where it stores one.
        std::string filter = {};
        // When all light has come: brings into the maps what the node keeps elsewhere until then.
        CausticMap (*close)(FrameBuilder&, CausticMap) = nullptr;
    };
    static constexpr auto whyIdle = &noCausticReason;
};
// Runs once all light has been stored.
struct FilterStage : Stage<CausticMap(CausticMap)> {
    static constexpr const char* name = "filter";
    static constexpr const char* question = "How is the map of flux smoothed?";
    static constexpr const char* takes = "map of flux";
    static constexpr const char* gives = "map of flux, in floats";
    static constexpr auto whyIdle = &noCausticReason;
};
struct GatherStage : Stage<IrradianceMap(CausticMap, Surfaces)> {
    static constexpr const char* name = "gather";
    static constexpr const char* question = "What of the map do the eye's receivers get?";
    static constexpr const char* takes = "map of flux, surfaces";
    static constexpr const char* gives = "irradiance at the eye's receivers";
    static constexpr auto whyIdle = &noCausticReason;
};
// Runs once a frame, on what the eye's receivers get. What it remembers of earlier frames is its
// own.
struct TemporalStage : Stage<IrradianceMap(IrradianceMap, EyeBuffer)> {
    static constexpr const char* name = "temporal";
    static constexpr const char* question = "How is irradiance smoothed over time?";
    static constexpr const char* takes = "irradiance, eye buffer";
    static constexpr const char* gives = "irradiance, with what earlier frames found";
    static constexpr auto whyIdle = &noCausticReason;
};
// Adds what photons scatter on their way to these hits to what those of earlier paths did.
struct MediaStage : Stage<InScattered(Hits, EyeBuffer, InScattered)> {
    static constexpr const char* name = "media";
    static constexpr const char* question = "What does a medium scatter towards the eye?";
    static constexpr const char* takes = "hits, eye buffer, in-scattered light before";
    static constexpr const char* gives =
        "in-scattered light: what a medium scatters towards the eye";
    struct Traits {
        bool beams = false;  // it uses photons' beams
    };
    static constexpr auto whyIdle = &whyNoScattering;
};
struct BlurStage : Stage<InScattered(InScattered)> {
    static constexpr const char* name = "blur";
    static constexpr const char* question = "How is in-scattered light smoothed on the screen?";
    static constexpr const char* takes = "in-scattered light";
    static constexpr const char* gives = "in-scattered light, smoothed on the screen";
    static constexpr auto whyIdle = &whyNoScattering;
};
struct ShadowStage : Stage<Shadows(Geometry, EyeBuffer, LayeredDepth)> {
    static constexpr const char* name = "shadow";
    static constexpr const char* question = "Which receivers does direct light reach?";
    static constexpr const char* takes = "geometry, eye buffer, layered depth";
    static constexpr const char* gives = "shadows: which direct light reaches the receivers";
    static constexpr auto whyIdle = &whyNoShadow;
};
struct ViewStage : Stage<View(Geometry, EyeBuffer, LayeredDepth, Radiance, Shadows, CausticMap)> {
    static constexpr const char* name = "view";
    static constexpr const char* question = "What does the eye see through specular surfaces?";
    static constexpr const char* takes =
        "geometry, eye buffer, layered depth, radiance, shadows, map of flux";
    static constexpr const char* gives = "view: what the eye sees in and through specular surfaces";
    static constexpr auto whyIdle = &whyNothingSeenThrough;
};
struct ComposeStage : Stage<Picture(Geometry, EyeBuffer, LayeredDepth, LightParts)> {
    static constexpr const char* name = "compose";
    static constexpr const char* question = "How do all parts become a picture?";
    static constexpr const char* takes = "geometry, eye buffer, layered depth, parts of the light";
    static constexpr const char* gives = "picture: radiance and a display image";
};

}  // namespace kaustik
