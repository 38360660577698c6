// SPDX-License-Identifier: MIT
// The scenes that the project ships, for tests that hold each of them against the reference.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "framework/core/files.h"
#include "framework/gl/objects.h"
#include "framework/image/image.h"
#include "framework/pipeline/renderer.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {

// All but those without a specular surface, and those of meshes that are fetched on request only.
inline std::vector<std::string> shippedScenes() {
    const std::set<std::string> notHere = {"tree", "glass-dragon", "glass-dragon-low",
                                           "glass-teapot"};
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(projectRoot() / "experiments/scenes")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".toml" && notHere.count(name) == 0) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

// Of these what the reference of the view, which knows no medium, can be asked about.
inline std::vector<std::string> scenesWithViews() {
    std::vector<std::string> names = shippedScenes();
    names.erase(std::remove(names.begin(), names.end(), "god-rays"), names.end());
    return names;
}

// A frame of a technique, the screen's own or another, rendered for a purpose; `asOnGpu`: as the
// device would do that is none of the processor's. `registry` and `scene` must outlive it.
inline std::unique_ptr<Renderer> rendered(const Registry& registry, const scene::Scene& scene,
                                          int width, int height, Purpose purpose,
                                          const numerics::Settings& more = {}, bool asOnGpu = false,
                                          const std::string& technique = "screen_space_photons") {
    RenderSettings settings;
    settings.asOnGpu = asOnGpu;
    settings.technique = registry.findTechnique(technique);
    settings.params = registry.makeParams(settings.technique);
    for (const auto& [name, value] : more)
        settings.params.set(name, value, "test");
    settings.width = width;
    settings.height = height;
    auto renderer = std::make_unique<Renderer>(context(), registry, scene, std::move(settings));
    renderer->build(purpose);
    gl::PassTimer timer(gl::TimerMode::finish);
    renderer->renderFrame(timer);
    return renderer;
}

// For the names of tests.
inline std::string nameOfScene(const testing::TestParamInfo<std::string>& scene) {
    std::string name = scene.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

// `channels` of a texture from `channel` on, rows from the top.
inline Image imageOf(const gl::Texture& texture, int channel, int channels) {
    const int stored = gl::formatInfo(texture.desc().format).channels;
    const std::vector<float> texels = texture.read();
    Image image(texture.desc().width, texture.desc().height, channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < channels; ++c) {
                const int texel = (image.height - 1 - y) * image.width + x;
                image.at(x, y, c) = texels[static_cast<std::size_t>(texel * stored + channel + c)];
            }
        }
    }
    return image;
}

}  // namespace kaustik::test
