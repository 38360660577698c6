// SPDX-License-Identifier: MIT
// What a frame must cost at least on a device of which no more is known than how fast its memory
// is: what each pass reads and writes (gl::AccessCounter), over that bandwidth.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/gl/access_counter.h"

namespace kaustik::report {

struct DeviceModel {
    double bytesPerSecond = 0.0;
};

// "1000GB/s", "4.8 TB/s", a gigabyte being 10⁹ bytes. Throws ConfigError that names `option`.
[[nodiscard]] DeviceModel parseDeviceModel(const std::string& text, const std::string& option);

// Milliseconds that moving what a pass reads and writes takes at least.
[[nodiscard]] double boundMilliseconds(const gl::PassAccesses& pass, const DeviceModel& model);

// The passes of a frame and their bounds.
struct FrameCost {
    DeviceModel model;
    std::vector<gl::PassAccesses> passes;
};
[[nodiscard]] double boundMilliseconds(const FrameCost& cost);

// By pass and in all: bytes, atomics, work groups, barriers, the bound, and, where `measured` has a
// pass, how many times as long that took. `measured`: by name, ms.
[[nodiscard]] std::string costTable(const FrameCost& cost,
                                    const std::map<std::string, double>& measured = {});

// `cost` of the report; and its schema.
[[nodiscard]] nlohmann::json costJson(const FrameCost& cost,
                                      const std::map<std::string, double>& measured = {});
[[nodiscard]] nlohmann::json costSchema();

}  // namespace kaustik::report
