// SPDX-License-Identifier: MIT
// kaustik explain: what a scene needs, every pass with the reason that it runs or was skipped,
// every resource, and what the device lacks for it.
#include <fmt/format.h>

#include "framework/app/commands.h"
#include "framework/core/files.h"
#include "framework/run/explanation.h"
#include "framework/run/session.h"

namespace kaustik::app {

void explainCommand(const ExplainOptions& options, const Registry& registry) {
    std::optional<report::DeviceModel> model;
    if (!options.deviceModel.empty())
        model = report::parseDeviceModel(options.deviceModel, "--device-model");
    scene::Scene scene =
        loadRequestedScene(options.scene.scene, options.scene.time, options.scene.scenePlace);
    RenderSettings settings = makeSettings(options.scene, registry);
    settings.asOnGpu = model.has_value();
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(options.scene.glDebug);
    run::Session session(*context, registry, scene, std::move(settings));
    session.measureDepthComplexity();
    session.prepare();
    if (!options.dotFile.empty())
        writeFileWhole(options.dotFile, session.renderer().graph().toDot());
    fmt::print("{}", run::explain(session.renderer()));
    const std::size_t bytes = session.renderer().compiled().allocatedBytes;
    const long long available = context->info().availableBytes;
    fmt::print("memory {} MiB for the frame's textures and buffers{}\n", bytes >> 20,
               available > 0 ? fmt::format(", of {} MiB that are free", available >> 20) : "");
    if (model) {
        session.modelCost(*model);
        fmt::print("{}", report::costTable(*session.record().cost));
    }
    fmt::print("{}", session.accountPrograms().text("a run"));
    if (!options.dotFile.empty()) fmt::print("wrote {}\n", options.dotFile);
}

}  // namespace kaustik::app
