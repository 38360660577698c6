// SPDX-License-Identifier: MIT
#include "framework/gui/variant_renderer.h"

#include <algorithm>

#include "framework/core/error.h"
#include "framework/gui/pass_graph.h"
#include "framework/gui/shown_image.h"
#include "framework/gui/texture_reader.h"
#include "framework/run/output.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/run/caustic_errors.h"
#endif

namespace kaustik::gui {
namespace {

// A preview's pixels are this much larger.
constexpr int kPreviewReduction = 2;

// Of a thumbnail, pixels at most.
constexpr int kThumbnailSide = 128;

// Of so many frames times are shown.
constexpr std::size_t kFrameHistory = 128;

// All textures of a measured frame are kept for looking at where they take no more than this.
constexpr std::size_t kMaxReadableBytes = std::size_t{1} << 30;

void listResources(const Renderer& renderer, VariantResult& result) {
    result.textures.clear();
    result.buffers.clear();
    const graph::Graph& graph = renderer.graph();
    for (const std::string& name : graph.resourceNames()) {
        const graph::ResourceDesc& desc = graph.descOf(graph.find(name));
        if (const auto* texture = std::get_if<graph::TextureDesc>(&desc)) {
            result.textures.push_back({name, *texture});
        } else {
            result.buffers.push_back({name, graph::bytesOf(desc)});
        }
    }
}

}  // namespace

run::ShouldContinue VariantRenderer::stepwise(const ShouldContinue& shouldContinue) const {
    return [this, &shouldContinue](std::size_t step) {
        const std::vector<graph::Step>& steps = session_->renderer().compiled().steps;
        return shouldContinue(step, steps.size(), steps[step].name);
    };
}

void VariantRenderer::select(const Variant& variant, const params::Extent& size) {
    if (session_ && variant == variant_ && size == size_) return;
    RenderSettings settings = settingsOf(variant, size, registry_);
    if (session_) {
        session_->change(std::move(settings));
    } else {
        session_.emplace(
            context_, registry_, scene_, std::move(settings),
            run::SessionOptions{.framesKept = kFrameHistory, .leavesOutAbsentPasses = true});
    }
    variant_ = variant;
    size_ = size;
    origin_ = std::make_shared<const PictureOrigin>(PictureOrigin{scene_.name, variant, size});
}

bool VariantRenderer::guarded(const std::function<bool()>& work) {
    bool isDone = true;
    try {
        isDone = work();
        if (isDone) result_.error.clear();
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        result_.error = error.what();
        noteSceneChange();  // all is made anew for the next frame
    }
    if (session_) result_.absentPasses = session_->absentPasses();
    return isDone;
}

void VariantRenderer::keep(const Viewing& viewing) {
    std::set<std::string> names;
    if (!viewing.resource.empty()) names.insert(viewing.resource);
    if (viewing.readsOutputs) {
        session_->prepare();
        const Renderer& renderer = session_->renderer();
        if (renderer.outputs().eye.receiver.valid())
            names.insert(renderer.graph().nameOf(renderer.outputs().eye.receiver));
    }
    session_->keep(std::move(names));
}

bool VariantRenderer::render(const Variant& variant, const params::Extent& size,
                             const Viewing& viewing, bool isPrecise,
                             const ShouldContinue& shouldContinue) {
    return guarded([&] {
        isMeasured_ = false;
        select(variant, size);
        session_->setPrecise(isPrecise);
        keep(viewing);
        if (!session_->render({}, {stepwise(shouldContinue), {}}).isWhole) return false;
        readBack(viewing);
        return true;
    });
}

ViewedTexture VariantRenderer::view(const Viewing& viewing) {
    ViewedTexture viewed = readViewed(session_->renderer(), viewing.resource, viewing.layer);
    viewed.version = ++versions_;
    // That of an untouched look: the window's thread has better to do.
    static_cast<void>(histogramFor(*viewed.histograms, viewed.values, viewed.content, Look()));
    viewed.origin = origin_;
    return viewed;
}

void VariantRenderer::readBack(const Viewing& viewing) {
    const Renderer& renderer = session_->renderer();
    const report::RunRecord& record = session_->record();
    const FrameOutputs& outputs = renderer.outputs();
    ++result_.frame;
    result_.isPreview = false;
    result_.passes = renderer.compiled().records;
    result_.times = report::timesByPass(record);
    result_.frameMs.clear();
    for (const gl::FrameTime& frame : record.frames)
        result_.frameMs.push_back(frame.frameMs);
    listResources(renderer, result_);
    result_.thumbnailsOf.clear();
    result_.thumbnails.clear();
    result_.warnings = renderer.warnings();
    result_.peakBytes = renderer.compiled().peakBytes;
    result_.paths = outputs.hits.incoming.paths;
    result_.ledger.reset();
    result_.limits.clear();
    result_.violations.clear();

    result_.viewed = view(viewing);
    result_.outputTextures.clear();
    result_.outputs.reset();
#ifdef KAUSTIK_HAS_EMBREE
    if (viewing.readsOutputs && outputs.eye.receiver.valid())
        result_.outputs = std::make_shared<const run::Outputs>(run::readOutputs(renderer));
#endif
}

bool VariantRenderer::renderPreview(const Variant& variant, const params::Extent& size,
                                    const ShouldContinue& shouldContinue) {
    return guarded([&] {
        isMeasured_ = false;
        const params::Extent smaller{std::max(1, size.width / kPreviewReduction),
                                     std::max(1, size.height / kPreviewReduction)};
        select(variant, size);
        if (!session_->renderFor(Purpose::view, stepwise(shouldContinue), smaller)) return false;
        ++result_.previews;
        result_.isPreview = true;
        result_.viewed = view({});
        result_.viewed->origin =
            std::make_shared<const PictureOrigin>(PictureOrigin{scene_.name, variant, smaller});
        result_.outputs.reset();
        return true;
    });
}

// Textures that the frame makes anyway, so that keeping them asks for no pass; those that are kept
// already where all are too many.
std::vector<std::string> VariantRenderer::texturesWithRoom() const {
    const graph::Graph& graph = session_->renderer().graph();
    const graph::Compiled& compiled = session_->renderer().compiled();
    std::vector<std::string> names;
    std::size_t bytes = 0;
    for (const ListedTexture& texture : result_.textures) {
        const graph::ResourceRef handle = graph.find(texture.name);
        if (!handle.valid() || compiled.slotOf(handle) == graph::Compiled::kNowhere) continue;
        names.push_back(texture.name);
        bytes += texture.desc.bytes();
    }
    return bytes <= kMaxReadableBytes ? names : session_->keptTextures();
}

void VariantRenderer::readThumbnails(const std::string& pass) {
    result_.thumbnailsOf = pass;
    result_.thumbnails.clear();
    const auto record =
        std::find_if(result_.passes.begin(), result_.passes.end(),
                     [&](const graph::PassRecord& one) { return one.name == pass; });
    if (record == result_.passes.end()) return;
    for (const std::string& name : resourcesOf(*record)) {
        if (!readable_.contains(name)) continue;
        ViewedTexture small = reducedTo(readViewed(session_->renderer(), name, 0), kThumbnailSide);
        small.version = ++versions_;
        result_.thumbnails.push_back(std::make_shared<const ViewedTexture>(std::move(small)));
    }
}

bool VariantRenderer::canLook(const Viewing& viewing) const {
    if (!isMeasured_ || !result_.error.empty()) return false;
    if (viewing.readsOutputs && !result_.outputs) return false;
    // What there is not is not rendered either.
    return viewing.resource.empty() || readable_.contains(viewing.resource) ||
           !run::isTexture(session_->renderer(), viewing.resource);
}

void VariantRenderer::look(const Viewing& viewing) {
    const bool isSeen = result_.viewed && result_.viewed->missing == ViewedTexture::Missing::none &&
                        result_.viewed->name == viewing.resource &&
                        result_.viewed->layer == viewing.layer;
    if (!isSeen) result_.viewed = view(viewing);
    if (result_.thumbnailsOf != viewing.pass) readThumbnails(viewing.pass);
}

bool VariantRenderer::measure(const Viewing& viewing, const ShouldContinue& shouldContinue) {
    return guarded([&] {
        isMeasured_ = false;
        const std::vector<std::string> kept = texturesWithRoom();
        if (!session_->renderFor(Purpose::measurement, stepwise(shouldContinue), {}, kept))
            return false;
        readable_ = {kept.begin(), kept.end()};
        isMeasured_ = true;
        readThumbnails(viewing.pass);
        const report::RunRecord record = session_->measured();
        result_.ledger = record.ledger;
        result_.limits = report::reachedLimits(record, session_->renderer());
        result_.violations = record.violations;
        const FrameOutputs& outputs = session_->renderer().outputs();
        result_.outputTextures.clear();
        for (const std::string& name :
             {std::string(), session_->renderer().graph().nameOf(outputs.caustic.irradiance)}) {
            result_.outputTextures.push_back(
                std::make_shared<const ViewedTexture>(view({name, 0, false})));
        }
        // What the build has said is there; what has been measured comes after it.
        result_.warnings = session_->renderer().warnings();
        result_.warnings.insert(result_.warnings.end(), record.warnings.begin(),
                                record.warnings.end());
        return true;
    });
}

std::optional<PhotonProbe> VariantRenderer::probe(glm::ivec2 pixel, float radius,
                                                  const ShouldContinue& shouldContinue) {
    std::optional<PhotonProbe> found;
    guarded([&] {
        isMeasured_ = false;
        if (!session_->renderFor(Purpose::audit, stepwise(shouldContinue))) return false;
        found = probePhotons(session_->renderer(), pixel, radius);
        return true;
    });
    return found;
}

std::vector<std::string> VariantRenderer::reloadShaders() {
    return session_ ? session_->renderer().programs().reload() : std::vector<std::string>();
}

}  // namespace kaustik::gui
