// SPDX-License-Identifier: MIT
// GLFW's functions, each of which loads the library when it is first called, so that the program
// starts where neither GLFW nor X11 is: only the workbench needs them. Those stand here that the
// window and Dear ImGui's backend call; one that is missing is an undefined symbol when the program
// is linked.
#include <dlfcn.h>

#include "framework/core/error.h"
// After the standard headers, as GLFW brings OpenGL's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace kaustik::gui {
namespace {

// Throws DeviceError where the library is not there.
void* glfwLibrary() {
    static void* const library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        throw DeviceError(
            "The workbench needs GLFW, and libglfw.so.3 cannot be loaded. Install it: on Debian, "
            "libglfw3. 'kaustik run' renders without it.",
            kExitFailed);
    }
    return library;
}

template <class Function>
Function glfwFunction(const char* name) {
    void* const found = dlsym(glfwLibrary(), name);
    if (found == nullptr) {
        throw DeviceError(std::string("The GLFW library lacks ") + name +
                              ", which the workbench needs; it needs GLFW 3.3 or newer.",
                          kExitFailed);
    }
    return reinterpret_cast<Function>(found);
}

}  // namespace
}  // namespace kaustik::gui

#define KAUSTIK_GLFW(Result, name, parameters, arguments)                                  \
    extern "C" Result name parameters {                                                    \
        static const auto function = kaustik::gui::glfwFunction<decltype(&(name))>(#name); \
        return function arguments;                                                         \
    }

KAUSTIK_GLFW(int, glfwInit, (void), ())
KAUSTIK_GLFW(void, glfwTerminate, (void), ())
KAUSTIK_GLFW(void, glfwInitHint, (int hint, int value), (hint, value))
KAUSTIK_GLFW(GLFWerrorfun, glfwSetErrorCallback, (GLFWerrorfun callback), (callback))
KAUSTIK_GLFW(double, glfwGetTime, (void), ())
KAUSTIK_GLFW(void, glfwPollEvents, (void), ())
KAUSTIK_GLFW(void, glfwPostEmptyEvent, (void), ())
KAUSTIK_GLFW(void, glfwWaitEventsTimeout, (double timeout), (timeout))

KAUSTIK_GLFW(GLFWmonitor*, glfwGetPrimaryMonitor, (void), ())
KAUSTIK_GLFW(GLFWmonitor**, glfwGetMonitors, (int* count), (count))
KAUSTIK_GLFW(GLFWmonitorfun, glfwSetMonitorCallback, (GLFWmonitorfun callback), (callback))
KAUSTIK_GLFW(void, glfwGetMonitorPos, (GLFWmonitor * monitor, int* x, int* y), (monitor, x, y))
KAUSTIK_GLFW(void, glfwGetMonitorWorkarea,
             (GLFWmonitor * monitor, int* x, int* y, int* width, int* height),
             (monitor, x, y, width, height))
KAUSTIK_GLFW(void, glfwGetMonitorContentScale, (GLFWmonitor * monitor, float* x, float* y),
             (monitor, x, y))
KAUSTIK_GLFW(const GLFWvidmode*, glfwGetVideoMode, (GLFWmonitor * monitor), (monitor))

KAUSTIK_GLFW(void, glfwDefaultWindowHints, (void), ())
KAUSTIK_GLFW(void, glfwWindowHint, (int hint, int value), (hint, value))
KAUSTIK_GLFW(GLFWwindow*, glfwCreateWindow,
             (int width, int height, const char* title, GLFWmonitor* monitor, GLFWwindow* share),
             (width, height, title, monitor, share))
KAUSTIK_GLFW(void, glfwDestroyWindow, (GLFWwindow * window), (window))
KAUSTIK_GLFW(int, glfwWindowShouldClose, (GLFWwindow * window), (window))
KAUSTIK_GLFW(void, glfwSetWindowShouldClose, (GLFWwindow * window, int value), (window, value))
KAUSTIK_GLFW(void, glfwSetWindowTitle, (GLFWwindow * window, const char* title), (window, title))
KAUSTIK_GLFW(void, glfwGetWindowPos, (GLFWwindow * window, int* x, int* y), (window, x, y))
KAUSTIK_GLFW(void, glfwSetWindowPos, (GLFWwindow * window, int x, int y), (window, x, y))
KAUSTIK_GLFW(void, glfwGetWindowSize, (GLFWwindow * window, int* width, int* height),
             (window, width, height))
KAUSTIK_GLFW(void, glfwSetWindowSize, (GLFWwindow * window, int width, int height),
             (window, width, height))
KAUSTIK_GLFW(void, glfwGetFramebufferSize, (GLFWwindow * window, int* width, int* height),
             (window, width, height))
KAUSTIK_GLFW(void, glfwGetWindowContentScale, (GLFWwindow * window, float* x, float* y),
             (window, x, y))
KAUSTIK_GLFW(void, glfwSetWindowOpacity, (GLFWwindow * window, float opacity), (window, opacity))
KAUSTIK_GLFW(void, glfwShowWindow, (GLFWwindow * window), (window))
KAUSTIK_GLFW(void, glfwHideWindow, (GLFWwindow * window), (window))
KAUSTIK_GLFW(void, glfwFocusWindow, (GLFWwindow * window), (window))
KAUSTIK_GLFW(int, glfwGetWindowAttrib, (GLFWwindow * window, int attribute), (window, attribute))
KAUSTIK_GLFW(void, glfwSetWindowAttrib, (GLFWwindow * window, int attribute, int value),
             (window, attribute, value))
KAUSTIK_GLFW(void, glfwSetWindowUserPointer, (GLFWwindow * window, void* pointer),
             (window, pointer))
KAUSTIK_GLFW(void*, glfwGetWindowUserPointer, (GLFWwindow * window), (window))
KAUSTIK_GLFW(GLFWwindowfocusfun, glfwSetWindowFocusCallback,
             (GLFWwindow * window, GLFWwindowfocusfun callback), (window, callback))
KAUSTIK_GLFW(GLFWwindowclosefun, glfwSetWindowCloseCallback,
             (GLFWwindow * window, GLFWwindowclosefun callback), (window, callback))
KAUSTIK_GLFW(GLFWwindowposfun, glfwSetWindowPosCallback,
             (GLFWwindow * window, GLFWwindowposfun callback), (window, callback))
KAUSTIK_GLFW(GLFWwindowsizefun, glfwSetWindowSizeCallback,
             (GLFWwindow * window, GLFWwindowsizefun callback), (window, callback))

KAUSTIK_GLFW(int, glfwGetInputMode, (GLFWwindow * window, int mode), (window, mode))
KAUSTIK_GLFW(void, glfwSetInputMode, (GLFWwindow * window, int mode, int value),
             (window, mode, value))
KAUSTIK_GLFW(const char*, glfwGetKeyName, (int key, int scancode), (key, scancode))
KAUSTIK_GLFW(int, glfwGetKey, (GLFWwindow * window, int key), (window, key))
KAUSTIK_GLFW(int, glfwGetMouseButton, (GLFWwindow * window, int button), (window, button))
KAUSTIK_GLFW(void, glfwGetCursorPos, (GLFWwindow * window, double* x, double* y), (window, x, y))
KAUSTIK_GLFW(void, glfwSetCursorPos, (GLFWwindow * window, double x, double y), (window, x, y))
KAUSTIK_GLFW(GLFWcursor*, glfwCreateStandardCursor, (int shape), (shape))
KAUSTIK_GLFW(void, glfwDestroyCursor, (GLFWcursor * cursor), (cursor))
KAUSTIK_GLFW(void, glfwSetCursor, (GLFWwindow * window, GLFWcursor* cursor), (window, cursor))
KAUSTIK_GLFW(GLFWkeyfun, glfwSetKeyCallback, (GLFWwindow * window, GLFWkeyfun callback),
             (window, callback))
KAUSTIK_GLFW(GLFWcharfun, glfwSetCharCallback, (GLFWwindow * window, GLFWcharfun callback),
             (window, callback))
KAUSTIK_GLFW(GLFWmousebuttonfun, glfwSetMouseButtonCallback,
             (GLFWwindow * window, GLFWmousebuttonfun callback), (window, callback))
KAUSTIK_GLFW(GLFWcursorposfun, glfwSetCursorPosCallback,
             (GLFWwindow * window, GLFWcursorposfun callback), (window, callback))
KAUSTIK_GLFW(GLFWcursorenterfun, glfwSetCursorEnterCallback,
             (GLFWwindow * window, GLFWcursorenterfun callback), (window, callback))
KAUSTIK_GLFW(GLFWscrollfun, glfwSetScrollCallback, (GLFWwindow * window, GLFWscrollfun callback),
             (window, callback))
KAUSTIK_GLFW(GLFWdropfun, glfwSetDropCallback, (GLFWwindow * window, GLFWdropfun callback),
             (window, callback))
KAUSTIK_GLFW(const float*, glfwGetJoystickAxes, (int joystick, int* count), (joystick, count))
KAUSTIK_GLFW(const unsigned char*, glfwGetJoystickButtons, (int joystick, int* count),
             (joystick, count))
KAUSTIK_GLFW(int, glfwGetGamepadState, (int joystick, GLFWgamepadstate* state), (joystick, state))
KAUSTIK_GLFW(void, glfwSetClipboardString, (GLFWwindow * window, const char* text), (window, text))
KAUSTIK_GLFW(const char*, glfwGetClipboardString, (GLFWwindow * window), (window))

KAUSTIK_GLFW(void, glfwMakeContextCurrent, (GLFWwindow * window), (window))
KAUSTIK_GLFW(void, glfwSwapBuffers, (GLFWwindow * window), (window))
KAUSTIK_GLFW(void, glfwSwapInterval, (int interval), (interval))
