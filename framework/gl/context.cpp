// SPDX-License-Identifier: MIT
#include "framework/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::gl {
namespace {

std::string eglErrorText() {
    return fmt::format("EGL error 0x{:x}", static_cast<unsigned>(eglGetError()));
}

// Bytes of the machine's memory that are free or can be freed; 0 where the system does not say.
long long availableSystemBytes() {
    std::ifstream file("/proc/meminfo");
    for (std::string name; file >> name;) {
        long long kibibytes = 0;
        if (name == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024;
        file.ignore(256, '\n');
    }
    return 0;
}

bool isSoftwareRasteriser(const std::string& renderer) {
    for (const char* name : {"llvmpipe", "softpipe", "SWR"}) {
        if (renderer.find(name) != std::string::npos) return true;
    }
    return false;
}

long long availableDeviceBytes(bool isSoftware) {
    if (isSoftware) return availableSystemBytes();
    if (!epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) return 0;
    GLint kibibytes = 0;
    glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, &kibibytes);
    return static_cast<long long>(kibibytes) * 1024;
}

struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string platform;
};

// Surfaceless first (Mesa), then every device of the device platform (vendor drivers).
std::vector<Candidate> candidateDisplays(std::vector<std::string>& tried) {
    std::vector<Candidate> candidates;
    const char* text = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const std::string extensions = text != nullptr ? text : "";
    const auto has = [&](const char* name) { return extensions.find(name) != std::string::npos; };
    if (!has("EGL_EXT_platform_base")) {
        tried.emplace_back("this EGL has no platform displays (EGL_EXT_platform_base)");
        return candidates;
    }
    if (has("EGL_MESA_platform_surfaceless")) {
        candidates.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             "surfaceless"});
    } else {
        tried.emplace_back("surfaceless: not offered");
    }
    if (has("EGL_EXT_platform_device") && has("EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            candidates.push_back(
                {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                          devices[static_cast<std::size_t>(i)], nullptr),
                 fmt::format("device {}", i)});
        }
    }
    return candidates;
}

bool environmentDebugs() {
    const char* text = std::getenv("KAUSTIK_GL_DEBUG");
    return text != nullptr && std::strcmp(text, "") != 0 && std::strcmp(text, "0") != 0;
}

EGLContext createContext(EGLDisplay display, bool robust, bool debugs) {
    std::vector<EGLint> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,       4,
        EGL_CONTEXT_MINOR_VERSION,       5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_CONTEXT_OPENGL_DEBUG,        debugs ? EGL_TRUE : EGL_FALSE};
    if (robust) {
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                                             EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                             EGL_LOSE_CONTEXT_ON_RESET});
    }
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

struct Context::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string platform;
    bool robust = false;
    ~Egl() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
};

namespace {

// libepoxy ends the program when it finds no library to load; look first.
void requireLibraries() {
    const auto canLoad = [](const char* name) {
        void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
        if (library != nullptr) dlclose(library);
        return library != nullptr;
    };
    if (!canLoad("libEGL.so.1")) {
        throw DeviceError(
            "The EGL library (libEGL.so.1) cannot be loaded. Install it: on Debian, libegl1, and "
            "libegl-mesa0 for a driver that needs no GPU.",
            kExitFailed);
    }
    if (!canLoad("libOpenGL.so.0") && !canLoad("libGL.so.1")) {
        throw DeviceError(
            "The OpenGL library (libGL.so.1) cannot be loaded. Install it: on Debian, libgl1, and "
            "libgl1-mesa-dri for a driver that needs no GPU.",
            kExitFailed);
    }
}

}  // namespace

std::unique_ptr<Context> Context::createHeadless(bool debugs) {
    debugs = debugs || environmentDebugs();
    // Mesa says "DISPLAY" things on standard error when it is asked about drivers; keep it quiet.
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);
    requireLibraries();
    std::vector<std::string> tried;
    for (const Candidate& candidate : candidateDisplays(tried)) {
        if (candidate.display == EGL_NO_DISPLAY) continue;
        auto egl = std::make_unique<Egl>();
        EGLint major = 0;
        EGLint minor = 0;
        if (eglInitialize(candidate.display, &major, &minor) != EGL_TRUE) {
            tried.push_back(fmt::format("{}: no display ({})", candidate.platform, eglErrorText()));
            continue;
        }
        egl->display = candidate.display;
        egl->platform = candidate.platform;
        eglBindAPI(EGL_OPENGL_API);
        for (const bool robust : {true, false}) {
            egl->context = createContext(egl->display, robust, debugs);
            egl->robust = robust;
            if (egl->context != EGL_NO_CONTEXT) break;
        }
        if (egl->context == EGL_NO_CONTEXT) {
            tried.push_back(fmt::format("{}: no OpenGL 4.5 core context ({})", candidate.platform,
                                        eglErrorText()));
            continue;
        }
        if (eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context) !=
            EGL_TRUE) {
            tried.push_back(fmt::format("{}: the context cannot be made current ({})",
                                        candidate.platform, eglErrorText()));
            continue;
        }
        std::unique_ptr<Context> context(new Context(std::move(egl)));
        context->readInfo();
        if (!context->info_.missing.empty()) {
            tried.push_back(fmt::format("{}: {} lacks {}", candidate.platform,
                                        context->info_.renderer,
                                        fmt::join(context->info_.missing, ", ")));
            continue;
        }
        context->info_.debugs = debugs;
        if (debugs) context->enableDebugOutput();
        return context;
    }
    throw DeviceError(
        fmt::format(
            "No OpenGL 4.5 context could be had through EGL ({}). Install a driver; without "
            "a GPU, Debian's libegl-mesa0 and libgl1-mesa-dri render on the processor.",
            tried.empty() ? "no EGL display is offered"
                          : fmt::format("{}", fmt::join(tried, "; "))),
        kExitFailed);
}

Context::Context(std::unique_ptr<Egl> egl) : egl_(std::move(egl)) {}
Context::~Context() = default;

void Context::readInfo() {
    const auto text = [](GLenum name) {
        return std::string(reinterpret_cast<const char*>(glGetString(name)));
    };
    const auto integer = [](GLenum name) {
        GLint value = 0;
        glGetIntegerv(name, &value);
        return value;
    };
    info_.renderer = text(GL_RENDERER);
    info_.vendor = text(GL_VENDOR);
    info_.version = text(GL_VERSION);
    info_.platform = egl_->platform;
    info_.robust = egl_->robust;
    info_.isSoftware = isSoftwareRasteriser(info_.renderer);
    info_.availableBytes = availableDeviceBytes(info_.isSoftware);
    info_.maxTextureSize = integer(GL_MAX_TEXTURE_SIZE);
    info_.maxTextureLayers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    info_.maxViewport = std::min(viewport[0], viewport[1]);
    GLint64 block = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    info_.maxStorageBlockBytes = block;
    // OpenGL 4.5 promises no storage blocks outside of compute shaders; transforms are read there.
    if (integer(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS) < 4) {
        info_.missing.emplace_back("storage blocks in vertex shaders");
    }
    if (integer(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS) < 4) {
        info_.missing.emplace_back("storage blocks in fragment shaders");
    }
}

void Context::enableDebugOutput() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, GL_DONT_CARE, 0, nullptr,
                          GL_TRUE);
    // What a compiler says arrives as a ShaderError with its place in the source.
    glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr,
                          GL_FALSE);
    glDebugMessageCallback(
        [](GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar* message, const void* user) {
            auto* self = static_cast<Context*>(const_cast<void*>(user));
            if (self->firstError_.empty()) {
                self->firstError_ = fmt::format("OpenGL error {}: {}", self->scope_, message);
            }
            if (std::strstr(message, "OUT_OF_MEMORY") != nullptr) self->outOfMemory_ = true;
        },
        this);
}

void Context::check() {
    const GLenum status = egl_->robust ? glGetGraphicsResetStatus() : GL_NO_ERROR;
    if (status != GL_NO_ERROR) {
        throw DeviceError(
            fmt::format("The device was lost {}. Nothing of this run is kept; start it again, with "
                        "less work a pass if it repeats.",
                        scope_));
    }
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        if (error == GL_OUT_OF_MEMORY) outOfMemory_ = true;
        if (firstError_.empty()) {
            firstError_ = fmt::format("OpenGL error 0x{:x} {}", error, scope_);
        }
    }
    if (firstError_.empty()) return;
    const std::string message = std::exchange(firstError_, "");
    if (std::exchange(outOfMemory_, false)) {
        throw DeviceError(
            fmt::format("The device is out of memory {}. Use fewer photons, layers or pixels. ({})",
                        scope_, message));
    }
    throw DeviceError(
        message + (info_.debugs ? "." : "; --gl-debug names the pass and says what is wrong."),
        kExitFailed);
}

void Context::finish() {
    glFinish();
}

}  // namespace kaustik::gl
