// SPDX-License-Identifier: MIT
// One function object of several lambdas, for std::visit.
#pragma once

namespace kaustik {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
// Clang 14 deduces nothing for an aggregate.
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace kaustik
