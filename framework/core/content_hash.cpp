// SPDX-License-Identifier: MIT
#include "framework/core/content_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace kaustik {
namespace {

// The finishing step of MurmurHash3.
std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 33)) * 0xff51afd7ed558ccdu;
    z = (z ^ (z >> 33)) * 0xc4ceb9fe1a85ec53u;
    return z ^ (z >> 33);
}

}  // namespace

// Two lanes that mix each word differently and then each other.
void ContentHash::addWord(std::uint64_t word) {
    a_ = mix(a_ ^ word) + b_;
    b_ = std::rotl(b_, 29) ^ mix(word * 0x9e3779b97f4a7c15u + a_);
}

ContentHash& ContentHash::addBytes(std::string_view bytes) {
    addWord(bytes.size());
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t count = std::min(bytes.size(), sizeof word);
        std::memcpy(&word, bytes.data(), count);
        addWord(word);
        bytes.remove_prefix(count);
    }
    return *this;
}

std::string ContentHash::hex() const {
    return fmt::format("{:016x}{:016x}", mix(a_ + b_), mix(b_ ^ std::rotl(a_, 17)));
}

}  // namespace kaustik
