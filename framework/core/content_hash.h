// SPDX-License-Identifier: MIT
// A 128-bit fingerprint of data, to name results by what they depend on and to notice damage. Not
// made to withstand an attacker.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace kaustik {

class ContentHash {
  public:
    ContentHash& addBytes(std::string_view bytes);  // with its length
    // Numbers and structs of numbers without padding.
    template <class T>
    requires std::is_trivially_copyable_v<T> ContentHash& add(const T& value) {
        return addBytes({reinterpret_cast<const char*>(&value), sizeof(T)});
    }
    template <class T>
    requires std::is_trivially_copyable_v<T> ContentHash& addAll(const std::vector<T>& values) {
        return addBytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
    }
    // 32 hexadecimal digits.
    [[nodiscard]] std::string hex() const;

  private:
    void addWord(std::uint64_t word);
    std::uint64_t a_ = 0x6a09e667f3bcc908u;
    std::uint64_t b_ = 0xbb67ae8584caa73bu;
};

}  // namespace kaustik
