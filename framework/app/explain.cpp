// SPDX-License-Identifier: MIT
// kaustik explain: what a scene needs, every pass with the reason that it runs or was skipped, and
// every resource.
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
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(options.scene.glDebug);
    run::Session session(*context, registry, scene, std::move(settings));
    session.measureDepthComplexity();
    session.prepare();
    if (!options.dotFile.empty())
        writeFileWhole(options.dotFile, session.renderer().graph().toDot());
    fmt::print("{}", run::explain(session.renderer()));
    if (model) {
        session.modelCost(*model);
        fmt::print("{}", report::costTable(*session.record().cost));
    }
    if (!options.dotFile.empty()) fmt::print("wrote {}\n", options.dotFile);
}

}  // namespace kaustik::app
