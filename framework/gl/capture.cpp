// SPDX-License-Identifier: MIT
#include "framework/gl/capture.h"

#include <dlfcn.h>
#include <epoxy/gl.h>

#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/error.h"

namespace kaustik::gl {
namespace {

// RenderDoc's in-application interface, version 1.1.2: a table of functions, of which these are
// called. Those in between stand for their places.
struct RenderDoc {
    void* first[11];
    void (*setCaptureFilePathTemplate)(const char* pathTemplate);
    void* getCaptureFilePathTemplate;
    std::uint32_t (*numberOfCaptures)();
    std::uint32_t (*capture)(std::uint32_t index, char* file, std::uint32_t* length,
                             std::uint64_t* timestamp);
    void* next[4];
    void (*startFrameCapture)(void* device, void* window);  // null, null: the only one there is
    std::uint32_t (*isFrameCapturing)();
    std::uint32_t (*endFrameCapture)(void* device, void* window);  // 1: it is written
};

constexpr int kVersion = 10102;

// Null where it is not loaded. It is never loaded here: it must be there before OpenGL is.
RenderDoc* loadedRenderDoc() {
    void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
    if (library == nullptr) return nullptr;
    const auto get = reinterpret_cast<int (*)(int, void**)>(dlsym(library, "RENDERDOC_GetAPI"));
    dlclose(library);
    void* found = nullptr;
    if (get == nullptr || get(kVersion, &found) != 1) return nullptr;
    return static_cast<RenderDoc*>(found);
}

// RenderDoc looks for the default framebuffer then, which there is not: its errors are not ours.
bool endCapture(RenderDoc& renderDoc) {
    const bool isDebugged = glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE;
    glDisable(GL_DEBUG_OUTPUT);
    const bool isWritten = renderDoc.endFrameCapture(nullptr, nullptr) == 1;
    while (glGetError() != GL_NO_ERROR) {
    }
    if (isDebugged) glEnable(GL_DEBUG_OUTPUT);
    return isWritten;
}

}  // namespace

void requireRenderDoc() {
    if (loadedRenderDoc() != nullptr) return;
    throw ConfigError(
        "--capture: RenderDoc is not loaded; start this command with it, as 'renderdoccmd capture "
        "--wait-for-exit kaustik run …'.");
}

std::filesystem::path captureFrame(const std::filesystem::path& folder,
                                   const std::function<void()>& frame) {
    requireRenderDoc();
    RenderDoc& renderDoc = *loadedRenderDoc();
    const std::uint32_t before = renderDoc.numberOfCaptures();
    renderDoc.setCaptureFilePathTemplate((folder / "frame").c_str());
    renderDoc.startFrameCapture(nullptr, nullptr);
    frame();
    const bool isWritten = endCapture(renderDoc);
    std::uint32_t length = 0;
    if (!isWritten || renderDoc.capture(before, nullptr, &length, nullptr) != 1 || length == 0)
        throw IoError("--capture: RenderDoc has captured nothing; its own log says why.");
    std::vector<char> file(length + 1, '\0');
    renderDoc.capture(before, file.data(), &length, nullptr);
    return std::string(file.data());
}

}  // namespace kaustik::gl
