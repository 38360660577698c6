// SPDX-License-Identifier: MIT
#include "framework/numerics/lab.h"

#include <utility>

namespace kaustik::numerics {

std::vector<Row> Lab::run(const Case& hardCase) {
    caseId_ = hardCase.id;
    rows_.clear();
    for (const auto& measure : hardCase.measure)
        measure(*this);
    return std::exchange(rows_, {});
}

void Lab::expect(const std::string& subject, const std::string& what, double expected,
                 double measured, const Tolerance& tolerance) {
    rows_.push_back(
        {caseId_, subject, what, expected, measured, tolerance.value, tolerance.reason});
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
    return {registry_.techniques().front().name, {{stage, node}}, stage + "." + node};
}

}  // namespace kaustik::numerics
