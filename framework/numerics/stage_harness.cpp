// SPDX-License-Identifier: MIT
#include "framework/numerics/stage_harness.h"

#include <algorithm>
#include <cmath>

#include "framework/numerics/frame.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/ledger.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/pipeline/stage_params.h"
#include "framework/scene/dielectrics.h"
#include "framework/transport/primitives.h"

namespace kaustik::numerics {
namespace {

// Six texels of the transfer map, as shaders/numerics/inject.comp reads them (std430).
struct Injected {
    glm::vec4 photonPosition{0.0f}, photonDirection{0.0f}, photonFlux{0.0f};
    glm::vec4 hitPosition{0.0f}, hitSurface{0.0f}, hitFlux{0.0f};
};

constexpr int kRowLength = 1024;

glm::vec4 texel(const glm::dvec3& xyz, double w) {
    return glm::vec4(glm::dvec4(xyz, w));
}

struct Batch {
    std::vector<Injected> photons;
    int width = 1;
    int height = 1;
};

// `photonFate` and `hitFate`: what all photons, and the hits that they come with, are.
Batch makeBatch(const scene::Scene& scene, const std::vector<StagePhoton>& photons,
                std::uint32_t photonFate, std::uint32_t hitFate, StageSize size) {
    const glm::dmat4 toView =
        render::makeEyeView(scene.camera, size.width, size.height).worldToView;
    const glm::dmat3 rotation(toView);
    const scene::Dielectrics dielectrics = numberDielectrics(scene);
    Batch batch;
    batch.width = std::clamp(static_cast<int>(photons.size()), 1, kRowLength);
    batch.height = std::max((static_cast<int>(photons.size()) + kRowLength - 1) / kRowLength, 1);
    batch.photons.resize(static_cast<std::size_t>(batch.width) *
                         static_cast<std::size_t>(batch.height));
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const StagePhoton& photon = photons[i];
        const glm::dvec3 position(toView * glm::dvec4(photon.position, 1.0));
        Injected& injected = batch.photons[i];
        injected.photonPosition = texel(position, photon.footprintMeters);
        injected.photonDirection = texel(rotation * photon.direction, photonFate);
        injected.photonFlux =
            texel(photon.fluxWatts, packMedia(dielectrics, photon.media, photon.leftSide));
        injected.hitPosition = texel(position, 0.0);
        injected.hitSurface = texel(rotation * photon.startNormal, photon.startMaterial);
        injected.hitFlux = texel(photon.fluxWatts, hitFate);
    }
    return batch;
}

Hits inject(FrameBuilder& frame, const Batch& batch) {
    const gl::Buffer& list = frame.keep(gl::Buffer(batch.photons, "injected photons"));
    return frame.pass<Hits>(
        "bench.inject", "the case makes its photons up",
        [&](graph::PassSetup& setup, Hits& hits) {
            Photons photons =
                Photons::create(setup, batch.width, batch.height, "", {frame.usesBeams()});
            photons.ledger =
                setup.createBuffer<transport::LedgerEntry>("ledger", transport::kLedgerEntryCount);
            photons.store(setup);
            hits = Hits::create(setup, photons);
            hits.store(setup);
        },
        [&list](const Hits& hits, gl::PassContext& context) {
            context.buffer(hits.incoming.ledger).clear();
            fillList(context, hits.incoming);
            for (const bool isOfHits : {false, true}) {
                gl::Command command = context.compute("numerics/inject.comp");
                if (isOfHits) command.define("INJECT_HITS");
                command.storage("InjectedPhotons", list).dispatchOver(hits.incoming.capacity(), 64);
            }
        });
}

// Stands for the stages that the bench leaves out.
struct NoData {
    IrradianceMap caustic;
    Picture picture;
};
NoData addNothing(FrameBuilder& frame, const Ledger& ledger) {
    return frame.pass<NoData>(
        "bench.nothing", "stands for the stages that the case leaves out",
        [&](graph::PassSetup& setup, NoData& data) {
            const int w = frame.width();
            const int h = frame.height();
            data.caustic.irradiance = setup.create<IrradianceTexel>("bench.irradiance", w, h);
            data.caustic.ledger = setup.read(ledger);
            data.picture.radiance = setup.create<RadianceTexel>("bench.radiance", w, h);
            data.picture.display = setup.create<DisplayTexel>("display", w, h);
        },
        [](const NoData& data, gl::PassContext& context) {
            for (const graph::ResourceRef& handle : std::initializer_list<graph::ResourceRef>{
                     data.caustic.irradiance, data.picture.radiance, data.picture.display}) {
                context.texture(handle).clear({0, 0, 0, 0});
            }
        });
}

// Keeps a list to the end of the frame, so that it can be read back.
Photons keepPhotons(FrameBuilder& frame, const Photons& photons) {
    frame.request(photons);
    return photons;
}

Frame renderBench(Lab& lab, const Lab::Choice& choice, const scene::Scene& scene,
                  const Settings& settings, StageSize size, BuildFrame build) {
    Technique technique = lab.registry().findTechnique(choice.technique);
    technique.build = std::move(build);
    FrameRequest request;
    request.width = size.width;
    request.height = size.height;
    request.settings = choice.settings;
    request.settings.insert(request.settings.end(), settings.begin(), settings.end());
    return lab.render(technique, scene, request);
}

// The case's photons and what became of them, in its own order; photons that are in no list any
// more are of fate kFateEnded.
std::vector<StageHit> stageHits(const Frame& frame, const Hits& found, std::size_t count) {
    const std::vector<PhotonTexel> photons = readPhotons(frame.renderer(), found.incoming);
    const std::vector<HitTexel> texels = readHits(frame.renderer(), found);
    const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
    std::vector<StageHit> hits(count);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const std::size_t cell = photons[i].origin.cell;
        if (cell >= count) continue;
        StageHit& hit = hits[cell];
        // Of photons that are there more than once the first one counts.
        if (hit.fate != transport::kFateNone) continue;
        hit.position = frame.toWorld(texels[i].position);
        hit.distanceMeters = static_cast<double>(texels[i].distanceMeters);
        hit.normal = back * glm::dvec3(texels[i].normal);
        hit.material = texels[i].material;
        hit.fluxWatts = texels[i].fluxWatts;
        hit.fate = texels[i].fate;
    }
    return hits;
}

}  // namespace

std::size_t Traced::hitCount() const {
    return static_cast<std::size_t>(
        std::count_if(hits.begin(), hits.end(), [](const StageHit& hit) { return hit.isHit(); }));
}

Traced tracePhotons(Lab& lab, const Lab::Choice& tracer, const scene::Scene& scene,
                    const std::vector<StagePhoton>& photons, const Settings& settings,
                    StageSize size) {
    const Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateSpecular, size);
    const Frame frame =
        renderBench(lab, tracer, scene, settings, size, [&batch](FrameBuilder& builder) {
            const Geometry geometry = builder.run<GeometryStage>();
            const EyeBuffer eye = builder.run<EyeStage>(geometry);
            const LayeredDepth layers = builder.run<LayersStage>(geometry);
            Photons injected = inject(builder, batch).incoming;
            injected.suffix = "_1";  // the case's own hits have the plain names
            const Hits hits = builder.run<TraceStage>(injected, Surfaces{geometry, eye, layers});
            builder.request(hits);
            const NoData noData =
                addNothing(builder, closeBatch(builder, hits, hits.incoming.ledger));
            return FrameOutputs{noData.picture,
                                noData.caustic,
                                eye,
                                layers,
                                hits,
                                noData.caustic.ledger,
                                {},
                                {},
                                {},
                                {}};
        });
    return {stageHits(frame, frame.renderer().outputs().hits, photons.size()),
            frame.renderer().ledger()};
}

Traced interactPhotons(Lab& lab, const Lab::Choice& specular, const scene::Scene& scene,
                       const std::vector<StagePhoton>& photons,
                       std::vector<std::vector<std::uint32_t>>* media) {
    const Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateSpecular, StageSize{});
    Photons after;
    const Frame frame = renderBench(lab, specular, scene, {}, {}, [&](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        after = keepPhotons(builder, builder.run<SpecularStage>(inject(builder, batch),
                                                                Surfaces{geometry, eye, {}}));
        const NoData noData = addNothing(builder, after.ledger);
        return FrameOutputs{
            noData.picture, noData.caustic, eye, {}, {}, noData.caustic.ledger, {}, {}, {}, {}};
    });
    const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
    const scene::Dielectrics dielectrics = numberDielectrics(scene);
    Traced result{std::vector<StageHit>(photons.size()), frame.renderer().ledger()};
    std::vector<std::uint32_t> mediaOf(photons.size(), 0);
    for (StageHit& hit : result.hits)
        hit.fate = transport::kFateEnded;
    for (const PhotonTexel& photon : readPhotons(frame.renderer(), after)) {
        // The branch that a node follows first; the other branch of a split comes after it.
        if (photon.origin.cell >= photons.size()) continue;
        StageHit& hit = result.hits[photon.origin.cell];
        if (hit.fate != transport::kFateEnded) continue;
        hit.position = frame.toWorld(photon.position);
        hit.distanceMeters = static_cast<double>(photon.footprintMeters);
        hit.normal = back * glm::dvec3(photon.direction);
        hit.fluxWatts = photon.fluxWatts;
        hit.fate = photon.fate;
        mediaOf[photon.origin.cell] = photon.media;
    }
    if (media != nullptr) {
        for (const std::uint32_t one : mediaOf)
            media->push_back(unpackMedia(dielectrics, one));
    }
    return result;
}

namespace {

// By the numbers that the emitter gave them.
Emitted emittedOf(const Frame& frame, const Photons& photons, std::size_t cells) {
    const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
    const scene::Dielectrics dielectrics = numberDielectrics(frame.renderer().scene());
    Emitted emitted;
    emitted.hits.resize(cells);
    emitted.directions.resize(cells);
    emitted.media.resize(cells);
    // The lights follow one another.
    const std::size_t lights = std::max<std::size_t>(frame.renderer().scene().lights.size(), 1);
    for (const PhotonTexel& photon : readPhotons(frame.renderer(), photons)) {
        const std::size_t cell = photon.origin.light * (cells / lights) + photon.origin.cell;
        if (photon.fate == transport::kFateNone) continue;
        StageHit& hit = emitted.hits[cell];
        // The branch that a node takes first; the other one of a split comes after it.
        if (hit.fate != transport::kFateNone) continue;
        hit.position = frame.toWorld(photon.position);
        hit.distanceMeters = 0.0;
        hit.fluxWatts = photon.fluxWatts;
        hit.fate = photon.fate;
        emitted.directions[cell] = back * glm::dvec3(photon.direction);
        emitted.media[cell] = unpackMedia(dielectrics, photon.media);
    }
    return emitted;
}

}  // namespace

Bent emitAndInteract(Lab& lab, const Lab::Choice& emitter, const scene::Scene& scene,
                     const Settings& settings) {
    Photons before;
    Photons after;
    const Frame frame = renderBench(lab, emitter, scene, settings, {}, [&](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        const Hits hits = builder.run<EmitStage>(
            Surfaces{geometry, eye, {}},
            Samples{0, builder.needs().photonLights, 0, builder.photonsOfALight().height, "", {}});
        before = keepPhotons(builder, hits.incoming);
        after = keepPhotons(builder, builder.run<SpecularStage>(hits, Surfaces{geometry, eye, {}}));
        const NoData noData = addNothing(builder, after.ledger);
        return FrameOutputs{
            noData.picture, noData.caustic, eye, {}, {}, noData.caustic.ledger, {}, {}, {}, {}};
    });
    const auto cells = static_cast<std::size_t>(before.capacity());
    return {emittedOf(frame, before, cells), emittedOf(frame, after, cells),
            frame.renderer().ledger()};
}

Emitted emitPhotons(Lab& lab, const Lab::Choice& emitter, const scene::Scene& scene,
                    const Settings& settings) {
    return emitAndInteract(lab, emitter, scene, settings).before;
}

Frame reconstructHits(Lab& lab, const Lab::Choice& reconstruct, const scene::Scene& scene,
                      const std::vector<StagePhoton>& photons, const Settings& settings,
                      StageSize size) {
    const Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateReceiver, size);
    return renderBench(lab, reconstruct, scene, settings, size, [&batch](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        const Hits hits = inject(builder, batch);
        const Surfaces surfaces{geometry, eye, {}};
        const CausticMap map =
            builder.run<FilterStage>(builder.run<ReconstructStage>(hits, surfaces, CausticMap{}));
        const IrradianceMap caustic = builder.run<GatherStage>(map, surfaces);
        const NoData noData = addNothing(builder, caustic.ledger);
        return FrameOutputs{noData.picture, caustic, eye, {},  hits,
                            caustic.ledger, {},      {},  map, {}};
    });
}

StoredFlux readStored(const Frame& frame, int set) {
    const FluxMap& map = frame.renderer().outputs().map.maps.front();
    const gl::Texture& texture = frame.renderer().texture(map.flux);
    const std::vector<std::uint32_t> words = texture.readWords();
    const double quantum = static_cast<double>(ledgerQuantum(frame.renderer().scene()));
    StoredFlux stored{texture.desc().width, texture.desc().height, {}};
    const auto layer = static_cast<std::size_t>(stored.width * stored.height);
    // Two words a channel, the lower one first; green is the second.
    const std::size_t low = layer * (transport::kFluxWords * static_cast<std::size_t>(set) + 2);
    for (std::size_t i = 0; i < layer; ++i) {
        stored.watts.push_back(
            (static_cast<double>(words[low + layer + i]) * 4294967296.0 + words[low + i]) *
            quantum);
    }
    return stored;
}

double StoredFlux::in(int x0, int y0, int x1, int y1) const {
    double sum = 0.0;
    for (int y = std::max(y0, 0); y < std::min(y1, height); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x1, width); ++x)
            sum += watts[static_cast<std::size_t>(y * width + x)];
    }
    return sum;
}

Frame scatterPhotons(Lab& lab, const Lab::Choice& media, const scene::Scene& scene,
                     const std::vector<StagePhoton>& photons, const Settings& settings,
                     StageSize size) {
    Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateReceiver, size);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        batch.photons[i].hitPosition.w = static_cast<float>(photons[i].pathMeters);
        if (photons[i].pathMeters == 0.0)
            batch.photons[i].hitFlux.w = static_cast<float>(transport::kFateEnded);
    }
    return renderBench(lab, media, scene, settings, size, [&batch](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        const Hits hits = inject(builder, batch);
        const InScattered scattered = builder.run<MediaStage>(hits, eye, InScattered{});
        const NoData noData = addNothing(builder, hits.incoming.ledger);
        return FrameOutputs{noData.picture,        noData.caustic, eye, {}, hits,
                            noData.caustic.ledger, scattered,      {},  {}, {}};
    });
}

}  // namespace kaustik::numerics
