// SPDX-License-Identifier: MIT
#include "framework/reference/request_json.h"

#include <nlohmann/json.hpp>

#include "framework/core/json_number.h"

namespace kaustik::reference {

using nlohmann::json;

json requestToJson(const ReferenceRequest& request) {
    json result = {{"estimator", request.estimator == Estimator::light ? "light" : "sppm"},
                   {"size", {request.width, request.height}},
                   {"seed", request.seed},
                   {"photons_per_batch", request.photonsPerBatch},
                   {"transmission_only", request.filter.transmissionOnly},
                   {"maximum_interactions", request.filter.maximumInteractions},
                   {"split_interactions", request.filter.splitInteractions}};
    if (request.filter.reflectionOnly) result["reflection_only"] = true;
    if (request.estimator == Estimator::sppm) {
        result["initial_radius_px"] = request.initialRadiusPixels;
        result["alpha"] = request.alpha;
        result["caustic_view"] = request.causticView;
    }
    for (const PathClass& one : request.classes)
        result["classes"].push_back({{"name", one.name}, {"pattern", one.pattern}});
    return result;
}

ReferenceRequest requestFromJson(const json& from) {
    ReferenceRequest request;
    request.estimator = from.at("estimator") == "sppm" ? Estimator::sppm : Estimator::light;
    request.width = wholeNumber<int>(from.at("size").at(0));
    request.height = wholeNumber<int>(from.at("size").at(1));
    request.seed = wholeNumber<std::uint64_t>(from.at("seed"));
    request.photonsPerBatch = wholeNumber<std::uint64_t>(from.at("photons_per_batch"));
    request.filter.transmissionOnly = from.at("transmission_only");
    request.filter.reflectionOnly = from.value("reflection_only", false);
    request.filter.maximumInteractions = wholeNumber<int>(from.at("maximum_interactions"));
    request.filter.splitInteractions = wholeNumber<int>(from.at("split_interactions"));
    request.initialRadiusPixels = from.value("initial_radius_px", request.initialRadiusPixels);
    request.alpha = from.value("alpha", request.alpha);
    request.causticView = from.value("caustic_view", request.causticView);
    if (from.contains("classes")) {
        for (const json& one : from.at("classes"))
            request.classes.push_back({one.at("name"), one.at("pattern")});
    }
    return request;
}

}  // namespace kaustik::reference
