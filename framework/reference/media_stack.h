// SPDX-License-Identifier: MIT
// The dielectrics around a photon of the reference, as deep as any stack of the device
// (transport/media_stack.h). Of two that overlap, the one entered last fills what they share;
// either may be left before the other.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace kaustik::reference {

class MediaStack {
  public:
    // Material index + 1, 0 for vacuum.
    [[nodiscard]] std::uint32_t inner() const { return size_ > 0 ? media_[size_ - 1] : 0; }
    // What is around once the innermost is left.
    [[nodiscard]] std::uint32_t outer() const { return size_ > 1 ? media_[size_ - 2] : 0; }
    [[nodiscard]] bool holds(std::uint32_t medium) const {
        return std::find(media_.begin(), end(), medium) != end();
    }
    [[nodiscard]] bool isFull() const { return size_ == media_.size(); }
    void enter(std::uint32_t medium) {
        if (!isFull()) media_[size_++] = static_cast<std::uint16_t>(medium);
    }
    // The innermost that is this one, which need not be the innermost of all.
    void leave(std::uint32_t medium) {
        for (std::uint16_t i = size_; i-- > 0;) {
            if (media_[i] != medium) continue;
            std::move(media_.begin() + i + 1, media_.begin() + size_, media_.begin() + i);
            --size_;
            return;
        }
    }

  private:
    using Media = std::array<std::uint16_t, 23>;
    [[nodiscard]] Media::const_iterator end() const { return media_.begin() + size_; }
    Media media_{};  // the innermost last
    std::uint16_t size_ = 0;
};

}  // namespace kaustik::reference
