// SPDX-License-Identifier: MIT
// The energy ledger of the reference: the accounts of transport/types.h in double precision. Every
// account is summed on its own, none as a remainder (framework/README.md, "The energy ledger").
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include "framework/transport/types.h"
#include "framework/transport/watts.h"

namespace kaustik::reference {

// Watts as transport/watts.h counts them. The account after these is of papers' own rows alone.
struct Energy {
    std::array<double, transport::kReferenceAccounts> watts{};
    // The part of what was deposited that a pixel of the picture sees; not part of the balance.
    double visibleWatts = 0.0;

    void add(unsigned account, const glm::dvec3& fluxWatts) {
        watts[account] += transport::wattsOf(fluxWatts);
    }
    [[nodiscard]] double lostWatts() const;
    // (emitted - deposited - absorbed - left the scene - lost) / emitted; 0 where nothing was
    // emitted.
    [[nodiscard]] double balance() const;
};

// emitted_w, deposited_w, visible_w, absorbed_w, left_scene_w, lost_w by cause, balance.
[[nodiscard]] nlohmann::json toJson(const Energy& energy);

}  // namespace kaustik::reference
