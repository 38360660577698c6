// SPDX-License-Identifier: MIT
#include "tests/gpu/fixture.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/scene/scene_file.h"

namespace kaustik::test {

gl::Context& context() {
    static const std::unique_ptr<gl::Context> instance = gl::Context::createHeadless();
    return *instance;
}

scene::Scene sceneFromText(const std::string& toml) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("kaustik-scene-" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << toml;
    scene::Scene scene = scene::loadSceneFile(file);
    std::filesystem::remove(file);
    return scene;
}

Frame::Frame(const scene::Scene& scene, int width, int height, const Settings& settings,
             const std::vector<std::string>& saved, bool poison, const std::string& technique)
    : registry_(registerAll()), view_(render::makeEyeView(scene.camera, width, height)) {
    RenderSettings render;
    render.technique = registry_.findTechnique(technique);
    render.params = registry_.makeParams(render.technique);
    for (const auto& [name, value] : settings)
        render.params.set(name, value, "test");
    render.width = width;
    render.height = height;
    gl::Context& gl = context();
    renderer_ = std::make_unique<Renderer>(gl, registry_, scene, std::move(render));
    std::vector<std::string> kept = saved;
    kept.insert(kept.end(), {"eye.receiver", "eye.receiver_surface"});
    renderer_->build(Purpose::measurement, kept);
    renderer_->executor().poisonTransients(poison);
    gl::PassTimer timer(gl::TimerMode::finish);
    renderer_->renderFrame(timer);
}

Texels Frame::read(const std::string& resource, int layer) const {
    const gl::Texture& texture = renderer_->texture(renderer_->graph().find(resource));
    const graph::TextureDesc& desc = texture.desc();
    Texels texels{desc.width, desc.height, gl::formatInfo(desc.format).channels, texture.read()};
    const std::size_t perLayer = static_cast<std::size_t>(desc.width) *
                                 static_cast<std::size_t>(desc.height) *
                                 static_cast<std::size_t>(texels.channels);
    const auto begin = texels.values.begin() +
                       static_cast<std::ptrdiff_t>(static_cast<std::size_t>(layer) * perLayer);
    texels.values = std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(perLayer));
    return texels;
}

glm::dvec3 Frame::toWorld(const glm::dvec3& positionVs) const {
    return glm::dvec3(glm::inverse(view_.worldToView) * glm::dvec4(positionVs, 1.0));
}

glm::dvec3 Frame::worldAt(int x, int y, double depth) const {
    const glm::dvec2 ndc((x + 0.5) / view_.width * 2.0 - 1.0, (y + 0.5) / view_.height * 2.0 - 1.0);
    return toWorld(glm::dvec3(ndc * view_.tangents, -1.0) * depth);
}

}  // namespace kaustik::test
