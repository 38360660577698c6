// SPDX-License-Identifier: MIT
// report.json: each `reflect` writes a table of it, and says what its keys are.
#include "framework/report/run_report.h"

#include <algorithm>
#include <map>
#include <thread>

#include "framework/core/files.h"
#include "framework/core/json_schema.h"
#include "framework/core/machine.h"
#include "framework/gl/program_store.h"
#include "framework/report/limits.h"
#include "framework/report/map_account.h"
#include "framework/report/statistics.h"

namespace kaustik::report {

using nlohmann::json;
using namespace transport;

struct DeviceTable {
    gl::DeviceInfo device;
    std::string processor;
    unsigned threads = 0;
};
template <class F>
void reflect(F& f, const DeviceTable& table) {
    f.field("renderer", table.device.renderer, "The device's name");
    f.field("vendor", table.device.vendor, "Who made it or its driver");
    f.field("gl", table.device.version, "The version of OpenGL, and the driver's");
    f.field("platform", table.device.platform, "The platform of EGL that gave the context");
    f.field("uuid", table.device.uuid, "As nvidia-smi and Vulkan have it; empty where unknown");
    f.field("gl_debug", table.device.debugs, "Whether OpenGL checked every pass");
    f.field("cpu", table.processor, "The processor's name");
    f.field("threads", table.threads, "That the processor runs at once");
}

struct NeedsTable {
    scene::SceneNeeds needs;
    long long depthComplexity = 0;
};
template <class F>
void reflect(F& f, const NeedsTable& table) {
    const scene::SceneNeeds& needs = table.needs;
    f.field("specular_interfaces", needs.specularInterfaces,
            "That a path can hit when it crosses every dielectric once");
    f.field("reflectors", needs.reflectors, "Objects that are mirrors");
    f.field("refractors", needs.refractors, "Objects that are dielectrics");
    f.field("closed_dielectrics", needs.closedDielectrics, "Whether a dielectric has an inside");
    f.field("medium", needs.medium, "Whether one scatters or absorbs");
    f.field("glossy_receivers", needs.glossyReceivers,
            "Whether a receiver is not Lambertian alone");
    f.field("animated", needs.animated, "Whether something moves");
    f.field("lights", needs.lights, "How many there are");
    f.field("receivers", needs.receivers, "Whether there is a surface that light ends on");
    f.field("depth_complexity", table.depthComplexity, "Most surfaces along a pixel's ray");
}

struct SceneTable {
    std::string name;
    std::size_t triangles = 0;
    NeedsTable needs;
};
template <class F>
void reflect(F& f, const SceneTable& table) {
    f.field("name", table.name, "The scene's name");
    f.field("triangles", table.triangles, "Of all objects");
    f.field("needs", table.needs, "What decides which passes run");
}

struct PassTable {
    std::string name;
    bool ran = false;
    std::string reason;
    std::optional<std::size_t> repeats;
    std::optional<Summary> gpuMilliseconds;
    std::optional<Summary> cpuMilliseconds;
};
template <class F>
void reflect(F& f, const PassTable& table) {
    f.field("name", table.name, "The pass");
    f.field("stage", table.name.substr(0, table.name.find('.')), "The stage that it is of");
    f.field("ran", table.ran, "Whether it did");
    f.field("why", table.reason, "Why it ran, or not");
    f.field("repeats", table.repeats, "Passes of this name in a frame");
    f.field("gpu_ms", table.gpuMilliseconds, "On the device, all repeats together");
    f.field("cpu_ms", table.cpuMilliseconds, "On the processor, all repeats together");
}

struct PhotonsTable {
    EnergyLedger ledger;
};
template <class F>
void reflect(F& f, const PhotonsTable& table) {
    const auto& events = table.ledger.events;
    const std::uint64_t emitted = events[kAccountEmitted];
    const std::uint64_t hit = events[kAccountArrived];
    const std::uint64_t nan = events[kAccountNotANumber];
    const std::uint64_t rest = hit + nan + events[kAccountBounceLimit];
    f.field("emitted", emitted, "That hit a specular surface");
    f.field("specular", emitted, "The same");
    f.field("traced", table.ledger.traced, "That were traced, each once an interaction");
    f.field("hit", hit, "That arrived at a receiver");
    f.field("missed", emitted > rest ? emitted - rest : 0, "That arrived nowhere");
    f.field("nan", nan, "That are no numbers");
}

struct EyeRaysTable {
    EyeRays rays;
};
template <class F>
void reflect(F& f, const EyeRaysTable& table) {
    const EyeRays& rays = table.rays;
    f.field("pixels", rays.pixels, "Whose middle sees a specular surface");
    f.field("came_out", rays.cameOut, "Of them: followed to where they see the scene");
    f.field("lost", rays.lost, "Of them: where they go on is not known");
    f.field("reflection_limit", rays.reflectionLimit, "Of them: lost between total reflections");
    f.field("nesting_limit", rays.nestingLimit, "Of them: lost in too many dielectrics at once");
    f.field("ended_inside", rays.endedInside,
            "Of them: at a cap on interfaces, taken to see what they would from outside");
    f.field("mirror_limit", rays.mirrorLimit,
            "Of them: at a cap on mirrors, taken to see the environment");
}

struct LayersTable {
    LayerStatistics statistics{};
    int allowed = 0;
};
template <class F>
void reflect(F& f, const LayersTable& table) {
    const LayerStatistics& layers = table.statistics;
    f.field("allowed", table.allowed, "Layers that the run may peel");
    f.field("complexity", layers.complexity, "Most surfaces along a pixel's ray");
    f.field("peeled",
            std::min<std::uint64_t>(layers.complexity, static_cast<std::uint64_t>(table.allowed)),
            "Layers that were made");
    f.field("fragments", layers.fragments, "In all pixels");
    f.field("fragments_left_out", layers.skipped, "Of them those beyond the last layer");
    f.field("pixels_left_out", layers.pixelsSkipped, "Pixels that have such fragments");
}

// Those causes alone that took something.
struct LossTable {
    EnergyLedger ledger;
};
template <class F>
void reflect(F& f, const LossTable& table) {
    for (const auto& [account, name] : lossCauses()) {
        const double watts = table.ledger.watts[account];
        f.field(name.c_str(), watts != 0.0 ? std::optional(watts) : std::nullopt, "");
    }
}

// Shares of the deposited flux.
struct PrimitivesTable {
    double trianglesWatts = 0.0;
    double beamsWatts = 0.0;
    double depositedWatts = 0.0;
};
template <class F>
void reflect(F& f, const PrimitivesTable& table) {
    const double splats = table.depositedWatts - table.trianglesWatts - table.beamsWatts;
    const auto share = [&](const char* key, double watts, const char* sentence) {
        // What lies between is what 64-bit sums round.
        f.field(key, std::clamp(watts / table.depositedWatts, 0.0, 1.0), sentence);
    };
    share("triangles", table.trianglesWatts, "Between photons of neighbouring cells");
    share("beams", table.beamsWatts,
          "By what a photon's beam covers, next to cells that cannot be joined");
    share("splats", splats > 1e-4 * table.depositedWatts ? splats : 0.0,
          "By a splat a photon: all that is neither");
}

struct EnergyTable {
    EnergyLedger ledger;
    PrimitiveFlux primitives;
};
template <class F>
void reflect(F& f, const EnergyTable& table) {
    const auto& watts = table.ledger.watts;
    f.field("emitted_w", watts[kAccountEmitted], "Flux at the first specular surface");
    f.field("deposited_w", watts[kAccountDeposited], "Flux that was stored in the map");
    f.field("absorbed_w", watts[kAccountAbsorbed], "In bodies, in the medium and at mirrors");
    f.field("left_scene_w", watts[kAccountLeftScene], "That hits nothing");
    f.field("lost_w", LossTable{table.ledger}, "By cause");
    const double deposited = watts[kAccountDeposited];
    f.field("primitives",
            deposited > 0.0 ? std::optional(PrimitivesTable{table.primitives.trianglesWatts,
                                                            table.primitives.beamsWatts, deposited})
                            : std::nullopt,
            "By what the deposited flux was spread");
    f.field("balance", table.ledger.balance(), "What all accounts leave of the emitted, over it");
}

struct MemoryTable {
    std::size_t textures = 0;
    std::size_t buffers = 0;
    std::size_t scene = 0;
    std::size_t peak = 0;
};
template <class F>
void reflect(F& f, const MemoryTable& table) {
    f.field("texture_bytes", table.textures, "Of the graph's textures");
    f.field("buffer_bytes", table.buffers, "Of the graph's buffers");
    f.field("scene_bytes", table.scene, "Of the scene");
    f.field("peak_bytes", table.peak, "Most of the graph's that are in use at once");
}

struct ProgramsTable {
    gl::ProgramStatistics all;
};
template <class F>
void reflect(F& f, const ProgramsTable& table) {
    f.field("compiled", table.all.compiled, "By the driver");
    f.field("loaded", table.all.loaded, "From the store of programs that were compiled before");
    f.field("together", table.all.together,
            "Most that the driver was handed before it was asked how one of them went");
    f.field("ms", table.all.milliseconds, "That making them took, by this process in all");
}

struct ReportTable {
    DeviceTable device;
    SceneTable scene;
    std::string technique;
    bool isAsPublished = false;
    json parameters = json::object();
    std::vector<std::string> disabled;
    double timeSeconds = 0.0;
    double timeStepSeconds = 0.0;
    long long seed = 0;
    std::array<int, 2> size{};
    std::size_t frames = 0;
    int warmup = 0;
    gl::TimerMode timer = gl::TimerMode::timestamps;
    Timing timing;
    Summary frameMilliseconds;
    Summary bookkeepingMilliseconds;
    std::optional<Summary> betweenFramesMilliseconds;
    double graphBuildMilliseconds = 0.0;
    double startupMilliseconds = 0.0;
    std::vector<PassTable> passes;
    EnergyLedger ledger;
    PrimitiveFlux primitives;
    std::optional<EyeRaysTable> eyeRays;
    LayersTable layers;
    MemoryTable memory;
    std::vector<LimitTable> limits;
    std::vector<std::string> warnings;
    std::vector<std::string> violations;
    std::optional<EndedEarly> endedEarly;

    // What is known only once a frame was measured.
    template <class T>
    [[nodiscard]] std::optional<T> ifMeasured(T part) const {
        return endedEarly && !endedEarly->hasLedger ? std::nullopt : std::optional(std::move(part));
    }
};
template <class F>
void reflect(F& f, const EndedEarly& table) {
    f.field("why", table.why, "The error that ended it");
    f.field("missing", table.missing, "Of what it was to leave behind");
}
template <class F>
void reflect(F& f, const Timing& timing) {
    f.field("date", timing.date, "When the timed frames began, UTC");
    f.field("other_processors", timing.otherProcessors,
            "That other work kept busy meanwhile, on average; on an idle machine about 0");
    f.field("dropped_frames", timing.droppedFrames,
            "Rendered, but their times were lost before they could be read");
    f.field("cut_short_frames", timing.cutShortFrames,
            "That were left before a loop had come to its end: their pictures lack light");
    f.field("measuring_ms", timing.measuringMilliseconds,
            "That timing its passes adds to a frame, at least");
    f.field("of_measured_frame", timing.isOfMeasuredFrame,
            "Whether one frame was asked for, without a warm-up, which then is also the one that "
            "is measured and judged: times, passes and memory hold what only that takes");
    f.field("ledger", timing.hasLedger,
            "Whether they summed up the energy ledger, as the frame that is measured does");
}
template <class F>
void reflect(F& f, const ReportTable& report) {
    f.choice("schema", "kaustik.report/1", {"kaustik.report/1"}, "The format of this file");
    f.field("version", versionString(), "Of the program");
    f.field("device", report.device, "What it ran on");
    f.field("scene", report.scene, "What was rendered");
    f.field("technique", report.technique, "A name of 'kaustik list techniques'");
    f.field("as_published", report.isAsPublished, "Whether its row is its paper's");
    f.field("parameters", report.parameters, "By full name");
    f.field("disabled", report.disabled, "Passes that were not to run");
    f.field("time_s", report.timeSeconds, "Of the animation in the last frame");
    f.field("time_step_s", report.timeStepSeconds, "From one timed frame to the next");
    f.field("seed", report.seed, "Of everything random");
    f.field("size", report.size, "Width and height of the picture");
    f.field("frames", report.frames, "Frames that were timed");
    f.field("warmup", report.warmup, "Frames before them");
    f.choice("timer", report.timer == gl::TimerMode::timestamps ? "gpu" : "finish",
             {"gpu", "finish"}, "By the device's timestamps, or with it finished around each pass");
    f.field("timing", report.timing, "When it was timed, and what else the machine did");
    f.field("frame_ms", report.frameMilliseconds, "Of whole frames");
    f.field("bookkeeping_ms", report.bookkeepingMilliseconds,
            "Of a frame's work beside its passes");
    f.field("between_frames_ms", report.betweenFramesMilliseconds,
            "Of the processor, to bring a scene that moves to the next frame's time: its meshes, "
            "what it needs, the graph");
    f.field("graph_build_ms", report.graphBuildMilliseconds, "Of making the graph");
    f.field("startup_ms", report.startupMilliseconds, "Until the first frame");
    f.field("programs", ProgramsTable{gl::programStatistics()}, "Of shaders");
    f.field("passes", report.passes, "Every pass, in order");
    f.field("photons", report.ifMeasured(PhotonsTable{report.ledger}), "What became of them");
    f.field("eye_rays", report.eyeRays, "What became of those that meet a specular surface first");
    f.field("layers", report.ifMeasured(report.layers), "The layered depth of what the eye sees");
    f.field("energy", report.ifMeasured(EnergyTable{report.ledger, report.primitives}),
            "The ledger, W");
    f.field("memory", report.memory, "On the device");
    f.field("limits", report.ifMeasured(report.limits), "That were reached");
    f.field("warnings", report.warnings, "What else to know");
    f.field("violations", report.ifMeasured(report.violations),
            "What no light can do: the run is worth nothing");
    f.field("ended_early", report.endedEarly,
            "Only of a run that an error has ended: what is not here it has not come to");
}

namespace {

std::vector<PassTable> passTables(const RunRecord& record) {
    const std::vector<PassTimes> times = timesByPass(record);
    std::vector<PassTable> tables;
    for (const graph::PassRecord& pass : record.passes) {
        const auto found = std::find_if(times.begin(), times.end(), [&](const PassTimes& timed) {
            return timed.name == pass.name;
        });
        PassTable& table = tables.emplace_back();
        table = {pass.name, pass.state == graph::PassState::ran, pass.reason, {}, {}, {}};
        if (!table.ran || found == times.end()) continue;
        table.repeats = pass.repeats;
        table.gpuMilliseconds = summarize(found->gpuMilliseconds);
        table.cpuMilliseconds = summarize(found->cpuMilliseconds);
    }
    return tables;
}

}  // namespace

json needsJson(const scene::SceneNeeds& needs, long long depthComplexity) {
    return jsonOf(NeedsTable{needs, depthComplexity});
}

json photonsJson(const EnergyLedger& ledger) {
    return jsonOf(PhotonsTable{ledger});
}

json makeReport(const RunRecord& record, const Renderer& renderer, const gl::DeviceInfo& device) {
    const RenderSettings& settings = renderer.settings();
    ReportTable table;
    table.device = {device, processorName(), std::thread::hardware_concurrency()};
    table.scene = {renderer.scene().name,
                   triangleCount(renderer.scene()),
                   {renderer.needs(), record.layers.complexity}};
    table.technique = settings.technique.name;
    table.isAsPublished = settings.technique.isAsPublished;
    table.parameters = settings.params.json();
    table.disabled.assign(settings.disabledPasses.begin(), settings.disabledPasses.end());
    table.timeSeconds = renderer.scene().timeSeconds;
    table.timeStepSeconds = record.timeStepSeconds;
    table.seed = record.seed;
    table.size = {settings.width, settings.height};
    table.frames = record.frames.size();
    table.warmup = record.warmup;
    table.timer = record.timer;
    table.timing = record.timing;
    table.frameMilliseconds = summarize(frameSamples(record));
    table.bookkeepingMilliseconds = summarize(bookkeepingSamples(record));
    if (!record.betweenFramesMilliseconds.empty())
        table.betweenFramesMilliseconds = summarize(record.betweenFramesMilliseconds);
    table.graphBuildMilliseconds = record.graphBuildMilliseconds;
    table.startupMilliseconds = record.startupMilliseconds;
    table.passes = passTables(record);
    table.ledger = record.ledger;
    table.primitives = record.primitives;
    if (record.eyeRays) table.eyeRays = EyeRaysTable{*record.eyeRays};
    table.layers = {record.layers, record.layersAllowed};
    table.memory = {record.textureBytes, record.bufferBytes, renderer.gpuScene().bytes(),
                    record.peakBytes};
    table.endedEarly = record.endedEarly;
    if (table.ifMeasured(true)) {
        for (const ReachedLimit& limit : reachedLimits(record, renderer))
            table.limits.push_back({limit});
    }
    table.warnings = record.warnings;
    table.violations = record.violations;
    json report = jsonOf(table);
    for (const auto& [key, value] : {std::pair("map", &record.map),
                                     {"cells", &record.cells},
                                     {"hits", &record.hits},
                                     {"error", &record.error},
                                     {"cannot_form", &record.unformed}}) {
        if (!value->is_null()) report[key] = *value;
    }
    if (record.cost) report["cost"] = costJson(*record.cost, medianByPass(record));
    return report;
}

json reportSchema(const std::map<std::string, json>& judgements) {
    json schema = jsonSchemaOf<ReportTable>();
    json& properties = schema["properties"];
    properties["$schema"] = jsonSchemaOf<std::string>();
    properties["map"] = mapSchema();
    properties["cells"] = cellSchema();
    properties["cost"] = costSchema();
    for (const auto& [key, part] : judgements)
        properties[key] = part;
    return schemaDocument("report", "A report of 'kaustik run'", std::move(schema));
}

}  // namespace kaustik::report
