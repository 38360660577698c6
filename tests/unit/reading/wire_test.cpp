// SPDX-License-Identifier: MIT
// What is put on one end of a channel is taken from the other.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <limits>
#include <thread>

#include "framework/reading/wire.h"

namespace kaustik::reading {
namespace {

struct Inner {
    std::string name;
    std::optional<double> number;
    friend bool operator==(const Inner&, const Inner&) = default;
};
auto partsOf(auto& inner) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(inner)>>, Inner> {
    auto& [name, number] = inner;
    return std::tie(name, number);
}

struct Pipe {
    Pipe() {
        std::array<int, 2> sockets{};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets.data()), 0);
        from.emplace(sockets[0]);
        to.emplace(sockets[1]);
    }
    std::optional<Channel> from;
    std::optional<Channel> to;
};

template <class T>
T travelled(const T& value) {
    Pipe pipe;
    std::thread sender([&] {
        put(*pipe.from, value);
        pipe.from->flush();
    });
    T arrived{};
    take(*pipe.to, arrived);
    sender.join();
    return arrived;
}

TEST(Wire, CarriesEveryKindOfValueUnchanged) {
    using Variant = std::variant<std::string, std::int64_t, Inner>;
    EXPECT_EQ(travelled(std::string("a\0b", 3)), std::string("a\0b", 3));
    EXPECT_EQ(travelled(std::filesystem::path("a/\xff.ply")), "a/\xff.ply");
    EXPECT_EQ(travelled(std::numeric_limits<double>::denorm_min()),
              std::numeric_limits<double>::denorm_min());
    const std::vector<Inner> list = {{"one", 1.0}, {"", {}}, {"three", -0.5}};
    EXPECT_EQ(travelled(list), list);
    EXPECT_EQ(travelled(Variant(Inner{"x", 2.0})), Variant(Inner{"x", 2.0}));
    EXPECT_EQ(travelled(Variant(std::int64_t{-3})), Variant(std::int64_t{-3}));
}

TEST(Wire, CarriesMoreThanAnyBufferHolds) {
    std::vector<float> many(5'000'001);
    for (std::size_t i = 0; i < many.size(); ++i)
        many[i] = static_cast<float>(i);
    EXPECT_EQ(travelled(many), many);
}

TEST(Wire, TakesNoMoreMemoryThanHasCome) {
    // The length of a list that no machine could hold, and then the end.
    Pipe pipe;
    put(*pipe.from, UINT64_MAX / 8);
    pipe.from->flush();
    pipe.from.reset();
    std::vector<double> list;
    EXPECT_THROW(take(*pipe.to, list), ChannelEnd);
    EXPECT_LE(list.capacity() * sizeof(double), std::size_t{16} << 20);
}

TEST(Wire, RefusesAnAlternativeThatDoesNotExist) {
    Pipe pipe;
    put(*pipe.from, std::uint64_t{7});
    pipe.from->flush();
    std::variant<int, std::string> value;
    EXPECT_THROW(take(*pipe.to, value), ChannelEnd);
}

TEST(Wire, WaitsNoLongerThanTheDeadline) {
    Pipe pipe;
    pipe.to->limit(Channel::Clock::now() + std::chrono::milliseconds(20), UINT64_MAX);
    int value = 0;
    try {
        take(*pipe.to, value);
        FAIL() << "nothing was sent";
    } catch (const ChannelEnd& end) {
        EXPECT_EQ(end, ChannelEnd::late);
    }
}

}  // namespace
}  // namespace kaustik::reading
