// SPDX-License-Identifier: MIT
#include "framework/gui/render_worker.h"

#include <algorithm>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/gui/priority.h"
#include "framework/gui/render_worker_device.h"

namespace kaustik::gui {
namespace {

using namespace std::chrono_literals;

constexpr auto kIdle = 300ms;  // between looks at the shaders' files
// After so many frames the ledger and the photons are looked at, also where frames go on for ever.
constexpr int kFramesBeforeExtras = 8;

std::vector<std::filesystem::path> shaderFolders(const Registry& registry) {
    std::vector<std::filesystem::path> folders = registry.shaderFolders();
    folders.push_back(projectRoot() / "shaders");
    return folders;
}

// What ends before its first file leaves nothing behind.
void removeIfEmpty(const std::filesystem::path& folder) {
    std::error_code ignored;
    if (std::filesystem::is_directory(folder, ignored) &&
        std::filesystem::is_empty(folder, ignored))
        std::filesystem::remove(folder, ignored);
}

}  // namespace

RenderWorker::Device::Device(std::unique_ptr<gl::Context> c, const Registry& registry)
    : context(std::move(c)), shaders(shaderFolders(registry)) {}

RenderWorker::RenderWorker(const Registry& registry, std::function<void()> onUpdate)
    : registry_(registry), onUpdate_(std::move(onUpdate)), thread_([this] { run(); }) {}

RenderWorker::~RenderWorker() {
    stop_ = true;
    cancelRecording_ = true;
    wake_.notify_all();
    thread_.join();
}

std::uint64_t RenderWorker::submit(FrameOrder order) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        number = ++number_;
        if (!order.isPassing) endsFramesBefore_ = number;
        order_ = std::move(order);
    }
    wake_.notify_all();
    return number;
}

std::shared_ptr<const FrameResult> RenderWorker::latest() const {
    const std::lock_guard lock(mutex_);
    return latest_;
}

RenderWorker::Progress RenderWorker::progress() const {
    const std::lock_guard lock(mutex_);
    Progress now = progress_;
    if (now.isBusy) now.seconds = std::chrono::duration<double>(Clock::now() - frameBegin_).count();
    return now;
}

void RenderWorker::record(RecordRequest request) {
    {
        const std::lock_guard lock(mutex_);
        cancelRecording_ = false;
        recording_ = {true, "waiting for the frame at hand", false, request.folder};
        request_ = std::move(request);
    }
    wake_.notify_all();
}

void RenderWorker::cancelRecording() {
    cancelRecording_ = true;
}

RenderWorker::Recording RenderWorker::recording() const {
    const std::lock_guard lock(mutex_);
    return recording_;
}

void RenderWorker::setRecording(Recording state) {
    {
        const std::lock_guard lock(mutex_);
        state.folder = std::move(recording_.folder);
        if (!state.isActive) removeIfEmpty(state.folder);
        recording_ = std::move(state);
    }
    onUpdate_();
}

void RenderWorker::post() {
    {
        const std::lock_guard lock(mutex_);
        latest_ = std::make_shared<const FrameResult>(working_);
    }
    onUpdate_();
}

VariantRenderer::ShouldContinue RenderWorker::watch(const Device& device, const std::string& what) {
    const std::lock_guard lock(mutex_);
    frameBegin_ = Clock::now();
    const std::uint64_t number = working_.order;
    const bool isEndless = device.order.frames == 0 && !device.order.isPreview;
    const int before = device.rendered;
    const int all = std::max(device.toRender, 1);
    return [=, this](std::size_t step, std::size_t steps, const std::string& pass) {
        if (stop_ || endsFramesBefore_ > number) return false;
        const double ofThis = static_cast<double>(step) / static_cast<double>(steps);
        const std::lock_guard inside(mutex_);
        progress_ = {true, what.empty() ? pass : what + ": " + pass, {}, 0.0};
        if (!isEndless) progress_.share = std::min((before + ofThis) / all, 1.0);
        return true;
    };
}

void RenderWorker::run() {
    lowerPriority(kFramePriority);
    try {
        Device device(gl::Context::createHeadless(), registry_);
        working_.device = device.context->info();
        serve(device);
    } catch (const std::bad_alloc&) {
        working_.problem = "Out of memory; use fewer photons, layers or pixels.";
        working_.isLost = true;
        post();
    } catch (const std::exception& error) {
        working_.problem = error.what();
        working_.isLost = true;
        post();
    }
}

void RenderWorker::serve(Device& device) {
    while (!stop_) {
        std::optional<RecordRequest> request;
        bool isSwapped = false;
        bool isLook = false;
        {
            std::unique_lock lock(mutex_);
            progress_.isBusy = false;
            const auto isAwake = [&] {
                return stop_ || request_ || (order_ && number_ != device.number);
            };
            const bool hasWork = device.number != 0 && working_.problem.empty() &&
                                 (!device.hasExtras || device.order.frames == 0) &&
                                 !device.order.isPreview;
            if (!hasWork) wake_.wait_for(lock, kIdle, isAwake);
            if (stop_) return;
            request = std::exchange(request_, {});
            if (order_ && number_ != device.number) {
                isSwapped = areSwapped(device.order.document, order_->document);
                const bool isSameFrame = (isSwapped || device.order.document == order_->document) &&
                                         device.order.isPreview == order_->isPreview &&
                                         device.order.sceneReloads == order_->sceneReloads;
                const bool isSame =
                    isSameFrame && device.order.viewing.wantsSameFrame(order_->viewing);
                isLook = isSameFrame && !isSwapped && device.canLook(*order_, working_);
                if (isSwapped) {
                    std::swap(device.renderers[0], device.renderers[1]);
                    std::swap(working_.variants[0], working_.variants[1]);
                    working_.probe.reset();  // of what was A
                }
                device.order = *order_;
                device.number = number_;
                working_.order = number_;
                working_.document = device.order.document;
                if (!isSame && !isLook) device.framesDone = 0;
                for (VariantResult& variant : working_.variants) {
                    if (isSame || isLook) variant.order = number_;
                    variant.isSettled = variant.isSettled && (isSame || isLook);
                }
                // Energy and limits go with what they are of; photons are A's.
                device.hasExtras =
                    isLook || (device.hasExtras && isSwapped && isSame && !device.order.probe);
                device.toRender = 0;
            } else if (!request && !hasWork) {
                lock.unlock();
                reloadShaders(device);
                continue;
            }
        }
        if (isSwapped) post();
        if (isLook) look(device);
        reloadShaders(device);
        if (device.number == 0 || !loadScene(device)) {
            if (request)
                setRecording({false, "There is nothing to record. " + working_.problem, true});
            continue;
        }
        if (request) {
            writeRecording(device, *request);
            continue;
        }
        if (device.toRender == 0) device.countFrames();
        const bool isEndless = device.order.frames == 0;
        const int wanted = isEndless ? kFramesBeforeExtras : device.order.frames;
        if (!device.order.isPreview && device.framesDone >= wanted && !device.hasExtras) {
            renderExtras(device);
        } else if (device.order.isPreview || isEndless || device.framesDone < wanted) {
            renderOnce(device);
        }
    }
}

void RenderWorker::renderOnce(Device& device) {
    const FrameOrder& order = device.order;
    if (device.variants() == 1) working_.variants[1] = {};
    for (std::size_t i = 0; i < device.variants(); ++i) {
        std::unique_ptr<VariantRenderer>& renderer = device.renderers[i];
        if (!renderer) {
            renderer = std::make_unique<VariantRenderer>(*device.context, registry_, *device.scene,
                                                         device.versions);
        }
    }
    if (!order.isPreview && !renderFirstPictures(device)) return;
    bool hasFailed = true;
    for (std::size_t i = 0; i < device.variants(); ++i) {
        const std::unique_ptr<VariantRenderer>& renderer = device.renderers[i];
        const VariantRenderer::ShouldContinue shouldContinue =
            watch(device, device.variants() == 1 ? ""
                          : i == 0               ? "A"
                                                 : "B");
        const bool isWhole =
            order.isPreview
                ? renderer->renderPreview(device.variant(i), order.document.size, shouldContinue)
                : renderer->render(device.variant(i), order.document.size, order.viewing,
                                   order.isPrecise, shouldContinue);
        if (!isWhole) return;  // there is a newer order
        ++device.rendered;
        working_.variants[i] = renderer->result();
        working_.variants[i].order = device.number;
        hasFailed = hasFailed && !renderer->result().error.empty();
        post();
    }
    ++device.framesDone;
    if (order.isPreview) {
        device.hasExtras = true;
    } else if (hasFailed) {
        device.framesDone = std::max(device.framesDone, kFramesBeforeExtras);
    }
}

// Where nothing is seen yet a quick picture is worth more than a whole one later, whose programs
// may take long to compile. False: there is a newer order.
bool RenderWorker::renderFirstPictures(Device& device) {
    for (std::size_t i = 0; i < device.variants(); ++i) {
        if (device.hasPicture(i)) continue;
        VariantRenderer& renderer = *device.renderers[i];
        if (!renderer.renderPreview(device.variant(i), device.order.document.size,
                                    watch(device, "quick picture"))) {
            return false;
        }
        ++device.rendered;
        if (!renderer.result().viewed) continue;  // the whole frame will say why
        working_.variants[i] = renderer.result();
        working_.variants[i].order = device.number;
        post();
    }
    return true;
}

// Another texture of the frame that is there, or thumbnails of another pass.
void RenderWorker::look(Device& device) {
    for (std::size_t i = 0; i < device.variants(); ++i) {
        device.renderers[i]->look(device.order.viewing);
        const VariantResult& seen = device.renderers[i]->result();
        working_.variants[i].viewed = seen.viewed;
        working_.variants[i].thumbnailsOf = seen.thumbnailsOf;
        working_.variants[i].thumbnails = seen.thumbnails;
    }
    post();
}

void RenderWorker::renderExtras(Device& device) {
    working_.probe.reset();
    if (const auto& probe = device.order.probe; probe && device.renderers[0]) {
        working_.probe =
            device.renderers[0]->probe(probe->pixel, probe->radiusPixels, watch(device, "photons"));
        if (!working_.probe && device.renderers[0]->result().error.empty()) return;
    }
    // The last: its frame is what is looked at from then on.
    for (std::size_t i = 0; i < device.variants(); ++i) {
        VariantRenderer* renderer = device.renderers[i].get();
        if (renderer != nullptr && renderer->result().error.empty() &&
            !renderer->measure(device.order.viewing, watch(device, "energy"))) {
            return;
        }
        ++device.rendered;
    }
    device.hasExtras = true;
    for (std::size_t i = 0; i < device.variants(); ++i) {
        if (!device.renderers[i]) continue;
        working_.variants[i] = device.renderers[i]->result();
        working_.variants[i].order = device.number;
        working_.variants[i].isSettled = device.order.frames != 0;
    }
    post();
}

void RenderWorker::reloadShaders(Device& device) {
    if (!device.shaders.hasChanged()) return;
    std::string problem;
    for (const auto& renderer : device.renderers) {
        if (!renderer) continue;
        for (const std::string& error : renderer->reloadShaders())
            problem += (problem.empty() ? "" : "\n") + error;
    }
    working_.shaderProblem = problem;
    ++working_.shaderReloads;
    for (VariantResult& variant : working_.variants)
        variant.isSettled = false;
    device.framesDone = 0;
    device.toRender = 0;
    device.hasExtras = false;
    post();
}

}  // namespace kaustik::gui
