// SPDX-License-Identifier: MIT
// The kinds of failure that come from outside the program. Our own mistakes are asserts; what may
// well happen is a return value. Every message is one or two plain sentences: what, where, what to
// do.
#pragma once

#include <stdexcept>
#include <string>

namespace kaustik {

// Exit codes of the command line, as framework/app/README.md gives them.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitBadRequest = 2;
inline constexpr int kExitDeviceLost = 3;
inline constexpr int kExitImpossible = 4;

class Error : public std::runtime_error {
  public:
    Error(const std::string& message, int exitCode)
        : std::runtime_error(message), exitCode_(exitCode) {}
    [[nodiscard]] int exitCode() const { return exitCode_; }

  private:
    int exitCode_;
};

// A graph that cannot run: stale handles, a required pass disabled, a resource that no pass writes.
class GraphError : public Error {
  public:
    explicit GraphError(const std::string& message) : Error(message, kExitFailed) {}
};

// A shader that does not compile or link; the message has the file and line as written.
class ShaderError : public Error {
  public:
    explicit ShaderError(const std::string& message) : Error(message, kExitFailed) {}
};

// A request that makes no sense: unknown name, value out of range, broken scene file.
class ConfigError : public Error {
  public:
    explicit ConfigError(const std::string& message) : Error(message, kExitBadRequest) {}
};

// A file that is missing, truncated or cannot be written.
class IoError : public Error {
  public:
    explicit IoError(const std::string& message) : Error(message, kExitFailed) {}
};

// A run that is done, and whose result no light can have: energy is not conserved.
class ConservationError : public Error {
  public:
    explicit ConservationError(const std::string& message) : Error(message, kExitImpossible) {}
};

// The device cannot be had (exit 1), is lost or out of memory (exit 3).
class DeviceError : public Error {
  public:
    explicit DeviceError(const std::string& message, int exitCode = kExitDeviceLost)
        : Error(message, exitCode) {}
};

}  // namespace kaustik
