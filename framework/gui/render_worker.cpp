// SPDX-License-Identifier: MIT
#include "framework/gui/render_worker.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/gui/file_watch.h"
#include "framework/run/output.h"
#include "framework/run/run_record.h"
#include "framework/run/run_reference.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kIdle = 300ms;  // between looks at the shaders' files
// After so many frames the ledger and the photons are looked at, also where frames go on for ever.
constexpr int kFramesBeforeExtras = 8;

// On a software rasteriser the frame and the window want the same cores; the window goes first.
// Threads that this one starts, the rasteriser's among them, inherit it.
void lowerPriority() {
    static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 15));
}

// Makes what can be edited as it is in the file, then as the document says.
void takeEdits(scene::Scene& scene, const scene::Scene& base, const scene::SceneEdits& edits) {
    scene.camera = base.camera;
    scene.lights = base.lights;
    scene.medium = base.medium;
    bool moved = scene.timeSeconds != edits.timeSeconds.value_or(base.timeSeconds);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!scene.meshes[i].heightField) continue;
        moved = moved || scene.meshes[i].heightField->waves != base.meshes[i].heightField->waves;
        scene.meshes[i].heightField->waves = base.meshes[i].heightField->waves;
    }
    scene.timeSeconds = base.timeSeconds;
    applyEdits(scene, edits);
    if (moved && !edits.timeSeconds && edits.waves.empty()) setTime(scene, base.timeSeconds);
}

std::shared_ptr<const SceneFacts> factsOf(const scene::Scene& base, const scene::Scene& scene) {
    auto facts = std::make_shared<SceneFacts>();
    facts->name = scene.name;
    facts->description = scene.description;
    facts->triangles = triangleCount(scene);
    facts->needs = sceneNeeds(scene);
    facts->bounds = sceneBounds(scene);
    facts->camera = base.camera;
    facts->lights = base.lights;
    facts->medium = base.medium;
    facts->timeSeconds = base.timeSeconds;
    for (const scene::Object& object : base.objects) {
        const scene::Mesh& mesh = base.meshes[object.mesh];
        if (mesh.heightField) facts->waters.push_back({object.name, mesh.heightField->waves});
    }
    return facts;
}

}  // namespace

struct RenderWorker::Device {
    explicit Device(std::unique_ptr<gl::Context> c) : context(std::move(c)) {}
    std::unique_ptr<gl::Context> context;
    FileWatch shaders{projectRoot() / "shaders"};
    std::string sceneName;
    int sceneReloads = 0;
    std::unique_ptr<scene::Scene> base;  // as its file says
    std::unique_ptr<scene::Scene> scene;
    std::optional<scene::SceneEdits> edits;  // that the scene has
    std::array<std::unique_ptr<VariantRenderer>, 2> renderers;

    // Of textures: unlike those of any other device of this program.
    std::uint64_t versions = static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
    FrameOrder order;
    std::uint64_t number = 0;
    int framesDone = 0;
    bool hasExtras = false;
    // Frames and the like that the order has had rendered, and those that it takes in all; 0 before
    // they are counted.
    int rendered = 0;
    int toRender = 0;

    // Begins to count for the order at hand.
    void countFrames() {
        const auto count = static_cast<int>(variants());
        int previews = 0;
        for (int i = 0; i < count; ++i)
            previews += hasPicture(static_cast<std::size_t>(i)) ? 0 : 1;
        const int extras = count + (order.probe ? 1 : 0);
        rendered = framesDone * count;
        toRender = order.isPreview ? count : previews + order.frames * count + extras;
    }
    [[nodiscard]] bool hasPicture(std::size_t variant) const {
        return renderers[variant] && renderers[variant]->result().viewed;
    }
    [[nodiscard]] std::size_t variants() const { return order.document.other ? 2 : 1; }
    [[nodiscard]] const Variant& variant(std::size_t i) const {
        return i == 0 ? order.document.variant : *order.document.other;
    }
};

RenderWorker::RenderWorker(const Registry& registry, std::function<void()> onNews)
    : registry_(registry), onNews_(std::move(onNews)), thread_([this] { run(); }) {}

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
        request_ = std::move(request);
        recording_ = {true, "waiting for the frame at hand", false};
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
        recording_ = std::move(state);
    }
    onNews_();
}

void RenderWorker::post() {
    {
        const std::lock_guard lock(mutex_);
        latest_ = std::make_shared<const FrameResult>(working_);
    }
    onNews_();
}

VariantRenderer::GoesOn RenderWorker::watch(const Device& device, const std::string& what) {
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
    lowerPriority();
    try {
        Device device(gl::Context::createHeadless());
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
                const bool isSame = device.order.document == order_->document &&
                                    device.order.viewing == order_->viewing &&
                                    device.order.isPreview == order_->isPreview &&
                                    device.order.sceneReloads == order_->sceneReloads;
                device.order = *order_;
                device.number = number_;
                working_.order = number_;
                working_.document = device.order.document;
                if (!isSame) device.framesDone = 0;
                for (VariantResult& variant : working_.variants) {
                    if (isSame) variant.order = number_;
                    variant.isSettled = variant.isSettled && isSame;
                }
                device.hasExtras = false;
                device.toRender = 0;
            } else if (!request && !hasWork) {
                lock.unlock();
                reloadShaders(device);
                continue;
            }
        }
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

bool RenderWorker::loadScene(Device& device) {
    const Document& document = device.order.document;
    try {
        if (!device.base || device.sceneName != document.scene ||
            device.sceneReloads != device.order.sceneReloads) {
            auto base = std::make_unique<scene::Scene>(scene::loadScene(document.scene));
            device.renderers = {};
            working_.variants = {};
            device.base = std::move(base);
            device.scene = std::make_unique<scene::Scene>(*device.base);
            device.sceneName = document.scene;
            device.sceneReloads = device.order.sceneReloads;
            device.edits = scene::SceneEdits();
            working_.scene = factsOf(*device.base, *device.scene);
        }
        if (device.edits != document.edits) {
            device.edits.reset();  // of the scene as it is until this is whole
            takeEdits(*device.scene, *device.base, document.edits);
            device.edits = document.edits;
            for (const auto& renderer : device.renderers) {
                if (renderer) renderer->noteSceneChange();
            }
            working_.scene = factsOf(*device.base, *device.scene);
        }
        working_.problem.clear();
        return true;
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        // What was shown stays; the same order is not tried again.
        device.hasExtras = true;
        working_.problem = error.what();
        post();
        return false;
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
        const VariantRenderer::GoesOn goesOn = watch(device, device.variants() == 1 ? ""
                                                             : i == 0               ? "A"
                                                                                    : "B");
        const bool isWhole =
            order.isPreview
                ? renderer->renderPreview(device.variant(i), order.document.size, goesOn)
                : renderer->render(
                      device.variant(i), order.document.size, order.viewing,
                      order.isPrecise ? gl::TimerMode::finish : gl::TimerMode::timestamps, goesOn);
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

void RenderWorker::renderExtras(Device& device) {
    for (std::size_t i = 0; i < device.variants(); ++i) {
        VariantRenderer* renderer = device.renderers[i].get();
        if (renderer != nullptr && renderer->result().error.empty() &&
            !renderer->measure(watch(device, "energy"))) {
            return;
        }
        ++device.rendered;
    }
    working_.probe.reset();
    if (const auto& probe = device.order.probe; probe && device.renderers[0]) {
        working_.probe =
            device.renderers[0]->probe(probe->pixel, probe->radiusPixels, watch(device, "photons"));
        if (!working_.probe && device.renderers[0]->result().error.empty()) return;
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

void RenderWorker::writeRecording(Device& device, const RecordRequest& request) {
    try {
        run::requireWritable(request.folder, "Recording");
        if (request.what == RecordRequest::What::report) {
            writeReport(device, request);
        } else {
            writeSequence(device, request);
        }
    } catch (const DeviceError& error) {
        setRecording({false, error.what(), true});
        throw;
    } catch (const Error& error) {
        // A reference that is ended in the middle is an error for others.
        setRecording({false, cancelRecording_ ? "The report was cancelled." : error.what(), true});
    }
    // The picture that is shown comes back by a frame of its own.
    device.framesDone = 0;
    device.toRender = 0;
    device.hasExtras = false;
    if (device.renderers[0]) device.renderers[0]->noteSceneChange();
}

void RenderWorker::writeReport(Device& device, const RecordRequest& request) {
    const Document& document = device.order.document;
    const gl::TimerMode mode =
        device.order.isPrecise ? gl::TimerMode::finish : gl::TimerMode::timestamps;
    Renderer renderer(*device.context, registry_, *device.scene,
                      settingsOf(document.variant, document.size, registry_));
    renderer.build(Purpose::picture);
    const run::Watch watch{
        [this] { return !stop_ && !cancelRecording_; },
        [this](double share, const std::string& reached) {
            setRecording(
                {true, fmt::format("reference, {:.0f} %: {}", 100.0 * share, reached), false});
        }};
    if (request.referencePhotons > 0) setRecording({true, "looking for a reference", false});
    const run::RunReference reference(request.referencePhotons > 0 ? "auto" : "none",
                                      request.referencePhotons, renderer, watch);
    report::RunRecord record = run::startRecord(renderer, mode);
    record.warmup = 1;
    gl::PassTimer timer(mode);
    for (int frame = 0; frame <= request.frames; ++frame) {
        setRecording({true, fmt::format("frame {} of {}", frame, request.frames), false});
        const bool isWhole =
            renderer.renderFrame(timer, [&](std::size_t) { return !stop_ && !cancelRecording_; });
        if (!isWhole) return setRecording({false, "The report was cancelled.", true});
        for (gl::FrameTime& time : timer.takeFinished(true))
            record.frames.push_back(std::move(time));
    }
    record.frames.erase(record.frames.begin());  // the first one compiles
    setRecording(
        {true, reference.purpose() == Purpose::audit ? "measuring and writing" : "writing", false});
    const std::vector<fs::path> files =
        run::finishRun(renderer, reference, record, request.folder, {}, device.context->info());
    setRecording({false,
                  fmt::format("Wrote {} files into {}.", files.size(), request.folder.string()),
                  false});
}

void RenderWorker::writeSequence(Device& device, const RecordRequest& request) {
    const Document& document = device.order.document;
    scene::Scene scene = *device.scene;
    const double begin = scene.timeSeconds;
    Renderer renderer(*device.context, registry_, scene,
                      settingsOf(document.variant, document.size, registry_));
    gl::PassTimer timer(gl::TimerMode::finish);
    for (int frame = 0; frame < request.frames; ++frame) {
        setRecording({true, fmt::format("picture {} of {}", frame + 1, request.frames), false});
        setTime(scene, begin + frame * request.secondsPerFrame);
        renderer.update(renderer.settings());
        renderer.build(Purpose::picture);
        const bool isWhole =
            renderer.renderFrame(timer, [&](std::size_t) { return !stop_ && !cancelRecording_; });
        if (!isWhole) {
            return setRecording({false,
                                 fmt::format("Cancelled after {} of {} pictures, which are in {}.",
                                             frame, request.frames, request.folder.string()),
                                 true});
        }
        static_cast<void>(timer.takeFinished(true));
        writeImage(request.folder / fmt::format("{:04}{}", frame, displayImageExtension()),
                   run::readTexture(renderer.texture(renderer.outputs().picture.display), 0, 3));
    }
    setRecording(
        {false, fmt::format("Wrote {} pictures into {}.", request.frames, request.folder.string()),
         false});
}

}  // namespace kaustik::gui
