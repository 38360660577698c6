// SPDX-License-Identifier: MIT
#include "framework/gui/window.h"

#include <epoxy/gl.h>
// After epoxy.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::gui {
namespace {
namespace fs = std::filesystem;

constexpr const char* kWithoutWindow =
    "'kaustik run' renders without a window, and 'kaustik check' says what this device offers.";

std::string& lastGlfwError() {
    static std::string error;
    return error;
}

// A window may have been left on a larger screen.
void fitToScreen(GLFWwindow* window) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    if (monitor != nullptr) glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    int ownWidth = 0;
    int ownHeight = 0;
    glfwGetWindowSize(window, &ownWidth, &ownHeight);
    if (width > 0 && height > 0 && (ownWidth > width || ownHeight > height))
        glfwSetWindowSize(window, std::min(ownWidth, width), std::min(ownHeight, height));
}

GLFWwindow* tryWindow(const std::string& title, const Window::Placement& placement, int api,
                      bool robust) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);  // until it has its size and place
    // At the first start; later the size is the one that it was left with.
    if (placement.x < 0) glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    if (robust) glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    return glfwCreateWindow(placement.width, placement.height, title.c_str(), nullptr, nullptr);
}

}  // namespace

Window::Window(const std::string& title, const Placement& placement, const fs::path& imguiSettings)
    : iniFile_(imguiSettings.string()) {
    glfwSetErrorCallback([](int, const char* text) { lastGlfwError() = text; });
#ifdef GLFW_PLATFORM  // GLFW 3.4 asks for a Wayland that does not run, and libwayland complains
    const char* wayland = std::getenv("WAYLAND_DISPLAY");
    if (wayland == nullptr || *wayland == '\0') glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (glfwInit() != GLFW_TRUE) {
        throw DeviceError(fmt::format("There is no display to open a window on ({}). {}",
                                      lastGlfwError(), kWithoutWindow),
                          kExitFailed);
    }
    // EGL first: the renderer's thread uses it as well.
    for (const auto& [api, robust] :
         {std::pair{GLFW_EGL_CONTEXT_API, true}, std::pair{GLFW_EGL_CONTEXT_API, false},
          std::pair{GLFW_NATIVE_CONTEXT_API, true}, std::pair{GLFW_NATIVE_CONTEXT_API, false}}) {
        window_ = tryWindow(title, placement, api, robust);
        isRobust_ = robust;
        if (window_ != nullptr) break;
    }
    if (window_ == nullptr) {
        glfwTerminate();
        throw DeviceError(
            fmt::format("No window with OpenGL 4.5 can be opened on this display ({}). {}",
                        lastGlfwError(), kWithoutWindow),
            kExitFailed);
    }
    fitToScreen(window_);
    if (placement.x >= 0 && placement.y >= 0) glfwSetWindowPos(window_, placement.x, placement.y);
    glfwShowWindow(window_);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    const GLubyte* name = glGetString(GL_RENDERER);
    renderer_ = name != nullptr ? reinterpret_cast<const char*>(name) : "";
    glfwSetWindowUserPointer(window_, this);
    // Before Dear ImGui's own, which call these.
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
        self.dropped_.assign(paths, paths + count);
        self.hadInput_ = true;
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int, int, int) {
        ++static_cast<Window*>(glfwGetWindowUserPointer(window))->strokes_;
    });

    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = iniFile_.c_str();
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    float scaleY = 1.0f;
    glfwGetWindowContentScale(window_, &scale_, &scaleY);
    // A screen of 100 dpi is no reason to blur every line.
    scale_ = std::clamp(std::round(scale_ * 4.0f) / 4.0f, 1.0f, 4.0f);
    // Dear ImGui's 0.3 s is short where a frame takes long.
    ImGui::GetIO().MouseDoubleClickTime = 0.5f;
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0.0f;
    style.FrameRounding = 3.0f;
    style.Colors[ImGuiCol_PopupBg].w = 1.0f;
    style.ScaleAllSizes(scale_);
    loadFont();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    clipboard_.use(window_);
    // Instead of Dear ImGui's own, which takes keys by their place: Ctrl + A in a field is a short
    // cut, too.
    glfwSetKeyCallback(window_,
                       [](GLFWwindow* window, int place, int scancode, int action, int modifiers) {
                           auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
                           const int key = self.keyNames_(place, scancode, action);
                           self.noteKey(place, key, action, modifiers);
                           if (key != GLFW_KEY_UNKNOWN)
                               sendKey(window, key, scancode, action, modifiers);
                       });
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::loadFont() {
    // Dear ImGui's own font has neither squares nor dashes.
    static const std::array<ImWchar, 15> glyphs = {0x20,   0x17f,  // Latin
                                                   0x370,  0x3ff,  // Greek
                                                   0x2010, 0x2027, 0x2070, 0x209f, 0x2190, 0x21ff,
                                                   0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
    const float size = 15.0f * scale_;
    for (const char* file :
         {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
          "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"}) {
        std::error_code error;
        if (!fs::is_regular_file(file, error)) continue;
        if (ImGui::GetIO().Fonts->AddFontFromFileTTF(file, size, nullptr, glyphs.data())) return;
    }
    ImFontConfig config;
    config.SizePixels = 13.0f * scale_;
    ImGui::GetIO().Fonts->AddFontDefault(&config);
}

bool Window::isClosing() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::hide() {
    glfwHideWindow(window_);
    glfwPollEvents();
}

void Window::beginFrame(double waitSeconds) {
    hadInput_ = !dropped_.empty();
    keyPresses_.clear();
    const double begin = glfwGetTime();
    for (auto& [place, held] : held_) {
        held.seconds = 0.0;
        if (held.since >= 0.0) held.since = begin;
    }
    if (waitSeconds > 0.0) {
        glfwWaitEventsTimeout(waitSeconds);
    } else {
        glfwPollEvents();
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::noteKey(int place, int key, int action, int modifiers) {
    constexpr double kShortestTap = 1.0 / 60.0;
    hadInput_ = true;
    if (action != GLFW_REPEAT) ++strokes_;
    Held& held = held_[place];
    if (action == GLFW_PRESS) {
        keyPresses_.push_back({key, modifiers});
        held.since = glfwGetTime();
        held.seconds = kShortestTap;
    } else if (action == GLFW_RELEASE && held.since >= 0.0) {
        held.seconds = std::max(held.seconds, glfwGetTime() - held.since);
        held.since = -1.0;
    }
}

double Window::heldSeconds(int place) const {
    const auto found = held_.find(place);
    if (found == held_.end()) return 0.0;
    const Held& held = found->second;
    return held.since < 0.0 ? held.seconds : std::max(held.seconds, glfwGetTime() - held.since);
}

void Window::drawFrame() {
    ImGui::Render();
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glClearColor(0.06f, 0.06f, 0.07f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::endFrame() {
    glfwSwapBuffers(window_);
    if (isRobust_ && glGetGraphicsResetStatus() != GL_NO_ERROR) {
        throw DeviceError(
            fmt::format("The window's OpenGL context was lost; what was set up is "
                        "kept for the next start. {}",
                        kWithoutWindow));
    }
}

void Window::wake() {
    glfwPostEmptyEvent();
}

std::vector<std::string> Window::takeDropped() {
    return std::exchange(dropped_, {});
}

Window::Placement Window::placement() const {
    Placement placement;
    glfwGetWindowSize(window_, &placement.width, &placement.height);
    glfwGetWindowPos(window_, &placement.x, &placement.y);
    return placement;
}

std::vector<float> Window::readPixels(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<GLubyte> bytes(3 * count);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
    std::vector<float> values(bytes.size());
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        const std::size_t from = (static_cast<std::size_t>(height) - 1 - y) * row;
        for (std::size_t i = 0; i < row; ++i)
            values[y * row + i] = static_cast<float>(bytes[from + i]) / 255.0f;
    }
    return values;
}

}  // namespace kaustik::gui
