// SPDX-License-Identifier: MIT
// The keys of [base] and [permute] that are no parameters, said once: setting.h's runValue reads by
// them, `kaustik schema experiment` prints them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace kaustik::experiment {

struct RunKey {
    enum class Type { text, size, whole, number, flag, texts };
    const char* name;
    const char* sentence;
    const char* unit;
    Type type;
    long long minimum = 0;  // of what is whole
    long long maximum = 0;
};
[[nodiscard]] const std::vector<RunKey>& runKeys();

// The JSON Schema of its values.
[[nodiscard]] nlohmann::json schemaOf(const RunKey& key);

}  // namespace kaustik::experiment
