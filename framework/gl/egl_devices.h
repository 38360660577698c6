// SPDX-License-Identifier: MIT
// The devices that EGL lists, and which of them a context is to be made on: the one that was asked
// for, else one that the job was given (CUDA_VISIBLE_DEVICES, which EGL itself takes no notice of;
// Slurm sets it), a graphics processor before one that only stands in for it.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace kaustik::gl {

// What EGL says of a device before there is a context on it.
struct EglDevice {
    int index = -1;           // among those that EGL lists: N of --device N; -1: its default
    std::string uuid;         // "8-4-4-4-12" hexadecimal digits, or "" where it does not say
    std::optional<int> cuda;  // number among CUDA's devices, of all that the machine has
    std::string node;         // such as /dev/dri/card0, or ""
    bool isSoftware = false;  // renders on the processor
    void* handle = nullptr;   // EGLDeviceEXT
    [[nodiscard]] std::string name() const;  // "device 0 (UUID …)"
};

// What the job was given, from the environment.
struct GivenDevices {
    std::string variable;              // which says so; "" where nothing does
    std::vector<std::string> entries;  // CUDA's numbers, or UUIDs or their beginnings
    [[nodiscard]] bool isExplicit() const { return !variable.empty(); }
};

using Environment = std::function<const char*(const char* name)>;

// Reads CUDA_VISIBLE_DEVICES as CUDA does: what follows a wrong entry counts for nothing.
[[nodiscard]] GivenDevices givenDevices(const Environment& environment);

// Whether the job was given the device; nothing where that cannot be told, as of another vendor's.
[[nodiscard]] std::optional<bool> isGiven(const EglDevice& device, const GivenDevices& given);

// The devices to try to make a context on, the best first. EGL's default (index -1) stands before
// devices that render on the processor. Throws ConfigError where the environment gives only devices
// that EGL does not list, though it could tell them.
[[nodiscard]] std::vector<EglDevice> inPreferenceOrder(const std::vector<EglDevice>& devices,
                                                       const GivenDevices& given);

// The devices that `wanted` may mean: by number, or by a UUID or its beginning. There is none where
// it must be the name of a renderer, which only a context tells. Throws ConfigError for a number
// that there is not and for a device that the job was not given.
[[nodiscard]] std::vector<EglDevice> matchingDevices(const std::vector<EglDevice>& devices,
                                                     const std::string& wanted,
                                                     const GivenDevices& given);

// Throws ConfigError for a device that the job was not given.
void requireGiven(const EglDevice& device, const GivenDevices& given);

[[nodiscard]] std::string uuidText(const std::array<unsigned char, 16>& bytes);

// All that EGL lists; none where it cannot. EGL must be there.
[[nodiscard]] std::vector<EglDevice> listEglDevices();

}  // namespace kaustik::gl
