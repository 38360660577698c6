// SPDX-License-Identifier: MIT
// kaustik check: what this device offers, and which others there are.
#include <fmt/format.h>

#include "framework/app/commands.h"
#include "framework/core/files.h"
#include "framework/gl/device_needs.h"
#include "framework/image/image.h"

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

}  // namespace

void checkCommand() {
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
    if (device.availableBytes > 0) {
        fmt::print("free memory       {} MiB\n", device.availableBytes >> 20);
    }
    fmt::print("robust context    {}\n",
               device.robust ? "yes" : "no: a lost device may go unnoticed");
    const bool isEnough = printNeeds();
    printDevices(device);  // makes other contexts current
    if (isEnough) {
        fmt::print("Everything that Kaustik needs is there.\n");
    } else {
        fmt::print(
            "What a node needs of the lines marked with '!' may not run; it says so, by name.\n");
    }
}

}  // namespace kaustik::app
