// SPDX-License-Identifier: MIT
#include "framework/gl/egl_devices.h"

#include <epoxy/egl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <sstream>

#include "framework/core/error.h"

namespace kaustik::gl {
namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::optional<int> numberIn(const std::string& text) {
    int number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

// CUDA's way to write a UUID, which may end early: "GPU-1a2b".
std::string uuidIn(std::string text) {
    text = lowerCase(text);
    return text.starts_with("gpu-") ? text.substr(4) : text;
}

bool isUuid(const std::string& text) {
    return text.size() >= 4 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
               return std::isxdigit(c) != 0 || c == '-';
           });
}

bool begins(const EglDevice& device, const std::string& uuid) {
    return !device.uuid.empty() && !uuid.empty() && device.uuid.starts_with(uuid);
}

// EGL_EXT_device_persistent_id, which libepoxy does not know yet.
std::string persistentUuid(EGLDeviceEXT device) {
    constexpr EGLint kDeviceUuid = 0x335C;  // EGL_DEVICE_UUID_EXT
    using Query = EGLBoolean (*)(EGLDeviceEXT, EGLint, EGLint, void*, EGLint*);
    const auto query = reinterpret_cast<Query>(eglGetProcAddress("eglQueryDeviceBinaryEXT"));
    std::array<unsigned char, 16> uuid{};
    EGLint size = 0;
    const bool isKnown = query != nullptr &&
                         query(device, kDeviceUuid, static_cast<EGLint>(uuid.size()), uuid.data(),
                               &size) == EGL_TRUE &&
                         size == static_cast<EGLint>(uuid.size());
    return isKnown ? uuidText(uuid) : "";
}

std::string listOf(const std::vector<EglDevice>& devices) {
    std::vector<std::string> names;
    for (const EglDevice& device : devices)
        names.push_back(device.name());
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string uuidText(const std::array<unsigned char, 16>& bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += fmt::format("{:02x}", bytes[i]);
    }
    return text;
}

std::string EglDevice::name() const {
    if (index < 0) return "EGL's default";
    std::string text = fmt::format("device {}", index);
    if (!uuid.empty()) text += fmt::format(" (UUID {})", uuid);
    return text;
}

GivenDevices givenDevices(const Environment& environment) {
    GivenDevices given;
    const char* const text = environment("CUDA_VISIBLE_DEVICES");
    if (text == nullptr) return given;
    given.variable = "CUDA_VISIBLE_DEVICES";
    std::stringstream list(text);
    for (std::string entry; std::getline(list, entry, ',');) {
        std::erase_if(entry, [](unsigned char c) { return std::isspace(c) != 0; });
        const std::optional<int> number = numberIn(entry);
        const bool isDevice = number ? *number >= 0 : lowerCase(entry).starts_with("gpu-");
        // Such as -1 or Slurm's NoDevFiles: no more devices. A share of one (MIG-…) OpenGL has not.
        if (!isDevice) break;
        given.entries.push_back(entry);
    }
    return given;
}

std::optional<bool> isGiven(const EglDevice& device, const GivenDevices& given) {
    if (!given.isExplicit() || device.isSoftware || device.index < 0) return {};
    bool isReported = given.entries.empty() && device.cuda;
    for (const std::string& entry : given.entries) {
        if (const std::optional<int> number = numberIn(entry)) {
            isReported = isReported || device.cuda;
            if (device.cuda == number) return true;
        } else {
            isReported = isReported || !device.uuid.empty();
            if (begins(device, uuidIn(entry))) return true;
        }
    }
    return isReported ? std::optional(false) : std::nullopt;
}

std::vector<EglDevice> inPreferenceOrder(const std::vector<EglDevice>& devices,
                                         const GivenDevices& given) {
    std::vector<EglDevice> processors;
    std::vector<EglDevice> fallbackDevices;
    int notGiven = 0;
    for (const EglDevice& device : devices) {
        if (device.isSoftware) {
            fallbackDevices.push_back(device);
        } else if (isGiven(device, given).value_or(true)) {
            processors.push_back(device);
        } else {
            ++notGiven;
        }
    }
    if (processors.empty() && notGiven > 0 && !given.entries.empty()) {
        throw ConfigError(fmt::format(
            "{}={} gives this job no device that EGL lists ({}); name one with --device, or unset "
            "the variable.",
            given.variable, fmt::join(given.entries, ","), listOf(devices)));
    }
    // One of which it is known that it was given stands before one of which nothing is.
    std::stable_partition(processors.begin(), processors.end(), [&](const EglDevice& device) {
        return isGiven(device, given).value_or(false);
    });
    processors.push_back({});
    processors.insert(processors.end(), fallbackDevices.begin(), fallbackDevices.end());
    return processors;
}

void requireGiven(const EglDevice& device, const GivenDevices& given) {
    if (isGiven(device, given).value_or(true)) return;
    throw ConfigError(fmt::format(
        "--device: {} is not among those that this job was given ({}={}); name one of them.",
        device.name(), given.variable, fmt::join(given.entries, ",")));
}

std::vector<EglDevice> matchingDevices(const std::vector<EglDevice>& devices,
                                       const std::string& wanted, const GivenDevices& given) {
    std::vector<EglDevice> found;
    if (const std::optional<int> number = numberIn(wanted)) {
        const auto device = std::find_if(devices.begin(), devices.end(),
                                         [&](const auto& d) { return d.index == *number; });
        if (device == devices.end()) {
            throw ConfigError(
                fmt::format("--device: there is no device {}; 'kaustik check' lists "
                            "them ({}).",
                            wanted, listOf(devices)));
        }
        found.push_back(*device);
    } else if (const std::string uuid = uuidIn(wanted); isUuid(uuid)) {
        std::copy_if(devices.begin(), devices.end(), std::back_inserter(found),
                     [&](const EglDevice& device) { return begins(device, uuid); });
    }
    for (const EglDevice& device : found)
        requireGiven(device, given);
    return found;
}

std::vector<EglDevice> listEglDevices() {
    std::vector<EglDevice> devices;
    const char* text = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const std::string extensions = text != nullptr ? text : "";
    if (extensions.find("EGL_EXT_platform_device") == std::string::npos ||
        extensions.find("EGL_EXT_device_enumeration") == std::string::npos) {
        return devices;
    }
    std::array<EGLDeviceEXT, 64> handles{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(handles.size()), handles.data(), &count);
    const bool canAsk = extensions.find("EGL_EXT_device_query") != std::string::npos;
    for (EGLint i = 0; i < count; ++i) {
        EglDevice device;
        device.index = i;
        device.handle = handles[static_cast<std::size_t>(i)];
        const char* own = canAsk ? eglQueryDeviceStringEXT(device.handle, EGL_EXTENSIONS) : nullptr;
        const std::string has = own != nullptr ? own : "";
        device.isSoftware = has.find("EGL_MESA_device_software") != std::string::npos;
        EGLAttrib cuda = -1;
        if (has.find("EGL_NV_device_cuda") != std::string::npos &&
            eglQueryDeviceAttribEXT(device.handle, EGL_CUDA_DEVICE_NV, &cuda) == EGL_TRUE) {
            device.cuda = static_cast<int>(cuda);
        }
        if (has.find("EGL_EXT_device_drm") != std::string::npos) {
            const char* node = eglQueryDeviceStringEXT(device.handle, EGL_DRM_DEVICE_FILE_EXT);
            if (node != nullptr) device.node = node;
        }
        if (has.find("EGL_EXT_device_persistent_id") != std::string::npos)
            device.uuid = persistentUuid(device.handle);
        devices.push_back(std::move(device));
    }
    return devices;
}

}  // namespace kaustik::gl
