// SPDX-License-Identifier: MIT
#include "framework/run/settings.h"

namespace kaustik::run {

RenderSettings makeSettings(const SettingsRequest& request, const Registry& registry) {
    RenderSettings settings;
    settings.technique = registry.findTechnique(request.technique, request.isAsPublished);
    settings.params = registry.makeParams(settings.technique);
    params::assign(settings.params, request.assignments);
    settings.disabledPasses = request.disabledPasses;
    settings.disabledBy = request.disabledBy;
    settings.seed = request.seed;
    return settings;
}

void setSize(RenderSettings& settings, const params::Extent& size) {
    settings.width = size.width;
    settings.height = size.height;
}

}  // namespace kaustik::run
