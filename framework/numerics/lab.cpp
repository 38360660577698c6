// SPDX-License-Identifier: MIT
#include "framework/numerics/lab.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::numerics {

std::vector<Row> Lab::run(const Case& hardCase) {
    caseId_ = hardCase.id;
    rows_.clear();
    framesScanned_ = texturesScanned_ = valuesNotFinite_ = 0;
    for (const auto& measure : hardCase.measure) {
        try {
            measure(*this);
        } catch (const DeviceError&) {
            throw;  // the cases after it would say the same
        } catch (const Error& error) {
            expect("", fmt::format("measuring fails: {}", error.what()), 0.0,
                   std::numeric_limits<double>::quiet_NaN(), kExactly);
        }
    }
    if (framesScanned_ > 0) {
        expect("",
               fmt::format("values not finite in {} textures of {} frames", texturesScanned_,
                           framesScanned_),
               0.0, static_cast<double>(valuesNotFinite_), kExactly);
    }
    return std::exchange(rows_, {});
}

void Lab::expect(const std::string& subject, const std::string& what, double expected,
                 double measured, const Tolerance& tolerance) {
    rows_.push_back(
        {caseId_, subject, what, expected, measured, tolerance.value, tolerance.reason});
}

void Lab::expectAtLeast(const std::string& subject, const std::string& what, double minimum,
                        double measured, const std::string& reason) {
    rows_.push_back({caseId_, subject, what, minimum, measured, 0.0, reason, Bound::atLeast});
}

void Lab::expectAtMost(const std::string& subject, const std::string& what, double maximum,
                       double measured, const std::string& reason) {
    rows_.push_back({caseId_, subject, what, maximum, measured, 0.0, reason, Bound::atMost});
}

void Lab::expectRefused(const std::string& subject, const std::string& what,
                        const std::function<void()>& render) {
    bool isRefused = false;
    try {
        render();
    } catch (const ConfigError&) {
        isRefused = true;
    }
    expect(subject, fmt::format("is it refused: {}", what), 1.0, isRefused ? 1.0 : 0.0, kExactly);
}

std::vector<std::string> Lab::nodesOf(const std::string& stage) const {
    std::vector<std::string> nodes;
    for (const Registry::Node& node : registry_.nodes()) {
        if (node.stage == stage) nodes.push_back(node.name);
    }
    return nodes;
}

Lab::Choice Lab::choose(const std::string& stage, const std::string& node) const {
    for (const Technique& technique : registry_.techniques()) {
        if (registry_.makeParams(technique).choice(stage) == node)
            return {technique.name, {}, stage + "." + node};
    }
    Choice choice{registry_.techniques().front().name, {{stage, node}}, stage + "." + node};
    if (stage == ReconstructStage::name) {
        const std::string filter = registry_.traits<ReconstructStage>(node).filter;
        if (!filter.empty()) choice.settings.emplace_back(FilterStage::name, filter);
    }
    return choice;
}

bool Lab::goesThroughBodies(const Choice& specular) const {
    const std::size_t dot = specular.subject.find('.');
    return registry_.traits<SpecularStage>(specular.subject.substr(dot + 1)).throughBodies;
}

TracerReach Lab::tracerReach(const Choice& tracer) const {
    const std::size_t dot = tracer.subject.find('.');
    return registry_.traits<TraceStage>(tracer.subject.substr(dot + 1)).reach;
}

bool Lab::seesReceiversOnly(const Choice& tracer) const {
    const std::size_t dot = tracer.subject.find('.');
    return registry_.traits<TraceStage>(tracer.subject.substr(dot + 1)).onlyReceivers;
}

Frame Lab::render(const Technique& technique, const scene::Scene& scene, FrameRequest request) {
    request.keepsAll = true;
    request.poison = true;
    Frame frame(context_, registry_, scene, technique, request);
    ++framesScanned_;
    for (const std::string& name : frame.textureNames()) {
        if (suite_.mayBeUnwritten(name)) continue;
        ++texturesScanned_;
        valuesNotFinite_ += frame.countNotFinite(name);
    }
    return frame;
}

Frame Lab::render(const Choice& choice, const scene::Scene& scene, FrameRequest request) {
    request.settings.insert(request.settings.begin(), choice.settings.begin(),
                            choice.settings.end());
    return render(registry_.findTechnique(choice.technique), scene, request);
}

}  // namespace kaustik::numerics
