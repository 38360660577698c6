// SPDX-License-Identifier: MIT
#include "framework/reference/energy.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace kaustik::reference {
namespace {

using namespace transport;

// The causes of loss that ray tracing knows; it has no screen, layers or batches to lose light in.
constexpr std::array<std::pair<unsigned, const char*>, 5> kCauses = {{
    {kAccountUntracedBranch, "untraced_branch"},
    {kAccountInternalReflectionLimit, "internal_reflection_limit"},
    {kAccountBounceLimit, "bounce_limit"},
    {kAccountNestingLimit, "nesting_limit"},
    {kAccountNotANumber, "not_a_number"},
}};

}  // namespace

double Energy::lostWatts() const {
    double lost = 0.0;
    for (const auto& [account, name] : kCauses)
        lost += watts[account];
    return lost;
}

double Energy::balance() const {
    const double emitted = watts[kAccountEmitted];
    if (emitted <= 0.0) return 0.0;
    return (emitted - watts[kAccountDeposited] - watts[kAccountAbsorbed] -
            watts[kAccountLeftScene] - lostWatts()) /
           emitted;
}

nlohmann::json toJson(const Energy& energy) {
    nlohmann::json lost = nlohmann::json::object();
    for (const auto& [account, name] : kCauses)
        lost[name] = energy.watts[account];
    return {{"emitted_w", energy.watts[kAccountEmitted]},
            {"deposited_w", energy.watts[kAccountDeposited]},
            {"visible_w", energy.visibleWatts},
            {"absorbed_w", energy.watts[kAccountAbsorbed]},
            {"left_scene_w", energy.watts[kAccountLeftScene]},
            {"lost_w", lost},
            {"balance", energy.balance()}};
}

}  // namespace kaustik::reference
