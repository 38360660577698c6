// SPDX-License-Identifier: MIT
// Little-endian values out of bytes, for binary formats: what is not there is an error, and no
// memory is taken for a count before the bytes that it counts are known to be there.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "framework/core/error.h"

namespace kaustik::scene {

class ByteReader {
  public:
    ByteReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    template <class T>
    T value() {
        static_assert(std::is_trivially_copyable_v<T>);
        require(1, sizeof(T));
        T result{};
        std::memcpy(&result, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return result;
    }

    template <class T>
    std::vector<T> values(std::uint64_t count) {
        require(count, sizeof(T));
        std::vector<T> result(static_cast<std::size_t>(count));
        if (count > 0) std::memcpy(result.data(), bytes_.data() + at_, result.size() * sizeof(T));
        at_ += result.size() * sizeof(T);
        return result;
    }

    // Up to a zero byte, which is skipped.
    std::string text() {
        const std::size_t end = bytes_.find('\0', at_);
        if (end == std::string_view::npos) fail();
        std::string result(bytes_.substr(at_, end - at_));
        at_ = end + 1;
        return result;
    }

  private:
    void require(std::uint64_t count, std::size_t size) const {
        if (count > (bytes_.size() - at_) / size) fail();
    }
    [[noreturn]] void fail() const {
        throw IoError(fmt::format("{} is cut off or damaged. Export it again.", name_));
    }

    std::string_view bytes_;
    const std::string& name_;
    std::size_t at_ = 0;
};

}  // namespace kaustik::scene
