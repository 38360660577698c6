// SPDX-License-Identifier: MIT
// kaustik check: what this device offers, what it lacks for which program, and which others there
// are.
#include <fmt/format.h>

#include <optional>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/gl/device_needs.h"
#include "framework/image/image.h"
#include "framework/run/program_account.h"
#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::app {
namespace {

// Each device that EGL lists, the one in use marked.
void printDevices(const gl::DeviceInfo& inUse) {
    const std::vector<gl::ListedDevice> devices = gl::listDevices();
    fmt::print("devices           {}\n", devices.empty() ? "EGL lists none; its default is in use"
                                                         : "--device takes a number, a UUID or a "
                                                           "part of a name");
    for (const gl::ListedDevice& device : devices) {
        const gl::DeviceInfo& info = device.info;
        // EGL's default is one of those that it lists, by another way.
        const bool isUsed = inUse.index == info.index ||
                            (inUse.index < 0 && !inUse.uuid.empty() && inUse.uuid == info.uuid);
        fmt::print("  {} {}  {}", isUsed ? '*' : ' ', info.index,
                   device.problem.empty() ? info.renderer : "no context, " + device.problem);
        if (!info.uuid.empty()) fmt::print(", UUID {}", info.uuid);
        if (!info.node.empty()) fmt::print(", {}", info.node);
        if (info.isSoftware) fmt::print(", on the processor");
        if (device.isGiven) fmt::print(", {}given to this job", *device.isGiven ? "" : "not ");
        fmt::print("\n");
    }
}

// What programs of all nodes keep to, next to what the device gives. False where that is less.
bool printNeeds() {
    bool isEnough = true;
    fmt::print("programs need at most\n");
    for (const gl::DeviceNeed& need : gl::deviceNeeds()) {
        const int given = gl::givenOf(need);
        isEnough = isEnough && given >= need.needed;
        fmt::print("  {} {:<37}{}, of {} here\n", given >= need.needed ? ' ' : '!', need.what,
                   need.needed, given);
    }
    return isEnough;
}

// The programs of every technique, by its defaults and as published, on the scene that 'run' takes
// by default: pictures of few pixels and photons, of which none is rendered. False where one does
// not fit.
bool printPrograms(gl::Context& context, const Registry& registry) {
    const std::string name = SceneOptions().scene;
    const scene::Scene scene = scene::loadScene(name);
    run::ProgramAccount account;
    std::optional<Renderer> renderer;
    const auto add = [&](const std::string& technique, bool isAsPublished) {
        RenderSettings settings = run::makeSettings(
            {.technique = technique,
             .assignments = {{"emit.photons", "64x64", "check"}, {"refine.memory", "1", "check"}},
             .isAsPublished = isAsPublished},
            registry);
        run::setSize(settings, {64, 48});
        if (renderer) {
            renderer->update(std::move(settings));
        } else {
            renderer.emplace(context, registry, scene, std::move(settings));
        }
        for (const Purpose purpose : {Purpose::picture, Purpose::measurement}) {
            renderer->build(purpose);
            account.add(*renderer);
        }
    };
    for (const Technique& technique : registry.techniques()) {
        for (const bool isAsPublished : {false, true}) {
            if (isAsPublished && technique.asPublished.empty()) continue;
            try {
                add(technique.name, isAsPublished);
            } catch (const ConfigError&) {  // of a technique that is not for this scene
            }
        }
    }
    fmt::print("{}", account.text(fmt::format("all techniques on '{}'", name)));
    return account.problems().empty();
}

}  // namespace

void checkCommand(const Registry& registry) {
    fmt::print("kaustik {}\n", versionString());
    fmt::print("project files     {}\n", projectRoot().string());
    fmt::print("images            {}\n", imageFormats());
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless();
    const gl::DeviceInfo& device = context->info();
    fmt::print("device            {}\n", device.renderer);
    if (!device.uuid.empty()) fmt::print("UUID              {}\n", device.uuid);
    fmt::print("vendor            {}\n", device.vendor);
    fmt::print("OpenGL            {}\n", device.version);
    fmt::print("EGL platform      {}\n", device.platform);
    fmt::print("largest texture   {0}x{0}, {1} layers\n", device.maxTextureSize,
               device.maxTextureLayers);
    fmt::print("largest viewport  {0}x{0}\n", device.maxViewport);
    fmt::print("storage block     {} MiB\n", device.maxStorageBlockBytes >> 20);
    fmt::print("buffer texture    {} texels\n", device.maxBufferTexels);
    if (device.availableBytes > 0) {
        fmt::print("free memory       {} MiB\n", device.availableBytes >> 20);
    }
    fmt::print("robust context    {}\n",
               device.robust ? "yes" : "no: a lost device may go unnoticed");
    const bool isEnough = printNeeds();
    const bool isFitting = printPrograms(*context, registry);
    printDevices(device);  // makes other contexts current
    if (isEnough && isFitting) {
        fmt::print("Everything that Kaustik needs is there.\n");
    } else {
        fmt::print(
            "What a node needs of the lines marked with '!' may not run; it says so, by name.\n");
    }
}

}  // namespace kaustik::app
