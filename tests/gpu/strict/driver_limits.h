// SPDX-License-Identifier: MIT
// How much drivers give of what OpenGL promises little of.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <string>
#include <vector>

namespace kaustik::test {

// A row of the table in driver_limits.cpp, named as OpenGL names it, without GL_.
struct DriverLimit {
    std::string name;
    GLenum query = 0;
    int promised = 0;  // the least that OpenGL 4.5 allows
    // What NVIDIA's, AMD's, Intel's and Mesa's software driver give; kUnknown where no source says.
    std::array<int, 4> given{};
    std::string sources;  // of what is given
    int axis = -1;        // x, y or z of what is given for each

    static constexpr int kUnknown = -1;
    // What every program has to do with: the least of the four, a driver of which nothing is known
    // giving what is promised.
    [[nodiscard]] int least() const;
};

[[nodiscard]] const std::vector<DriverLimit>& driverLimits();
// By its name and axis, which must be there.
[[nodiscard]] const DriverLimit& driverLimit(const std::string& name, int axis = -1);

}  // namespace kaustik::test
