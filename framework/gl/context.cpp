// SPDX-License-Identifier: MIT
#include "framework/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/gl/egl_devices.h"

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

// What can be had at most. What is free just now is no limit: a driver moves out what others have
// left, and some that offer the extension without being its vendor's say that nothing is free.
// Those that contradict themselves are not believed.
long long availableDeviceBytes(bool isSoftware) {
    if (isSoftware) return availableSystemBytes();
    if (!epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) return 0;
    GLint total = 0;
    GLint free = 0;
    glGetIntegerv(GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX, &total);
    glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, &free);
    if (glGetError() != GL_NO_ERROR || free < 0 || total < free) return 0;
    return static_cast<long long>(total) * 1024;
}

// Of the device of the current context.
std::string deviceUuid() {
    if (!epoxy_has_gl_extension("GL_EXT_memory_object")) return "";
    std::array<unsigned char, GL_UUID_SIZE_EXT> uuid{};
    glGetUnsignedBytei_vEXT(GL_DEVICE_UUID_EXT, 0, uuid.data());
    return uuidText(uuid);
}

// Surfaceless (Mesa) is EGL's default; else the device platform (vendors' drivers).
EGLDisplay displayOf(const EglDevice& device) {
    if (device.index < 0) {
        return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY,
                                        nullptr);
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr);
}

std::string platformOf(const EglDevice& device) {
    return device.index < 0 ? "surfaceless" : fmt::format("device {}", device.index);
}

bool eglHas(const char* extension) {
    const char* text = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return text != nullptr && std::string(text).find(extension) != std::string::npos;
}

std::string environmentText(const char* name) {
    const char* text = std::getenv(name);
    return text != nullptr ? text : "";
}

bool environmentDebugs() {
    const std::string text = environmentText("KAUSTIK_GL_DEBUG");
    return !text.empty() && text != "0";
}

// What a driver that has no OpenGL 4.5 has instead, "" where that is nothing.
std::string olderOpenGl(EGLDisplay display) {
    const EGLContext older = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
    if (older == EGL_NO_CONTEXT) return "";
    std::string text;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, older) == EGL_TRUE) {
        const auto name = [](GLenum of) {
            const GLubyte* found = glGetString(of);
            return std::string(found != nullptr ? reinterpret_cast<const char*>(found) : "?");
        };
        text = fmt::format(
            "the driver of {} has OpenGL {}; 4.5 is needed, which a newer driver may "
            "have",
            name(GL_RENDERER), name(GL_VERSION));
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, older);
    return text;
}

// Graphics devices of this machine that this user may not open, in words; "" where there is none.
std::string forbiddenNodes() {
    std::vector<std::string> nodes;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/dev/dri", ignored)) {
        const std::string path = entry.path().string();
        if (entry.path().filename().string().starts_with("renderD") &&
            ::access(path.c_str(), R_OK | W_OK) != 0)
            nodes.push_back(path);
    }
    if (nodes.empty()) return "";
    return fmt::format(
        " This account may not open {}; who administers the machine can add it to the group that "
        "may, 'render' on Debian.",
        fmt::join(nodes, ", "));
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

// A process has a display once: eglInitialize gives all of its contexts the same, and eglTerminate
// would take it from all of them.
class SharedDisplays {
  public:
    bool open(EGLDisplay display) {
        const std::lock_guard lock(mutex_);
        EGLint major = 0;
        EGLint minor = 0;
        if (eglInitialize(display, &major, &minor) != EGL_TRUE) return false;
        ++users_[display];
        return true;
    }
    void close(EGLDisplay display) {
        const std::lock_guard lock(mutex_);
        if (--users_[display] == 0) eglTerminate(display);
    }

  private:
    std::mutex mutex_;
    std::map<EGLDisplay, int> users_;
};

SharedDisplays& sharedDisplays() {
    static auto* const displays = new SharedDisplays;  // for contexts that live until the end
    return *displays;
}

}  // namespace

struct Context::Egl {
    EglDevice device;
    EGLDisplay display = EGL_NO_DISPLAY;  // in use by this
    EGLContext context = EGL_NO_CONTEXT;
    bool robust = false;

    Egl() = default;
    Egl(const Egl&) = delete;
    Egl& operator=(const Egl&) = delete;
    ~Egl() {
        if (display == EGL_NO_DISPLAY) return;
        if (context != EGL_NO_CONTEXT) {
            if (eglGetCurrentContext() == context)
                eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display, context);
        }
        sharedDisplays().close(display);
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

void prepareEgl() {
    // Mesa says "DISPLAY" things on standard error when it is asked about drivers; keep it quiet.
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);
    requireLibraries();
    if (eglHas("EGL_EXT_platform_base")) return;
    throw DeviceError(
        "No OpenGL 4.5 context could be had through EGL (this EGL has no platform displays, "
        "EGL_EXT_platform_base). Install a driver; without a GPU, Debian's libegl-mesa0 and "
        "libgl1-mesa-dri render on the processor.",
        kExitFailed);
}

bool containsIgnoringCase(const std::string& text, const std::string& part) {
    const auto same = [](unsigned char a, unsigned char b) {
        return std::tolower(a) == std::tolower(b);
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

std::string joined(const std::vector<std::string>& words, const char* between = ", ") {
    return fmt::format("{}", fmt::join(words, between));
}

}  // namespace

std::unique_ptr<Context> Context::createOn(const EglDevice& device, bool debugs,
                                           std::string& problem) {
    const std::string platform = platformOf(device);
    const auto fails = [&](std::string reason) {
        problem = fmt::format("{}: {}", platform, std::move(reason));
        return std::unique_ptr<Context>();
    };
    if (device.index < 0 && !eglHas("EGL_MESA_platform_surfaceless")) return fails("not offered");
    const EGLDisplay display = displayOf(device);
    if (display == EGL_NO_DISPLAY || !sharedDisplays().open(display))
        return fails(fmt::format("no display ({})", eglErrorText()));
    auto egl = std::make_unique<Egl>();
    egl->device = device;
    egl->display = display;
    eglBindAPI(EGL_OPENGL_API);
    for (const bool robust : {true, false}) {
        egl->context = createContext(display, robust, debugs);
        egl->robust = robust;
        if (egl->context != EGL_NO_CONTEXT) break;
    }
    if (egl->context == EGL_NO_CONTEXT) {
        const std::string reason = fmt::format("no OpenGL 4.5 core context ({})", eglErrorText());
        const std::string older = olderOpenGl(display);
        return fails(older.empty() ? reason : older);
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context) != EGL_TRUE)
        return fails(fmt::format("the context cannot be made current ({})", eglErrorText()));
    std::unique_ptr<Context> context(new Context(std::move(egl)));
    context->readInfo();
    if (!context->info_.missing.empty()) {
        return fails(fmt::format("{} lacks {}", context->info_.renderer,
                                 fmt::join(context->info_.missing, ", ")));
    }
    context->info_.debugs = debugs;
    if (debugs) context->enableDebugOutput();
    return context;
}

// Of several that answer to the name, the one that the job was given.
EglDevice Context::deviceNamed(const std::string& name, const GivenDevices& given) {
    std::vector<EglDevice> found;
    std::vector<std::string> names;
    std::optional<EglDevice> refused;
    for (const EglDevice& device : listEglDevices()) {
        std::string problem;
        const std::unique_ptr<Context> context = createOn(device, false, problem);
        if (context == nullptr) continue;
        names.push_back(fmt::format("{} {}", device.index, context->info().renderer));
        if (!containsIgnoringCase(context->info().renderer, name)) continue;
        if (isGiven(device, given).value_or(true)) {
            found.push_back(device);
        } else {
            refused = device;
        }
    }
    if (found.size() == 1) return found.front();
    if (found.empty() && refused) requireGiven(*refused, given);
    throw ConfigError(fmt::format("--device: {} is called '{}'; say one of them by its number: {}.",
                                  found.empty() ? "no device" : "more than one device", name,
                                  names.empty() ? "EGL lists none" : joined(names)));
}

std::unique_ptr<Context> Context::createHeadless(bool debugs, const std::string& device) {
    debugs = debugs || environmentDebugs();
    prepareEgl();
    const GivenDevices given = givenDevices([](const char* name) { return std::getenv(name); });
    const std::string wanted = device.empty() ? environmentText("KAUSTIK_DEVICE") : device;
    std::vector<EglDevice> candidates;
    if (wanted.empty()) {
        candidates = inPreferenceOrder(listEglDevices(), given);
    } else {
        candidates = matchingDevices(listEglDevices(), wanted, given);
        if (candidates.empty()) candidates.push_back(deviceNamed(wanted, given));
        if (candidates.size() > 1) {
            throw ConfigError(
                fmt::format("--device: more than one device has a UUID that begins "
                            "with '{}'; 'kaustik check' lists them.",
                            wanted));
        }
    }
    std::vector<std::string> tried;
    for (const EglDevice& candidate : candidates) {
        std::string problem;
        if (std::unique_ptr<Context> context = createOn(candidate, debugs, problem)) return context;
        tried.push_back(std::move(problem));
    }
    throw DeviceError(
        fmt::format("No OpenGL 4.5 context could be had through EGL ({}).{} Install a driver; "
                    "without a GPU, Debian's libegl-mesa0 and libgl1-mesa-dri render on the "
                    "processor.",
                    joined(tried, "; "), forbiddenNodes()),
        kExitFailed);
}

std::vector<ListedDevice> listDevices() {
    prepareEgl();
    const GivenDevices given = givenDevices([](const char* name) { return std::getenv(name); });
    std::vector<ListedDevice> listed;
    for (const EglDevice& device : listEglDevices()) {
        ListedDevice entry;
        entry.isGiven = isGiven(device, given);
        const std::unique_ptr<Context> context = Context::createOn(device, false, entry.problem);
        if (context != nullptr) {
            entry.info = context->info();
        } else {
            entry.info.index = device.index;
            entry.info.uuid = device.uuid;
            entry.info.node = device.node;
        }
        listed.push_back(std::move(entry));
    }
    return listed;
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
    info_.platform = platformOf(egl_->device);
    info_.index = egl_->device.index;
    info_.uuid = egl_->device.uuid.empty() ? deviceUuid() : egl_->device.uuid;
    info_.node = egl_->device.node;
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
    info_.maxBufferTexels = integer(GL_MAX_TEXTURE_BUFFER_SIZE);
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
            fmt::format("The device was lost {}; if it repeats, take less work a pass, such as a "
                        "smaller emit.batch or picture.",
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
