// SPDX-License-Identifier: MIT
// Whether loops whose word the processor did not wait for had come to their end. Their words are
// copied aside as the frame goes, and read once the device is done with it, without a wait: a fence
// a frame says so, in a ring of as many frames as the timers have.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "framework/gl/objects.h"

namespace kaustik::gl {

class LoopWords {
  public:
    LoopWords() = default;
    ~LoopWords();
    LoopWords(const LoopWords&) = delete;
    LoopWords& operator=(const LoopWords&) = delete;

    // Copies a word aside. What writes it must have been waited for (Use::updateBuffer).
    void copy(const Buffer& from, std::size_t word);
    // The frame at hand has no more of them.
    void endFrame();

    // Frames with a loop that had not come to its end, since the last call, as far as the device
    // has got; with `waits`, all of them.
    [[nodiscard]] std::size_t takeCutShort(bool waits = false);

  private:
    static constexpr std::size_t kFramesInFlight = 4;
    struct Slot {
        Object<detail::deleteBuffer> buffer;
        std::size_t capacity = 0;              // words
        const std::uint32_t* words = nullptr;  // of the buffer
        std::size_t count = 0;
        GLsync fence = nullptr;  // while the device may not be done
    };
    void read(Slot& slot, bool waits);
    static void enlarge(Slot& slot);

    std::array<Slot, kFramesInFlight> ring_;
    std::size_t frame_ = 0;
    std::size_t cutShort_ = 0;
};

}  // namespace kaustik::gl
