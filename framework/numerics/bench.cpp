// SPDX-License-Identifier: MIT
#include "framework/numerics/bench.h"

#include <algorithm>
#include <cmath>

#include "framework/numerics/frame.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/scene/dielectrics.h"

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
Batch makeBatch(const scene::Scene& scene, const std::vector<BenchPhoton>& photons,
                std::uint32_t photonFate, std::uint32_t hitFate, BenchSize size) {
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
        const BenchPhoton& photon = photons[i];
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
    struct Data {
        Hits hits;
    };
    return frame
        .pass<Data>(
            "bench.inject", "the case makes its photons up",
            [&](graph::PassSetup& setup, Data& data) {
                const int w = batch.width;
                const int h = batch.height;
                data.hits.position = setup.create<HitPosition>("hits.position", w, h);
                data.hits.surface = setup.create<HitSurface>("hits.surface", w, h);
                data.hits.flux = setup.create<HitFlux>("hits.flux", w, h);
                Photons& photons = data.hits.incoming;
                photons.position = setup.create<PhotonPosition>("photons.position", w, h);
                photons.direction = setup.create<PhotonDirection>("photons.direction", w, h);
                photons.flux = setup.create<PhotonFlux>("photons.flux", w, h);
                photons.ledger =
                    setup.createBuffer<transport::LedgerEntry>("ledger", transport::kAccountCount);
                photons.width = w;
                photons.height = h;
            },
            [&list](const Data& data, gl::PassContext& context) {
                const Photons& photons = data.hits.incoming;
                context.buffer(photons.ledger).clear();
                context.compute("numerics/inject.comp")
                    .storage("Photons", list)
                    .image("photonPosition", photons.position)
                    .image("photonDirection", photons.direction)
                    .image("photonFlux", photons.flux)
                    .image("hitPosition", data.hits.position)
                    .image("hitSurface", data.hits.surface)
                    .image("hitFlux", data.hits.flux)
                    .dispatchOver(photons.count(), 64);
            })
        .hits;
}

// Stands for the stages that the bench leaves out.
struct Nothing {
    IrradianceMap caustic;
    Picture picture;
};
Nothing addNothing(FrameBuilder& frame, const Ledger& ledger) {
    return frame.pass<Nothing>(
        "bench.nothing", "stands for the stages that the case leaves out",
        [&](graph::PassSetup& setup, Nothing& data) {
            const int w = frame.width();
            const int h = frame.height();
            data.caustic.irradiance = setup.create<IrradianceTexel>("bench.irradiance", w, h);
            data.caustic.ledger = setup.read(ledger);
            data.picture.radiance = setup.create<RadianceTexel>("bench.radiance", w, h);
            data.picture.display = setup.create<DisplayTexel>("display", w, h);
        },
        [](const Nothing& data, gl::PassContext& context) {
            for (const graph::ResourceRef& handle : std::initializer_list<graph::ResourceRef>{
                     data.caustic.irradiance, data.picture.radiance, data.picture.display}) {
                context.texture(handle).clear({0, 0, 0, 0});
            }
        });
}

Frame renderBench(Lab& lab, const Lab::Choice& choice, const scene::Scene& scene,
                  const Settings& settings, BenchSize size, BuildFrame build) {
    Technique technique = lab.registry().findTechnique(choice.technique);
    technique.build = std::move(build);
    FrameRequest request;
    request.width = size.width;
    request.height = size.height;
    request.settings = choice.settings;
    request.settings.insert(request.settings.end(), settings.begin(), settings.end());
    return lab.render(technique, scene, request);
}

Texels readTransferMap(const Frame& frame, const graph::ResourceRef& handle) {
    return frame.read(handle);
}

std::vector<BenchHit> readHits(const Frame& frame, std::size_t count, const graph::ResourceRef& a,
                               const graph::ResourceRef& b, const graph::ResourceRef& c) {
    const Texels position = readTransferMap(frame, a);
    const Texels surface = readTransferMap(frame, b);
    const Texels flux = readTransferMap(frame, c);
    const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
    std::vector<BenchHit> hits(count);
    for (std::size_t i = 0; i < count; ++i) {
        const int x = static_cast<int>(i) % position.width;
        const int y = static_cast<int>(i) / position.width;
        hits[i].position = frame.toWorld(position.rgb(x, y));
        hits[i].distanceMeters = static_cast<double>(position.at(x, y, 3));
        hits[i].normal = back * surface.rgb(x, y);
        hits[i].material = static_cast<std::uint32_t>(surface.at(x, y, 3));
        hits[i].fluxWatts = flux.rgb(x, y);
        hits[i].fate = static_cast<std::uint32_t>(flux.at(x, y, 3));
    }
    return hits;
}

}  // namespace

std::size_t Traced::hitCount() const {
    return static_cast<std::size_t>(
        std::count_if(hits.begin(), hits.end(), [](const BenchHit& hit) { return hit.isHit(); }));
}

Traced tracePhotons(Lab& lab, const Lab::Choice& tracer, const scene::Scene& scene,
                    const std::vector<BenchPhoton>& photons, const Settings& settings,
                    BenchSize size) {
    const Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateSpecular, size);
    const Frame frame =
        renderBench(lab, tracer, scene, settings, size, [&batch](FrameBuilder& builder) {
            const Geometry geometry = builder.run<GeometryStage>();
            const EyeBuffer eye = builder.run<EyeStage>(geometry);
            const LayeredDepth layers = builder.run<LayersStage>(geometry);
            Hits hits = inject(builder, batch);
            hits = builder.run<TraceStage>(hits.incoming, layers, hits);
            const Nothing nothing = addNothing(builder, hits.incoming.ledger);
            return FrameOutputs{nothing.picture,
                                nothing.caustic,
                                eye,
                                layers,
                                hits,
                                nothing.caustic.ledger,
                                {},
                                {}};
        });
    const Hits& hits = frame.renderer().outputs().hits;
    return {readHits(frame, photons.size(), hits.position, hits.surface, hits.flux),
            frame.renderer().ledger()};
}

Traced interactPhotons(Lab& lab, const Lab::Choice& specular, const scene::Scene& scene,
                       const std::vector<BenchPhoton>& photons,
                       std::vector<std::vector<std::uint32_t>>* media) {
    const Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateSpecular, BenchSize{});
    const Frame frame = renderBench(lab, specular, scene, {}, {}, [&batch](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        Hits hits = inject(builder, batch);
        hits = builder.run<SpecularStage>(hits);
        const Nothing nothing = addNothing(builder, hits.incoming.ledger);
        return FrameOutputs{
            nothing.picture, nothing.caustic, eye, {}, hits, nothing.caustic.ledger, {}, {}};
    });
    const Photons& after = frame.renderer().outputs().hits.incoming;
    Traced result{readHits(frame, photons.size(), after.position, after.direction, after.flux),
                  frame.renderer().ledger()};
    // A photon's texels hold its fate and media where a hit's hold material and fate.
    const scene::Dielectrics dielectrics = numberDielectrics(scene);
    for (BenchHit& hit : result.hits) {
        if (media != nullptr) media->push_back(unpackMedia(dielectrics, hit.fate));
        hit.fate = hit.material;
        hit.material = 0;
    }
    return result;
}

namespace {

// Copies of the handles' texels as they are at this point of the frame.
struct Snapshot {
    graph::Texture<PhotonPosition> position;
    graph::Texture<PhotonDirection> direction;
    graph::Texture<PhotonFlux> flux;
};
Snapshot snapshot(FrameBuilder& frame, const Photons& photons, const std::string& suffix) {
    struct Data : Snapshot {
        Photons photons;
    };
    return frame.pass<Data>(
        "bench.snapshot", "what a case looks at before it is overwritten",
        [&](graph::PassSetup& setup, Data& data) {
            data.photons = photons;
            setup.read(photons.position);
            setup.read(photons.direction);
            setup.read(photons.flux);
            const int w = photons.width;
            const int h = photons.height;
            data.position = setup.create<PhotonPosition>("bench.position" + suffix, w, h);
            data.direction = setup.create<PhotonDirection>("bench.direction" + suffix, w, h);
            data.flux = setup.create<PhotonFlux>("bench.flux" + suffix, w, h);
        },
        [](const Data& data, gl::PassContext& context) {
            const auto copy = [&](const graph::ResourceRef& from, const graph::ResourceRef& to) {
                glCopyImageSubData(context.texture(from).id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                                   context.texture(to).id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                                   data.photons.width, data.photons.height, 1);
            };
            copy(data.photons.position, data.position);
            copy(data.photons.direction, data.direction);
            copy(data.photons.flux, data.flux);
        });
}

Emitted readEmitted(const Frame& frame, const std::string& suffix) {
    const Texels position = frame.read("bench.position" + suffix);
    const Texels direction = frame.read("bench.direction" + suffix);
    const Texels flux = frame.read("bench.flux" + suffix);
    const glm::dmat3 back(glm::transpose(glm::dmat3(frame.view().worldToView)));
    const scene::Dielectrics dielectrics = numberDielectrics(frame.renderer().scene());
    Emitted emitted;
    for (int y = 0; y < position.height; ++y) {
        for (int x = 0; x < position.width; ++x) {
            BenchHit hit;
            hit.position = frame.toWorld(position.rgb(x, y));
            hit.distanceMeters = 0.0;
            hit.fluxWatts = flux.rgb(x, y);
            hit.fate = static_cast<std::uint32_t>(direction.at(x, y, 3));
            emitted.hits.push_back(hit);
            emitted.directions.push_back(back * direction.rgb(x, y));
            emitted.media.push_back(
                unpackMedia(dielectrics, static_cast<std::uint32_t>(flux.at(x, y, 3))));
        }
    }
    return emitted;
}

}  // namespace

Bent emitAndInteract(Lab& lab, const Lab::Choice& emitter, const scene::Scene& scene,
                     const Settings& settings) {
    const Frame frame = renderBench(lab, emitter, scene, settings, {}, [](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        Hits hits = builder.run<EmitStage>(geometry);
        static_cast<void>(snapshot(builder, hits.incoming, "_before"));
        hits = builder.run<SpecularStage>(hits);
        static_cast<void>(snapshot(builder, hits.incoming, "_after"));
        const Nothing nothing = addNothing(builder, hits.incoming.ledger);
        return FrameOutputs{nothing.picture,
                            nothing.caustic,
                            eye,
                            LayeredDepth{},
                            hits,
                            nothing.caustic.ledger,
                            {},
                            {}};
    });
    return {readEmitted(frame, "_before"), readEmitted(frame, "_after"), frame.renderer().ledger()};
}

Emitted emitPhotons(Lab& lab, const Lab::Choice& emitter, const scene::Scene& scene,
                    const Settings& settings) {
    return emitAndInteract(lab, emitter, scene, settings).before;
}

Frame reconstructHits(Lab& lab, const Lab::Choice& reconstruct, const scene::Scene& scene,
                      const std::vector<BenchPhoton>& photons, const Settings& settings,
                      BenchSize size) {
    const Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateReceiver, size);
    return renderBench(lab, reconstruct, scene, settings, size, [&batch](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        const Hits hits = inject(builder, batch);
        const IrradianceMap caustic = builder.run<ReconstructStage>(hits, eye);
        const Nothing nothing = addNothing(builder, caustic.ledger);
        return FrameOutputs{nothing.picture, caustic, eye, {}, hits, caustic.ledger, {}, {}};
    });
}

Frame scatterPhotons(Lab& lab, const Lab::Choice& media, const scene::Scene& scene,
                     const std::vector<BenchPhoton>& photons, const Settings& settings,
                     BenchSize size) {
    Batch batch =
        makeBatch(scene, photons, transport::kFateInFlight, transport::kFateReceiver, size);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        batch.photons[i].hitPosition.w = static_cast<float>(photons[i].wayMeters);
        if (photons[i].wayMeters == 0.0)
            batch.photons[i].hitFlux.w = static_cast<float>(transport::kFateEnded);
    }
    return renderBench(lab, media, scene, settings, size, [&batch](FrameBuilder& builder) {
        const Geometry geometry = builder.run<GeometryStage>();
        const EyeBuffer eye = builder.run<EyeStage>(geometry);
        const Hits hits = inject(builder, batch);
        const InScattered scattered = builder.run<MediaStage>(hits, eye, InScattered{});
        const Nothing nothing = addNothing(builder, hits.incoming.ledger);
        return FrameOutputs{nothing.picture,        nothing.caustic, eye, {}, hits,
                            nothing.caustic.ledger, scattered,       {}};
    });
}

}  // namespace kaustik::numerics
