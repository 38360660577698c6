// SPDX-License-Identifier: MIT
// Random numbers that depend on nothing but a key and how many were drawn: the same for a photon on
// any thread and in any order. SplitMix64 (Steele, Lea and Flood 2014), its start hashed from
// (seed, stream, index).
#pragma once

#include <cstdint>

namespace kaustik::reference {

class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t index)
        : state_(mix(mix(mix(seed + kStep) + stream * kStep) + index * kStep)) {}

    [[nodiscard]] std::uint64_t bits() {
        state_ += kStep;
        return mix(state_);
    }
    // Uniform in [0, 1), all 53 bits.
    [[nodiscard]] double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

  private:
    static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
    static constexpr std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

}  // namespace kaustik::reference
