// SPDX-License-Identifier: MIT
// What is asked of a reader process, and how its answer begins.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <type_traits>

namespace kaustik::reading {

enum class RequestKind : std::uint32_t { toml, mesh, gltf, image, foreign, layers };

struct Request {
    RequestKind kind = RequestKind::toml;
    std::string name;            // for messages
    std::filesystem::path file;  // empty when `bytes` is used
    std::string bytes;           // a file that lies in memory
};

template <class R>
requires std::is_same_v<std::remove_const_t<R>, Request>
auto partsOf(R& request) {
    auto& [kind, name, file, bytes] = request;
    return std::tie(kind, name, file, bytes);
}

// What was read follows after `done`, and the message after the others.
enum class Answer : std::uint32_t { done, wrongRequest, damagedFile };

// How a reader process ends by itself.
inline constexpr int kExitNoClient = 0;
inline constexpr int kExitStartedByHand = 2;
inline constexpr int kExitOutOfMemory = 77;

}  // namespace kaustik::reading
