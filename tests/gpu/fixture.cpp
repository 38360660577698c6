// SPDX-License-Identifier: MIT
#include "tests/gpu/fixture.h"

#include <algorithm>

namespace kaustik::test {
namespace {

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

numerics::FrameRequest request(int width, int height, const Settings& settings,
                               std::vector<std::string> saved, bool poison) {
    saved.insert(saved.end(), {"eye.receiver", "eye.receiver_surface"});
    return {width, height, settings, saved, false, poison};
}

}  // namespace

gl::Context& context() {
    static const std::unique_ptr<gl::Context> instance = gl::Context::createHeadless(true);
    return *instance;
}

bool lacksExactTracer() {
    const std::vector<Technique>& techniques = registry().techniques();
    return std::none_of(techniques.begin(), techniques.end(),
                        [](const Technique& t) { return t.name == "raytraced"; });
}

Frame::Frame(const scene::Scene& scene, int width, int height, const Settings& settings,
             const std::vector<std::string>& saved, bool poison, const std::string& technique)
    : numerics::Frame(context(), registry(), scene, registry().findTechnique(technique),
                      request(width, height, settings, saved, poison)) {}

Frame::Frame(const scene::Scene& scene, const numerics::FrameRequest& request,
             const std::string& technique)
    : numerics::Frame(context(), registry(), scene, registry().findTechnique(technique), request) {}

}  // namespace kaustik::test
