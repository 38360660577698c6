// SPDX-License-Identifier: MIT
// Bytes between the program and its reader process: a stream socket with a buffer on either side.
// What comes is never believed to be as long as it says before it is there.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace kaustik::reading {

// The other side is gone, or has not answered in time, or says more than it may.
enum class ChannelEnd { closed, late, tooMuch };

class Channel {
  public:
    using Clock = std::chrono::steady_clock;

    // Takes the socket over.
    explicit Channel(int socket) : socket_(socket) {}
    ~Channel();
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    // Sets limits that hold from now on: nothing is waited for beyond `deadline`, and no more than
    // `maxBytes` are taken.
    void limit(std::optional<Clock::time_point> deadline, std::uint64_t maxBytes);

    // All of these throw ChannelEnd.
    void send(const void* bytes, std::size_t count);
    void flush();
    void receive(void* bytes, std::size_t count);
    // False when the other side has closed or the time is up before a first byte came.
    [[nodiscard]] bool waitForBytes();

    // Bytes that have come since the limits were set.
    [[nodiscard]] std::uint64_t received() const { return received_; }

  private:
    void write(const char* bytes, std::size_t count);
    std::size_t read(char* bytes, std::size_t count);
    void wait(short event);

    int socket_;
    std::optional<Clock::time_point> deadline_;
    std::uint64_t maxBytes_ = UINT64_MAX;
    std::uint64_t received_ = 0;
    std::string outgoing_;
    std::string incoming_;
    std::size_t taken_ = 0;  // of incoming_
};

}  // namespace kaustik::reading
