// SPDX-License-Identifier: MIT
// The stages of every technique as types: what each takes and gives (framework/README.md, "Stages,
// nodes, techniques"). A node is one answer to a stage; handles are the only thing that connects
// two nodes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/graph.h"
#include "framework/transport/light_cells.h"
#include "framework/transport/types.h"

namespace kaustik {

namespace render {
class RasterViews;
}

using graph::Format;
// The views that textures were rasterised in; those of cubes hold their faces one after the other.
using Views = std::shared_ptr<const render::RasterViews>;

// What one texel means. Textures are read by texelFetch; (0, 0) is the lower left.
struct ViewDepth {  // x: view depth in m, 0 none; y: half of its extent over the pixel, m
    static constexpr Format format = Format::rg32f;
};
struct SurfaceTexel {  // xyz: outward shading normal in view space; w: material + 1, 0 none
    static constexpr Format format = Format::rgba32f;
};
struct SquarePlane {  // xyz: 1/z in a square's middle, 1/m, 0 empty, and its growth a pixel; w: how
                      // far from that plane a ray may hit the layer
    static constexpr Format format = Format::rgba32f;
};
// All that a hit test asks of a layer, in one place. x: view depth in m, 0 none; yz: the triangle's
// outward unit normal, octahedral (include/octahedral.glsl); w: material + 1.
struct LayerTexel {
    static constexpr Format format = Format::rgba32f;
};
struct ReceiverTexel {  // x: view depth in m, 0 none; y: area of the surface that the pixel sees,
                        // m²
    static constexpr Format format = Format::rg32f;
};
struct AlbedoTexel {  // rgb: reflectance
    static constexpr Format format = Format::rgba16f;
};
struct DepthBuffer {
    static constexpr Format format = Format::depth32f;
};
struct PhotonPosition {  // xyz: view space, m; w: footprint, m
    static constexpr Format format = Format::rgba32f;
};
struct PhotonDirection {  // xyz: unit, view space; w: fate
    static constexpr Format format = Format::rgba32f;
};
struct PhotonFlux {  // rgb: W; w: media
    static constexpr Format format = Format::rgba32f;
};
struct OriginTexel {  // transport::PhotonOrigin
    static constexpr Format format = Format::rgba32ui;
};
// How a photon's ray differs from that of the next cell of its light's grid, in
// include/beam.glsl's basis across its direction. xy: a cell along u; zw: along v.
struct BeamPlace {  // m a cell
    static constexpr Format format = Format::rgba32f;
};
struct BeamTurn {  // of the direction, rad a cell
    static constexpr Format format = Format::rgba32f;
};
// What of its cell, and of cells beside it that are no photon's, a photon stands for
// (include/cell_extent.glsl); 0: its cell.
struct CellExtentTexel {
    static constexpr Format format = Format::rg32ui;
};
struct HitPosition {  // xyz: view space, m; w: distance travelled, m
    static constexpr Format format = Format::rgba32f;
};
struct HitSurface {  // xyz: outward normal; w: material + 1
    static constexpr Format format = Format::rgba32f;
};
// How the normal of a specular surface turns: x, y along the vectors of include/beam.glsl's basis
// across it, z between them, 1/m.
struct HitShape {
    static constexpr Format format = Format::rgba32f;
};
struct HitFlux {  // rgb: W that arrive; w: fate
    static constexpr Format format = Format::rgba32f;
};
struct FluxWord {  // array: words of sums in fixed point (transport::kFluxWords)
    static constexpr Format format = Format::r32ui;
};
struct PhotonCountTexel {  // array: photons
    static constexpr Format format = Format::r32ui;
};
struct FilteredTexel {  // array: as sets of a map of flux, rgb: W, or W/sr
    static constexpr Format format = Format::rgba32f;
};
struct IrradianceTexel {  // rgb: W/m²
    static constexpr Format format = Format::rgba32f;
};
struct RadianceTexel {  // rgb: W/m²/sr
    static constexpr Format format = Format::rgba32f;
};
struct DisplayTexel {  // rgb: display-encoded (sRGB), [0,1]
    static constexpr Format format = Format::rgba8;
};

struct VisibilityTexel {  // x: share of a light's direct light that reaches the receiver, [0, 1]
    static constexpr Format format = Format::r32f;
};
// Which layer of a texel is in which slot, four bits a slot from the lowest; 15: none.
struct LayerOrderTexel {
    static constexpr Format format = Format::r32ui;
};
struct ExitPosition {  // xyz: view space, m; w: specular surfaces that the eye's ray hit, 0 none
    static constexpr Format format = Format::rgba32f;
};
struct ExitDirection {  // xyz: unit, view space; w: how the ray's path has ended, kPath…
    static constexpr Format format = Format::rgba32f;
};

using Ledger = graph::Buffer<transport::LedgerEntry>;

// Vertices that are made on the GPU each frame; invalid where the scene has none.
struct Geometry {
    graph::Buffer<transport::VertexData> heightFields;
};

// Where light can be stored: the first diffuse or glossy surface on each pixel's straight ray,
// dielectrics being invisible to it; a pixel that ends on a mirror has none. 2D, or of a cube
// arrays.
struct ReceiverView {
    graph::Texture<ReceiverTexel> receiver;
    graph::Texture<SurfaceTexel> receiverSurface;  // where the ray ends on a mirror, the mirror's
    graph::Texture<AlbedoTexel> receiverAlbedo;
    Views views;
};

// What the eye sees.
struct EyeBuffer : ReceiverView {
    // The first specular surface in front of the receiver; invalid where the scene has none.
    graph::Texture<ViewDepth> interface;
    graph::Texture<SurfaceTexel> interfaceSurface;
};

// All surfaces along each pixel's ray, front to back (K06, section 2.2). Of a cube the arrays hold
// `layers` for each face.
struct LayeredDepth {
    graph::Texture<LayerTexel> depth;      // array, one layer a surface
    graph::Texture<SurfaceTexel> surface;  // array
    graph::Texture<SquarePlane> pyramid;   // array; planes of the layers over squares of pixels
    graph::Buffer<transport::LayerStatistics> statistics;
    int layers = 0;
    Views views;
};

// All surfaces around a caustic generator, as its reference point sees them (U08, section 3).
struct SurfacesAround {
    LayeredDepth layers;                    // of a cube
    graph::Texture<LayerOrderTexel> order;  // array, a layer a face
};

// The paths that photons stand for, of all that light takes: what a technique claims to model. The
// reference can be restricted to the same.
struct ModelledPaths {
    bool transmissionOnly = false;  // at dielectrics the refracted branch, unless all is reflected
    int interactions = 0;           // most specular interactions of a photon
    bool end = false;               // whoever sent the photons on cannot do so again
};

// What a technique's nodes are given of the scene. A pass that nobody reads does not run: whoever
// is handed a surface pays for those that it reads.
struct Surfaces {
    Geometry geometry;
    EyeBuffer eye;
    LayeredDepth layers;
};

// The cells of lights' grids, or the vertices of a mesh's grid, that photons of a list stand for,
// row by row: by them neighbours are found. PhotonOrigin::cell counts from the grid's first row.
struct CellGrid {
    int width = 0;  // cells; 0: nobody has neighbours
    int firstRow = 0;
    int rows = 0;
    int firstLight = 0;
    int lights = 0;
    int splits = 0;  // a cell may have 2^splits photons in the list, told apart by so many first
                     // interactions of their paths
    [[nodiscard]] std::size_t places() const {
        return (static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) *
                static_cast<std::size_t>(lights))
               << static_cast<unsigned>(splits);
    }
};

// A list of photons, as texels of the transfer map (K06, section 2; PhotonList says how many), with
// the account of what they have lost so far. Names in shaders: include/photons.glsl.
struct Photons {
    graph::Texture<PhotonPosition> position;
    graph::Texture<PhotonDirection> direction;
    graph::Texture<PhotonFlux> flux;
    graph::Texture<OriginTexel> origin;
    // Invalid where nobody uses beams (FrameBuilder::usesBeams).
    graph::Texture<BeamPlace> beamPlace;
    graph::Texture<BeamTurn> beamTurn;
    graph::Buffer<transport::PhotonList> list;
    Ledger ledger;
    ModelledPaths paths;
    CellGrid cells;
    graph::Texture<CellExtentTexel> extents;  // by cell; invalid where each stands for itself
    // Of the textures: room for so many photons. Only the device knows how many there are.
    int width = 0;
    int height = 0;
    // Rows that suffice for those that go on: fewer where a list holds photons more than once.
    int rowsThatGoOn = 0;
    std::string batch;   // the suffix of its batch of emission
    std::string suffix;  // tells the names of its resources from those of other lists
    [[nodiscard]] int capacity() const { return width * height; }
    [[nodiscard]] bool hasBeams() const { return beamPlace.valid(); }

    // New textures, to be filled by the pass, and a new list, unless it is that of `cells`.
    static Photons create(graph::PassSetup& setup, int width, int height, const std::string& suffix,
                          bool hasBeams, const LightCells& cells = {});
    // For a pass that reads photons: "photonPosition", "photonDirection", "photonFlux",
    // "photonOrigin" and the block "Photons"; with beams, for which the shaders of the pass are
    // compiled as PHOTON_BEAMS, "photonBeamPlace" and "photonBeamTurn".
    void sample(graph::PassSetup& setup) const;
    // For a pass that makes them: images under the same names with "next" instead of "photon", and
    // the block "NextPhotons".
    void store(graph::PassSetup& setup) const;
    // For a pass that goes on filling textures that one before has created.
    void rewrite(graph::PassSetup& setup);
    [[nodiscard]] std::vector<graph::ResourceRef> textures() const;
    // What all passes do that lose flux; block "LedgerEntries".
    void account(graph::PassSetup& setup);
};

// Where photons arrived, each at the texel that it has among `incoming`.
struct Hits {
    graph::Texture<HitPosition> position;
    graph::Texture<HitSurface> surface;
    graph::Texture<HitFlux> flux;
    graph::Texture<HitShape> shape;  // where the photons have beams
    Photons incoming;                // the photons that made them

    static Hits create(graph::PassSetup& setup, const Photons& incoming);
    // "hitPosition", "hitSurface", "hitFlux", "hitShape": to read, or as images of the pass that
    // makes them.
    void sample(graph::PassSetup& setup) const;
    void store(graph::PassSetup& setup) const;
    // For a pass that goes on filling what one before has created.
    void rewrite(graph::PassSetup& setup);
    // In the order of a fragment shader's outputs.
    [[nodiscard]] std::vector<graph::ResourceRef> textures() const;
};

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
// nor on the batches of what was added. Names in shaders: include/flux_sum.glsl.
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

// Which surfaces a tracer can find. What it cannot see it cannot be expected to hit: the photon
// audit, the hard cases and nodes that trace rays of their own ask for this. flatReceivers: those
// of scene/flat_faces.h by photons outside of closed dielectrics, wherever the eye looks.
// lightFront: the first receiver that the photon's light sees in any direction. around: all that is
// larger than a texel of the faces around the generator that the photon has left.
enum class Sees { eyeLayers, everything, flatReceivers, lightFront, around };

// Which of the lights' photons (FrameBuilder::photonsOfALight) are emitted at once: rows
// [firstRow, firstRow + rows) of each light's.
struct Samples {
    int firstLight = 0;
    int lights = 1;
    int firstRow = 0;
    int rows = 1;
    std::string suffix;     // of this batch's resources; "" of the first
    Ledger ledger;          // of the batches before; invalid before the first
    LightCells cells = {};  // valid: these instead, of any light; the ledger is valid too
    bool isProbe = false;   // PhotonOrigin::cell is to be the photon's number in the list
};

// An adaptive traversal of lights' views between two of its rounds (WN09, section 3.2).
struct CellTraversal {
    graph::Buffer<transport::LightCell> waiting;  // the last ones are the next to be looked at
    LightCells taken;                             // in this round
    LightCells probes;                            // their quarters, four after one another
    LightCells photons;                           // what is to be emitted
    graph::Buffer<transport::CellCounts> counts;
    graph::Buffer<transport::Landing> landings;  // by probe and branch; where a metric needs them
    int branches = 1;                            // that a probe may land by
    float tolerance = 1.0f;                      // of the metric, texels of its view
    int checkLevel = 0;                          // of the first probes of which it is asked
    std::string suffix;                          // of its resources
    Hits first;                                  // of the probes, on specular surfaces
    Geometry geometry;
};

// What following photons leaves.
struct Caustic {
    Hits last;  // of the last tracing
    CausticMap map;
    InScattered inScattered;
    // Where the driver chooses its photons: what that has come to, once all are done.
    graph::Buffer<transport::CellCounts> cells;
};

class FrameBuilder;

// A stage is its name and its signature.
template <class Signature>
struct Stage;
template <class Out, class... In>
struct Stage<Out(In...)> {
    using Output = Out;
    using Build = std::function<Out(FrameBuilder&, In...)>;
};

struct GeometryStage : Stage<Geometry()> {
    static constexpr const char* name = "geometry";
    static constexpr const char* question = "Which vertices are made on the GPU?";
};
struct EyeStage : Stage<EyeBuffer(Geometry)> {
    static constexpr const char* name = "eye";
    static constexpr const char* question = "What does the eye see first?";
};
struct LayersStage : Stage<LayeredDepth(Geometry)> {
    static constexpr const char* name = "layers";
    static constexpr const char* question = "Which surfaces lie along each eye ray?";
};
// By generator (techniques/shared/generators.h). Run by whoever asks for it.
struct AroundStage : Stage<std::vector<SurfacesAround>(Geometry)> {
    static constexpr const char* name = "around";
    static constexpr const char* question = "Which surfaces lie around each caustic generator?";
};
// Drives the stages from emit to media: which photons are emitted, and when.
struct DriverStage : Stage<Caustic(Surfaces)> {
    static constexpr const char* name = "driver";
    static constexpr const char* question = "Which photons are followed, and in which order?";
};
struct EmitStage : Stage<Hits(Surfaces, Samples)> {
    static constexpr const char* name = "emit";
    static constexpr const char* question = "Where does light first hit a specular surface?";
};
// Of the cells that were taken: drops, splits, or makes photons of them.
struct RefineStage : Stage<CellTraversal(CellTraversal)> {
    static constexpr const char* name = "refine";
    static constexpr const char* question = "Which cells of a light's view are split further?";
};
// Gives the photons that go on, and no others, in the order of those that were there.
struct SpecularStage : Stage<Photons(Hits, Surfaces)> {
    static constexpr const char* name = "specular";
    static constexpr const char* question = "Where do photons go from a specular surface?";
};
struct TraceStage : Stage<Hits(Photons, Surfaces)> {
    static constexpr const char* name = "trace";
    static constexpr const char* question = "Which surface does each photon reach first?";
};
// Adds what arrives with these hits to what has arrived before.
struct ReconstructStage : Stage<CausticMap(Hits, Surfaces, CausticMap)> {
    static constexpr const char* name = "reconstruct";
    static constexpr const char* question = "How does flux at points become a map of flux?";
};
// Once all light has been stored.
struct FilterStage : Stage<CausticMap(CausticMap)> {
    static constexpr const char* name = "filter";
    static constexpr const char* question = "How is the map of flux smoothed?";
};
struct GatherStage : Stage<IrradianceMap(CausticMap, Surfaces)> {
    static constexpr const char* name = "gather";
    static constexpr const char* question = "What of the map do the eye's receivers get?";
};
// Once a frame, on what the eye's receivers get; what it remembers of earlier frames is its own.
struct TemporalStage : Stage<IrradianceMap(IrradianceMap, EyeBuffer)> {
    static constexpr const char* name = "temporal";
    static constexpr const char* question = "How is irradiance smoothed over time?";
};
// Adds what photons scatter on their way to these hits to what those of earlier paths did.
struct MediaStage : Stage<InScattered(Hits, EyeBuffer, InScattered)> {
    static constexpr const char* name = "media";
    static constexpr const char* question = "What does a medium scatter towards the eye?";
};
struct BlurStage : Stage<InScattered(InScattered)> {
    static constexpr const char* name = "blur";
    static constexpr const char* question = "How is in-scattered light smoothed on the screen?";
};
struct ShadowStage : Stage<Shadows(Geometry, EyeBuffer, LayeredDepth)> {
    static constexpr const char* name = "shadow";
    static constexpr const char* question = "Which receivers does direct light reach?";
};
struct ViewStage : Stage<View(Geometry, EyeBuffer, LayeredDepth, Radiance, Shadows, CausticMap)> {
    static constexpr const char* name = "view";
    static constexpr const char* question = "What does the eye see through specular surfaces?";
};
struct ComposeStage : Stage<Picture(Geometry, EyeBuffer, LayeredDepth, LightParts)> {
    static constexpr const char* name = "compose";
    static constexpr const char* question = "How do all parts become a picture?";
};

}  // namespace kaustik
