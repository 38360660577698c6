// SPDX-License-Identifier: MIT
#include "framework/gui/variant_renderer.h"

#include <algorithm>

#include "framework/core/error.h"
#include "framework/gui/texture_reader.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/run/caustic_errors.h"
#endif

namespace kaustik::gui {
namespace {

// A preview's pixels are this much larger.
constexpr int kPreviewReduction = 2;

// Of so many frames times are shown.
constexpr std::size_t kFrameHistory = 128;

std::vector<ListedTexture> texturesOf(const Renderer& renderer) {
    std::vector<ListedTexture> textures;
    const graph::Graph& graph = renderer.graph();
    for (const std::string& name : graph.resourceNames()) {
        const graph::ResourceDesc& desc = graph.descOf(graph.find(name));
        if (const auto* texture = std::get_if<graph::TextureDesc>(&desc))
            textures.push_back({name, *texture});
    }
    return textures;
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
    result_.textures = texturesOf(renderer);
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
        const params::Extent smaller{std::max(1, size.width / kPreviewReduction),
                                     std::max(1, size.height / kPreviewReduction)};
        select(variant, size);
        if (!session_->renderFor(Purpose::view, stepwise(shouldContinue), smaller)) return false;
        ++result_.previews;
        result_.isPreview = true;
        result_.viewed = view({});
        result_.outputs.reset();
        return true;
    });
}

bool VariantRenderer::measure(const ShouldContinue& shouldContinue) {
    return guarded([&] {
        if (!session_->renderFor(Purpose::measurement, stepwise(shouldContinue))) return false;
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
