// SPDX-License-Identifier: MIT
#include "framework/pipeline/in_use.h"

#include "framework/pipeline/stage_params.h"

namespace kaustik {
namespace {

bool refines(const Registry& registry, const params::ParamSet& params) {
    const std::string driver = params.choice(DriverStage::name);
    return registry.findNode(DriverStage::name, driver).description.refines;
}

}  // namespace

bool isInUse(const Registry& registry, const params::ParamSet& params, const std::string& name) {
    const auto dot = name.find('.');
    if (dot == std::string::npos) return false;
    const std::string stage = name.substr(0, dot);
    if (stage == RefineStage::name && !refines(registry, params)) return false;
    if (name.starts_with("reconstruct.map_") &&
        params.get<ReconstructParams>("reconstruct").space == StoreSpace::screen) {
        return false;
    }
    const auto second = name.find('.', dot + 1);
    return second == std::string::npos ||
           params.choice(stage) == name.substr(dot + 1, second - dot - 1);
}

}  // namespace kaustik
