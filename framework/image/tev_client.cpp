// SPDX-License-Identifier: MIT
#include "framework/image/tev_client.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "framework/core/error.h"

namespace kaustik {
namespace {

static_assert(std::endian::native == std::endian::little, "tev's messages are little-endian");

constexpr char kCreateImage = 4;
constexpr char kUpdateImage = 6;  // V3: several channels of one array
constexpr const char* kPort = "14158";

class Message {
  public:
    explicit Message(char kind) { bytes_ = std::string(sizeof(std::uint32_t), '\0') + kind; }

    template <class Number>
    Message& add(Number number) {
        char bytes[sizeof(Number)];
        std::memcpy(bytes, &number, sizeof(Number));
        bytes_.append(bytes, sizeof(Number));
        return *this;
    }
    Message& add(const std::string& text) {
        bytes_.append(text.c_str(), text.size() + 1);
        return *this;
    }
    Message& add(const float* values, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(float));
        return *this;
    }
    // With its length in front, which counts itself.
    [[nodiscard]] const std::string& finished() {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof(length));
        return bytes_;
    }

  private:
    std::string bytes_;
};

std::vector<std::string> channelNames(int channels) {
    if (channels == 1) return {"Y"};
    const std::vector<std::string> names = {"R", "G", "B", "A"};
    return {names.begin(), names.begin() + std::min(channels, 4)};
}

}  // namespace

TevClient::TevClient(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    std::string host = address.substr(0, colon);
    std::string port = colon == std::string::npos ? kPort : address.substr(colon + 1);
    if (host.empty()) host = "127.0.0.1";
    address_ = fmt::format("{}:{}", host, port);
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (const int problem = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found)) {
        throw ConfigError(fmt::format("--tev: '{}' is no address ({}); it is HOST:PORT.", address_,
                                      gai_strerror(problem)));
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owned(found, &freeaddrinfo);
    int lastError = 0;
    for (const addrinfo* place = found; place != nullptr; place = place->ai_next) {
        socket_ = ::socket(place->ai_family, place->ai_socktype | SOCK_CLOEXEC, 0);
        if (socket_ < 0) continue;
        if (::connect(socket_, place->ai_addr, place->ai_addrlen) == 0) return;
        lastError = errno;
        ::close(socket_);
        socket_ = -1;
    }
    throw IoError(fmt::format("--tev: no viewer answers at {} ({}); start tev first.", address_,
                              std::strerror(lastError)));
}

TevClient::~TevClient() {
    if (socket_ >= 0) ::close(socket_);
}

void TevClient::send(const std::string& message) {
    for (std::size_t sent = 0; sent < message.size();) {
        const ssize_t more =
            ::send(socket_, message.data() + sent, message.size() - sent, MSG_NOSIGNAL);
        if (more < 0 && errno == EINTR) continue;
        if (more <= 0) {
            throw IoError(fmt::format("--tev: the connection to {} was lost ({}).", address_,
                                      std::strerror(errno)));
        }
        sent += static_cast<std::size_t>(more);
    }
}

void TevClient::show(const std::string& name, const Image& image) {
    const std::vector<std::string> names = channelNames(image.channels);
    const auto channels = static_cast<std::int32_t>(names.size());
    constexpr char kKeepsFocus = 0;
    Message create(kCreateImage);
    create.add(kKeepsFocus).add(name).add<std::int32_t>(image.width);
    create.add<std::int32_t>(image.height).add(channels);
    for (const std::string& channel : names)
        create.add(channel);
    send(create.finished());

    // In bands, so that a message stays below the 32 bits of its length.
    constexpr int kBand = 64;
    for (int y = 0; y < image.height; y += kBand) {
        const int rows = std::min(kBand, image.height - y);
        Message update(kUpdateImage);
        update.add(kKeepsFocus).add(name).add(channels);
        for (const std::string& channel : names)
            update.add(channel);
        update.add<std::int32_t>(0).add<std::int32_t>(y);
        update.add<std::int32_t>(image.width).add<std::int32_t>(rows);
        for (std::int64_t c = 0; c < channels; ++c)
            update.add(c);  // where the channel begins
        for (std::int64_t c = 0; c < channels; ++c)
            update.add<std::int64_t>(image.channels);  // from pixel to pixel
        const std::size_t row =
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
        update.add(image.values.data() + static_cast<std::size_t>(y) * row,
                   static_cast<std::size_t>(rows) * row);
        send(update.finished());
    }
}

}  // namespace kaustik
