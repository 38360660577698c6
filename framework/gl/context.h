// SPDX-License-Identifier: MIT
// An OpenGL 4.5 core context without a window or a display: EGL surfaceless, else the device
// platform. An OpenGL error fails the run; where the context debugs, by the name of the pass in
// which it was raised and in the driver's words. The context is robust: a lost device is a
// DeviceError.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace kaustik::gl {

struct DeviceInfo {
    std::string renderer;
    std::string vendor;
    std::string version;
    std::string platform;  // which EGL platform gave the context
    int maxTextureSize = 0;
    int maxViewport = 0;
    int maxTextureLayers = 0;
    long long maxStorageBlockBytes = 0;
    // Free at the start; 0 where the device does not say. A software rasteriser uses the machine's,
    // which the system would promise without having.
    long long availableBytes = 0;
    bool robust = false;
    bool debugs = false;               // a debug context with synchronous output
    bool isSoftware = false;           // renders on the processor, as Mesa does without a GPU
    std::vector<std::string> missing;  // what the project needs and the device lacks
};

class Context {
  public:
    // Makes the context current on this thread. Throws DeviceError (exit code 1) that says what was
    // tried when there is no EGL, no OpenGL 4.5, or something that every node needs is missing.
    // It debugs where `debugs` or the environment's KAUSTIK_GL_DEBUG=1 says so, which takes time.
    [[nodiscard]] static std::unique_ptr<Context> createHeadless(bool debugs = false);
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
    explicit Context(std::unique_ptr<Egl> egl);
    void readInfo();
    void enableDebugOutput();

    std::unique_ptr<Egl> egl_;
    DeviceInfo info_;
    std::string scope_ = "at start-up";
    std::string firstError_;
    bool outOfMemory_ = false;
};

}  // namespace kaustik::gl
