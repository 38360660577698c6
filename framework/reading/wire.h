// SPDX-License-Identifier: MIT
// Values as bytes on a channel, for two processes of one build on one machine. A struct travels
// through `partsOf`, found next to it, which ties all of its members: written with a structured
// binding, it no longer compiles when a member is added and forgotten there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "framework/reading/channel.h"

namespace kaustik::reading {

template <class T>
concept HasParts = requires(T& value) {
    partsOf(value);
};

// Sent as it lies in memory.
template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !HasParts<T>;

template <class T>
void put(Channel& channel, const T& value);
template <class T>
void take(Channel& channel, T& value);

namespace detail {

// Bytes are taken in pieces of this size, so that a length that lies costs no more memory than what
// follows it.
inline constexpr std::size_t kPieceBytes = std::size_t{1} << 22;

template <class List>
void putList(Channel& channel, const List& list) {
    put(channel, static_cast<std::uint64_t>(list.size()));
    using Element = typename List::value_type;
    if constexpr (Plain<Element>) {
        channel.send(list.data(), list.size() * sizeof(Element));
    } else {
        for (const Element& element : list)
            put(channel, element);
    }
}

template <class List>
void takeList(Channel& channel, List& list) {
    std::uint64_t left = 0;
    take(channel, left);
    list.clear();
    using Element = typename List::value_type;
    if constexpr (Plain<Element>) {
        while (left > 0) {
            const std::size_t piece = std::min<std::uint64_t>(
                left, std::max<std::size_t>(1, kPieceBytes / sizeof(Element)));
            const std::size_t first = list.size();
            list.resize(first + piece);
            channel.receive(list.data() + first, piece * sizeof(Element));
            left -= piece;
        }
    } else {
        for (; left > 0; --left)
            take(channel, list.emplace_back());
    }
}

template <class T>
inline constexpr bool isVector = false;
template <class T>
inline constexpr bool isVector<std::vector<T>> = true;
template <class T>
inline constexpr bool isOptional = false;
template <class T>
inline constexpr bool isOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool isVariant = false;
template <class... T>
inline constexpr bool isVariant<std::variant<T...>> = true;

// Takes the alternative of a variant that has the number `wanted`.
template <class Variant, std::size_t index = 0>
void takeAlternative(Channel& channel, Variant& value, std::size_t wanted) {
    if constexpr (index < std::variant_size_v<Variant>) {
        if (index == wanted) return take(channel, value.template emplace<index>());
        takeAlternative<Variant, index + 1>(channel, value, wanted);
    } else {
        throw ChannelEnd::closed;  // no reader of this build says that
    }
}

}  // namespace detail

template <class T>
void put(Channel& channel, const T& value) {
    if constexpr (std::is_same_v<T, std::string> || detail::isVector<T>) {
        detail::putList(channel, value);
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
        detail::putList(channel, value.native());
    } else if constexpr (detail::isOptional<T>) {
        put(channel, value.has_value());
        if (value) put(channel, *value);
    } else if constexpr (detail::isVariant<T>) {
        put(channel, static_cast<std::uint64_t>(value.index()));
        std::visit([&](const auto& alternative) { put(channel, alternative); }, value);
    } else if constexpr (HasParts<const T>) {
        std::apply([&](const auto&... part) { (put(channel, part), ...); }, partsOf(value));
    } else {
        static_assert(Plain<T>);
        channel.send(&value, sizeof(T));
    }
}

template <class T>
void take(Channel& channel, T& value) {
    if constexpr (std::is_same_v<T, std::string> || detail::isVector<T>) {
        detail::takeList(channel, value);
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
        std::string text;
        take(channel, text);
        value = text;
    } else if constexpr (detail::isOptional<T>) {
        bool isThere = false;
        take(channel, isThere);
        if (isThere) {
            take(channel, value.emplace());
        } else {
            value.reset();
        }
    } else if constexpr (detail::isVariant<T>) {
        std::uint64_t index = 0;
        take(channel, index);
        detail::takeAlternative(channel, value, index);
    } else if constexpr (HasParts<T>) {
        std::apply([&](auto&... part) { (take(channel, part), ...); }, partsOf(value));
    } else {
        static_assert(Plain<T>);
        channel.receive(&value, sizeof(T));
    }
}

}  // namespace kaustik::reading
