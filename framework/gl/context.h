// SPDX-License-Identifier: MIT
// An OpenGL 4.5 core context without a window or a display: EGL surfaceless, else the device
// platform. An OpenGL error fails the run; where the context debugs, by the name of the pass in
// which it was raised and in the driver's words. The context is robust: a lost device is a
// DeviceError.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kaustik::gl {

struct DeviceInfo {
    std::string renderer;
    std::string vendor;
    std::string version;
    std::string platform;  // which EGL platform gave the context
    int index = -1;        // among EGL's devices; -1: EGL's default
    std::string uuid;      // as nvidia-smi and Vulkan have it; "" where that is not known
    std::string node;      // such as /dev/dri/renderD128, or ""
    int maxTextureSize = 0;
    int maxViewport = 0;
    int maxTextureLayers = 0;
    long long maxStorageBlockBytes = 0;
    long long maxBufferTexels = 0;
    // Free at the start; 0 where the device does not say. A software rasteriser uses the machine's,
    // which the system would promise without having.
    long long availableBytes = 0;
    bool robust = false;
    bool debugs = false;               // a debug context with synchronous output
    bool isSoftware = false;           // renders on the processor, as Mesa does without a GPU
    std::vector<std::string> missing;  // what the project needs and the device lacks
};

struct EglDevice;
struct GivenDevices;
struct ListedDevice;

class Context {
  public:
    // Makes the context current on this thread. Throws DeviceError (exit code 1) that says what was
    // tried when there is no EGL, no OpenGL 4.5, or something that every node needs is missing.
    // It debugs where `debugs` or the environment's KAUSTIK_GL_DEBUG=1 says so, which takes time.
    // `device`: a number, a UUID or its beginning, or a part of a renderer's name; "" for what the
    // environment's KAUSTIK_DEVICE says, else the best that the job was given (egl_devices.h).
    // ConfigError for one that is not there, not given, or not the only one of its name.
    [[nodiscard]] static std::unique_ptr<Context> createHeadless(bool debugs = false,
                                                                 const std::string& device = "");
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    [[nodiscard]] const DeviceInfo& info() const { return info_; }

    // What the error messages will name: where commands are issued from now on ("in pass 'x'").
    void setScope(std::string where) { scope_ = std::move(where); }

    // Throws if an OpenGL error was raised since the last call, or the device was lost:
    // out of memory and a reset are exit code 3, every other error 1.
    void check();

    // Waits until the device is idle.
    void finish();

  private:
    struct Egl;
    friend std::vector<ListedDevice> listDevices();
    // Null, with why not, where there can be no context.
    [[nodiscard]] static std::unique_ptr<Context> createOn(const EglDevice& device, bool debugs,
                                                           std::string& problem);
    [[nodiscard]] static EglDevice deviceNamed(const std::string& name, const GivenDevices& given);
    explicit Context(std::unique_ptr<Egl> egl);
    void readInfo();
    void enableDebugOutput();

    std::unique_ptr<Egl> egl_;
    DeviceInfo info_;
    std::string scope_ = "at start-up";
    std::string firstError_;
    bool outOfMemory_ = false;
};

// A device that EGL lists, with what a context on it says of itself.
struct ListedDevice {
    DeviceInfo info;
    std::string problem;          // why there is no context on it; then only index, uuid, node hold
    std::optional<bool> isGiven;  // to this job, where that can be told
};

// All that EGL lists, each tried in turn. Throws DeviceError without EGL.
[[nodiscard]] std::vector<ListedDevice> listDevices();

}  // namespace kaustik::gl
