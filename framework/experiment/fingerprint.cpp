// SPDX-License-Identifier: MIT
#include "framework/experiment/fingerprint.h"

#include <fmt/format.h>

#include <cstdint>

namespace kaustik::experiment {

std::string fingerprint(std::string_view bytes) {
    // The offset basis, and the prime 2^88 + 0x13b.
    std::uint64_t high = 0x6c62272e07bb0142u;
    std::uint64_t low = 0x62b821756295c58du;
    constexpr std::uint64_t kPrimeLow = 0x13b;
    for (const char byte : bytes) {
        low ^= static_cast<unsigned char>(byte);
        // What overflows the lower half when it is multiplied, found in two steps of 32 bits.
        const std::uint64_t lowest = (low & 0xffffffffu) * kPrimeLow;
        const std::uint64_t carry = ((low >> 32) * kPrimeLow + (lowest >> 32)) >> 32;
        high = high * kPrimeLow + carry + (low << 24);
        low *= kPrimeLow;
    }
    return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace kaustik::experiment
