// SPDX-License-Identifier: MIT
// --tev: what a viewer is sent, read back by the words of tev's protocol (its src/Ipc.cpp).
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <map>
#include <stdexcept>
#include <thread>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

// Listens on a port of its own, takes one connection, and keeps all that arrives on it.
class Viewer {
  public:
    Viewer() {
        listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        auto* const address = reinterpret_cast<sockaddr*>(&place);
        socklen_t length = sizeof(place);
        if (::bind(listener_, address, length) != 0 || ::listen(listener_, 1) != 0 ||
            ::getsockname(listener_, address, &length) != 0) {
            throw std::runtime_error("no port to listen on");
        }
        port_ = ntohs(place.sin_port);
    }
    ~Viewer() { ::close(listener_); }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    [[nodiscard]] std::string address() const { return "localhost:" + std::to_string(port_); }

    // Ends receive() where nobody has connected.
    void wakeUp() const { ::shutdown(listener_, SHUT_RDWR); }

    // Until whoever has connected goes.
    [[nodiscard]] std::string receive() const {
        const int connection = ::accept(listener_, nullptr, nullptr);
        std::string bytes;
        char block[65536];
        for (ssize_t count = 0; (count = ::read(connection, block, sizeof(block))) > 0;)
            bytes.append(block, static_cast<std::size_t>(count));
        ::close(connection);
        return bytes;
    }

  private:
    int listener_ = -1;
    int port_ = 0;
};

// Reads what a message says, in order; throws std::out_of_range beyond its end.
class Reader {
  public:
    explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
    template <class Number>
    Number number() {
        Number value{};
        std::memcpy(&value, take(sizeof(Number)).data(), sizeof(Number));
        return value;
    }
    std::string text() {
        const std::size_t end = bytes_.find('\0', at_);
        const std::string value = take(end - at_);
        take(1);
        return value;
    }
    std::string take(std::size_t count) {
        if (at_ + count > bytes_.size()) throw std::out_of_range("beyond the end of a message");
        const std::string part = bytes_.substr(at_, count);
        at_ += count;
        return part;
    }
    [[nodiscard]] bool isAtEnd() const { return at_ == bytes_.size(); }

  private:
    std::string bytes_;
    std::size_t at_ = 0;
};

void readUpdate(Reader& message, Image& image) {
    const auto channels = message.number<std::int32_t>();
    ASSERT_EQ(channels, image.channels);
    for (std::int32_t c = 0; c < channels; ++c)
        message.text();
    const auto x = message.number<std::int32_t>();
    const auto y = message.number<std::int32_t>();
    const auto width = message.number<std::int32_t>();
    const auto height = message.number<std::int32_t>();
    std::vector<std::int64_t> offsets;
    std::vector<std::int64_t> strides;
    for (std::int32_t c = 0; c < channels; ++c)
        offsets.push_back(message.number<std::int64_t>());
    for (std::int32_t c = 0; c < channels; ++c)
        strides.push_back(message.number<std::int64_t>());
    std::vector<float> values;
    while (!message.isAtEnd())
        values.push_back(message.number<float>());
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            for (int c = 0; c < channels; ++c) {
                const auto channel = static_cast<std::size_t>(c);
                image.at(x + column, y + row, c) = values.at(static_cast<std::size_t>(
                    offsets[channel] + (row * width + column) * strides[channel]));
            }
        }
    }
}

// What a viewer would show, by name.
std::map<std::string, Image> imagesIn(const std::string& bytes) {
    std::map<std::string, Image> images;
    Reader stream(bytes);
    while (!stream.isAtEnd()) {
        const auto length = stream.number<std::uint32_t>();
        Reader message(stream.take(length - sizeof(length)));
        const char kind = message.number<char>();
        EXPECT_EQ(message.number<char>(), 0) << "whose window it is stays as it is";
        const std::string name = message.text();
        if (kind == 4) {
            const auto width = message.number<std::int32_t>();
            const auto height = message.number<std::int32_t>();
            images[name] = Image(width, height, message.number<std::int32_t>());
        } else {
            EXPECT_EQ(kind, 6);
            readUpdate(message, images.at(name));
        }
    }
    return images;
}

class Tev : public CommandLine {};

TEST_F(Tev, IsSentThePicturesThatAreWritten) {
    const Viewer viewer;
    std::string received;
    std::thread receiving([&] { received = viewer.receive(); });
    // More rows than one message has.
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    const Outcome outcome = run({"run", "wavy.toml", "--size", "40x150", "--frames", "1", "--set",
                                 "photons=32x32", "--out", "out", "--tev", viewer.address()});
    if (outcome.exitCode != 0) viewer.wakeUp();
    receiving.join();
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::map<std::string, Image> images = imagesIn(received);
    ASSERT_EQ(images.count("wavy/caustic"), 1u);
    ASSERT_EQ(images.count("wavy/beauty"), 1u);
    const Image written = readImage(folder / ("out/caustic" + floatImageExtension()));
    EXPECT_EQ(images.at("wavy/caustic").height, 150);
    EXPECT_EQ(images.at("wavy/caustic").values, written.values);
}

TEST_F(Tev, ThatIsNotThereIsOneMessageBeforeTheWork) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    expectFailure(run(smallRun("wavy.toml", {"--tev", "127.0.0.1:1", "--out", "out"})), 1,
                  {"--tev: no viewer answers at 127.0.0.1:1", "start tev first"});
    expectFailure(run(smallRun("wavy.toml", {"--tev", "localhost:port", "--out", "out"})), 2,
                  {"--tev: 'localhost:port' is no address", "HOST:PORT"});
}

}  // namespace
}  // namespace kaustik::test
