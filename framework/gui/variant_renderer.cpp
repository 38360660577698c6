// SPDX-License-Identifier: MIT
#include "framework/gui/variant_renderer.h"

#include <algorithm>

#include "framework/core/error.h"
#include "framework/run/output.h"
#include "framework/run/run_record.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/run/caustic_errors.h"
#endif

namespace kaustik::gui {
namespace {

// A preview's pixels are this much larger.
constexpr int kPreviewReduction = 2;

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

bool isTexture(const Renderer& renderer, const std::string& name) {
    const graph::ResourceRef handle = renderer.graph().find(name);
    return handle.valid() &&
           std::holds_alternative<graph::TextureDesc>(renderer.graph().descOf(handle));
}

}  // namespace

std::function<bool(std::size_t)> VariantRenderer::stepwise(const GoesOn& goesOn) const {
    const std::vector<graph::Step>& steps = renderer_->compiled().steps;
    return [&goesOn, &steps](std::size_t step) {
        return goesOn(step, steps.size(), steps[step].name);
    };
}

void VariantRenderer::prepare(const Variant& variant, const params::Extent& size) {
    if (renderer_ && isUpToDate_ && variant == variant_ && size == size_) return;
    RenderSettings settings = settingsOf(variant, size, registry_);
    if (!(variant == variant_ && size == size_)) {
        record_.frames.clear();
        // Nor is one that the device has still to finish of the new settings.
        if (timer_) static_cast<void>(timer_->takeFinished(true));
    }
    built_.clear();
    if (renderer_) {
        renderer_->update(std::move(settings));
    } else {
        renderer_ = std::make_unique<Renderer>(context_, registry_, scene_, std::move(settings));
    }
    result_.absentPasses = renderer_->forgetAbsentPasses();
    variant_ = variant;
    size_ = size;
    isUpToDate_ = true;
}

bool VariantRenderer::guarded(const std::function<bool()>& work) {
    try {
        const bool isWhole = work();
        if (isWhole) result_.error.clear();
        return isWhole;
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        result_.error = error.what();
        isUpToDate_ = false;
        return true;
    }
}

void VariantRenderer::restartTimes(gl::TimerMode timer) {
    const report::RunRecord now = run::startRecord(*renderer_, timer);
    if (now.stepNames != record_.stepNames || now.timer != record_.timer || !timer_) {
        timer_ = std::make_unique<gl::PassTimer>(timer);
        record_.frames.clear();
    }
    std::vector<gl::FrameTime> frames = std::move(record_.frames);
    record_ = now;
    record_.frames = std::move(frames);
}

bool VariantRenderer::render(const Variant& variant, const params::Extent& size,
                             const Viewing& viewing, gl::TimerMode timer, const GoesOn& goesOn) {
    return guarded([&] {
        prepare(variant, size);
        const std::string wanted =
            "picture " + viewing.resource + (viewing.readsOutputs ? "+" : "");
        if (built_ != wanted) {
            renderer_->build(Purpose::picture);
            std::vector<std::string> kept;
            if (!viewing.resource.empty() && isTexture(*renderer_, viewing.resource))
                kept.push_back(viewing.resource);
            if (viewing.readsOutputs && renderer_->outputs().eye.receiver.valid())
                kept.push_back(renderer_->graph().nameOf(renderer_->outputs().eye.receiver));
            if (!kept.empty()) renderer_->build(Purpose::picture, kept);
            built_ = wanted;
        }
        restartTimes(timer);
        if (!renderer_->renderFrame(*timer_, stepwise(goesOn))) return false;
        for (gl::FrameTime& frame : timer_->takeFinished())
            record_.frames.push_back(std::move(frame));
        if (record_.frames.size() > kFramesKept) {
            record_.frames.erase(record_.frames.begin(),
                                 record_.frames.end() - static_cast<std::ptrdiff_t>(kFramesKept));
        }
        readBack(viewing);
        return true;
    });
}

ViewedTexture VariantRenderer::viewPicture() {
    const Picture& picture = renderer_->outputs().picture;
    ViewedTexture viewed;
    viewed.version = ++versions_;
    viewed.isEncoded = true;
    viewed.values = run::readTexture(renderer_->texture(picture.display), 0, 3);
    // What is no number is black in a picture, and no other black.
    viewed.checked = renderer_->graph().nameOf(picture.radiance);
    viewed.notFinite =
        measure::findNotFinite(run::readTexture(renderer_->texture(picture.radiance), 0, 3));
    viewed.histogram = histogramOf(viewed.values);
    return viewed;
}

ViewedTexture VariantRenderer::view(const Viewing& viewing) {
    if (viewing.resource.empty()) return viewPicture();
    if (!isTexture(*renderer_, viewing.resource)) {
        ViewedTexture picture = viewPicture();
        picture.missing = ViewedTexture::Missing::texture;
        return picture;
    }
    const gl::Texture& texture = renderer_->texture(renderer_->graph().find(viewing.resource));
    ViewedTexture viewed;
    viewed.name = viewing.resource;
    viewed.version = ++versions_;
    viewed.layer = viewing.layer;
    viewed.layers = std::max(texture.desc().layers, 1);
    viewed.checked = viewing.resource;
    if (viewing.layer >= viewed.layers) {
        viewed.missing = ViewedTexture::Missing::layer;
        return viewed;
    }
    viewed.values =
        run::readTexture(texture, viewing.layer, gl::formatInfo(texture.desc().format).channels);
    viewed.notFinite = measure::findNotFinite(viewed.values);
    viewed.histogram = histogramOf(viewed.values);
    return viewed;
}

void VariantRenderer::readBack(const Viewing& viewing) {
    const FrameOutputs& outputs = renderer_->outputs();
    ++result_.frame;
    result_.isPreview = false;
    result_.passes = renderer_->compiled().records;
    result_.times = report::timesByPass(record_);
    result_.frameMs.clear();
    for (const gl::FrameTime& frame : record_.frames)
        result_.frameMs.push_back(frame.frameMs);
    result_.textures = texturesOf(*renderer_);
    result_.warnings = renderer_->warnings();
    for (const std::string& name : run::unusedSettings(*renderer_))
        result_.warnings.push_back(name + " was set, but no node in use reads it.");
    result_.peakBytes = renderer_->compiled().peakBytes;
    result_.paths = outputs.hits.incoming.paths;
    result_.ledger.reset();
    result_.limits.clear();

    result_.viewed = view(viewing);
    result_.outputs.reset();
#ifdef KAUSTIK_HAS_EMBREE
    if (viewing.readsOutputs && outputs.eye.receiver.valid())
        result_.outputs = std::make_shared<const run::Outputs>(run::readOutputs(*renderer_));
#endif
}

bool VariantRenderer::renderPreview(const Variant& variant, const params::Extent& size,
                                    const GoesOn& goesOn) {
    return guarded([&] {
        const params::Extent smaller{std::max(1, size.width / kPreviewReduction),
                                     std::max(1, size.height / kPreviewReduction)};
        std::vector<gl::FrameTime> times = record_.frames;
        const bool keepsTimes = variant == variant_;
        prepare(variant, smaller);
        if (keepsTimes) record_.frames = std::move(times);
        renderer_->build(Purpose::view);
        built_.clear();
        gl::PassTimer untimed(gl::TimerMode::finish);
        if (!renderer_->renderFrame(untimed, stepwise(goesOn))) return false;
        ++result_.previews;
        result_.isPreview = true;
        result_.viewed = viewPicture();
        result_.outputs.reset();
        // The next whole frame is of the same settings: its times go on from these.
        variant_ = variant;
        size_ = size;
        isUpToDate_ = false;
        return true;
    });
}

bool VariantRenderer::measure(const GoesOn& goesOn) {
    return guarded([&] {
        renderer_->build(Purpose::measurement);
        built_.clear();
        gl::PassTimer untimed(gl::TimerMode::finish);
        if (!renderer_->renderFrame(untimed, stepwise(goesOn))) return false;
        report::RunRecord record = record_;
        record.ledger = renderer_->ledger();
        record.layers = renderer_->layerStatistics();
        record.layersAllowed = renderer_->outputs().layers.layers;
        record.nodeLimits = renderer_->reachedLimits();
        result_.ledger = record.ledger;
        result_.limits = report::reachedLimits(record, *renderer_);
        return true;
    });
}

std::optional<PhotonProbe> VariantRenderer::probe(glm::ivec2 pixel, float radius,
                                                  const GoesOn& goesOn) {
    std::optional<PhotonProbe> found;
    guarded([&] {
        renderer_->build(Purpose::audit);
        built_.clear();
        gl::PassTimer untimed(gl::TimerMode::finish);
        if (!renderer_->renderFrame(untimed, stepwise(goesOn))) return false;
        found = probePhotons(*renderer_, pixel, radius);
        return true;
    });
    return found;
}

std::vector<std::string> VariantRenderer::reloadShaders() {
    return renderer_ ? renderer_->programs().reload() : std::vector<std::string>();
}

}  // namespace kaustik::gui
