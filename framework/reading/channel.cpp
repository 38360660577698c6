// SPDX-License-Identifier: MIT
#include "framework/reading/channel.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace kaustik::reading {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

}  // namespace

Channel::~Channel() {
    ::close(socket_);
}

void Channel::limit(std::optional<Clock::time_point> deadline, std::uint64_t maxBytes) {
    deadline_ = deadline;
    maxBytes_ = maxBytes;
    received_ = 0;
}

// Until something can be written or read; a closed socket can be read, to its end.
void Channel::wait(short event) {
    for (;;) {
        int milliseconds = -1;
        if (deadline_) {
            const auto left =
                std::chrono::ceil<std::chrono::milliseconds>(*deadline_ - Clock::now()).count();
            if (left <= 0) throw ChannelEnd::late;
            milliseconds = static_cast<int>(std::min<long long>(left, 1000));
        }
        pollfd watched{socket_, event, 0};
        if (::poll(&watched, 1, milliseconds) > 0) return;
    }
}

void Channel::write(const char* bytes, std::size_t count) {
    while (count > 0) {
        wait(POLLOUT);
        // No signal when the other side is gone; and what cannot be taken at once is waited for
        // above, where the deadline is known.
        const ssize_t written = ::send(socket_, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (written < 0) {
            if (errno == EINTR || errno == EAGAIN) continue;
            throw ChannelEnd::closed;
        }
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
}

std::size_t Channel::read(char* bytes, std::size_t count) {
    for (;;) {
        wait(POLLIN);
        const ssize_t found = ::recv(socket_, bytes, count, MSG_DONTWAIT);
        if (found > 0) {
            received_ += static_cast<std::uint64_t>(found);
            if (received_ > maxBytes_) throw ChannelEnd::tooMuch;
            return static_cast<std::size_t>(found);
        }
        if (found < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        throw ChannelEnd::closed;
    }
}

void Channel::send(const void* bytes, std::size_t count) {
    if (outgoing_.size() + count > kBufferBytes) flush();
    if (count > kBufferBytes) {
        write(static_cast<const char*>(bytes), count);
    } else {
        outgoing_.append(static_cast<const char*>(bytes), count);
    }
}

void Channel::flush() {
    write(outgoing_.data(), outgoing_.size());
    outgoing_.clear();
}

void Channel::receive(void* bytes, std::size_t count) {
    char* target = static_cast<char*>(bytes);
    while (count > 0) {
        const std::size_t held = std::min(count, incoming_.size() - taken_);
        if (held > 0) {
            std::memcpy(target, incoming_.data() + taken_, held);
            taken_ += held;
            target += held;
            count -= held;
        } else if (count >= kBufferBytes) {
            const std::size_t found = read(target, count);
            target += found;
            count -= found;
        } else {
            incoming_.resize(kBufferBytes);
            taken_ = 0;
            std::size_t found = 0;
            try {
                found = read(incoming_.data(), incoming_.size());
            } catch (...) {
                incoming_.clear();
                throw;
            }
            incoming_.resize(found);
        }
    }
}

bool Channel::waitForBytes() {
    if (taken_ < incoming_.size()) return true;
    try {
        wait(POLLIN);
        char byte = 0;
        return ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 1;
    } catch (const ChannelEnd&) {
        return false;
    }
}

}  // namespace kaustik::reading
