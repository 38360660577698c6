// SPDX-License-Identifier: MIT
// kaustik explain: what a scene needs, every pass with the reason that it runs or was skipped, and
// every resource; kaustik check: what this device offers.
#include <fmt/format.h>

#include <algorithm>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/image.h"

namespace kaustik::app {
namespace {

const char* stateName(graph::PassState state) {
    switch (state) {
        case graph::PassState::ran:
            return "runs";
        case graph::PassState::bypassed:
            return "bypassed";
        case graph::PassState::culled:
            return "culled";
        case graph::PassState::skipped:
            return "skipped";
    }
    return "";
}

void printNeeds(const scene::Scene& scene, const scene::SceneNeeds& needs) {
    fmt::print("scene {}: {} triangles\n", scene.name, triangleCount(scene));
    fmt::print("  specular interfaces on the longest chain  {}\n", needs.specularInterfaces);
    fmt::print("  reflectors, refractors                    {}, {}\n", needs.reflectors,
               needs.refractors);
    fmt::print("  medium                                    {}\n", needs.medium ? "yes" : "none");
    fmt::print("  glossy receivers                          {}\n",
               needs.glossyReceivers ? "yes" : "none");
    fmt::print("  depth complexity from the eye             {}\n",
               needs.measuredDepthComplexity < 0 ? "not measured"
                                                 : std::to_string(needs.measuredDepthComplexity));
    fmt::print("  animated                                  {}\n", needs.animated ? "yes" : "no");
    fmt::print("  lights                                    {}\n", needs.lights);
}

std::string describe(const graph::ResourceDesc& desc) {
    if (const auto* texture = std::get_if<graph::TextureDesc>(&desc)) {
        return fmt::format("{}x{}{} {}", texture->width, texture->height,
                           texture->layers > 0 ? fmt::format("x{}", texture->layers) : "",
                           graph::formatName(texture->format));
    }
    return fmt::format("{} bytes", graph::bytesOf(desc));
}

}  // namespace

void explainCommand(const ExplainOptions& options, const Registry& registry) {
    const scene::Scene scene = loadRequestedScene(options.scene.scene, options.scene.time);
    RenderSettings settings = makeSettings(options.scene, registry);
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(options.scene.glDebug);
    Renderer renderer(*context, registry, scene, std::move(settings));
    renderer.measureDepthComplexity();
    renderer.build(Purpose::picture);
    if (!options.dotFile.empty()) writeFileWhole(options.dotFile, renderer.graph().toDot());
    printNeeds(scene, renderer.needs());
    fmt::print("technique {}\n", renderer.settings().technique.name);
    const std::vector<graph::PassRecord>& passes = renderer.compiled().records;
    std::size_t longest = 0;
    for (const graph::PassRecord& pass : passes)
        longest = std::max(longest, pass.name.size());
    for (const graph::PassRecord& pass : passes)
        fmt::print("  {:<{}}  {:<10}{}\n", pass.name, longest, stateName(pass.state), pass.why);
    fmt::print("resources (--save takes the textures)\n");
    const std::vector<std::string> resources = renderer.graph().resourceNames();
    longest = 0;
    for (const std::string& name : resources)
        longest = std::max(longest, name.size());
    for (const std::string& name : resources) {
        fmt::print("  {:<{}}  {}\n", name, longest,
                   describe(renderer.graph().descOf(renderer.graph().find(name))));
    }
    for (const std::string& warning : renderer.warnings())
        fmt::print("warning: {}\n", warning);
    if (!options.dotFile.empty()) fmt::print("wrote {}\n", options.dotFile);
}

void checkCommand() {
    fmt::print("kaustik {}\n", versionString());
    fmt::print("project files     {}\n", projectRoot().string());
    fmt::print("images            {}\n", hasOpenImageIO()
                                             ? "EXR, PNG and more, through OpenImageIO"
                                             : "PFM and PPM only: no OpenImageIO in this build");
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless();
    const gl::DeviceInfo& device = context->info();
    fmt::print("device            {}\n", device.renderer);
    fmt::print("vendor            {}\n", device.vendor);
    fmt::print("OpenGL            {}\n", device.version);
    fmt::print("EGL platform      {}\n", device.platform);
    fmt::print("largest texture   {0}x{0}, {1} layers\n", device.maxTextureSize,
               device.maxTextureLayers);
    fmt::print("largest viewport  {0}x{0}\n", device.maxViewport);
    fmt::print("storage block     {} MiB\n", device.maxStorageBlockBytes >> 20);
    if (device.availableBytes > 0) {
        fmt::print("free memory       {} MiB\n", device.availableBytes >> 20);
    }
    fmt::print("robust context    {}\n",
               device.robust ? "yes" : "no: a lost device may go unnoticed");
    fmt::print("Everything that Kaustik needs is there.\n");
}

}  // namespace kaustik::app
