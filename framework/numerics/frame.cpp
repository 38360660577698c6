// SPDX-License-Identifier: MIT
#include "framework/numerics/frame.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "framework/scene/files/scene_file.h"

namespace kaustik::numerics {
namespace {

const std::string kListName = "photons.list";

}  // namespace

scene::Scene sceneFromText(const std::string& toml) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("kaustik-scene-" + std::to_string(::getpid()) + ".toml");
    struct Removed {
        const std::filesystem::path& file;
        ~Removed() {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
        }
    } const removed{file};
    std::ofstream(file) << toml;
    return scene::loadSceneFile(file);
}

double Texels::sum() const {
    double total = 0.0;
    for (const float value : values)
        total += static_cast<double>(value);
    return total;
}

Frame::Frame(gl::Context& context, const Registry& registry, const scene::Scene& scene,
             const Technique& technique, const FrameRequest& request)
    : view_(render::makeEyeView(scene.camera, request.width, request.height)) {
    RenderSettings render;
    render.technique = technique;
    render.params = registry.makeParams(technique);
    for (const auto& [name, value] : request.settings)
        render.params.set(name, value, "hard case");
    render.width = request.width;
    render.height = request.height;
    render.asOnGpu = request.asOnGpu;
    renderer_ = std::make_unique<Renderer>(context, registry, scene, std::move(render));
    const Purpose purpose = request.recordsTraces ? Purpose::audit : Purpose::measurement;
    std::vector<std::string> kept = request.saved;
    if (request.keepsAll) {
        static_cast<void>(renderer_->compile(purpose));
        kept = textureNames();
        for (const std::string& name : renderer_->graph().resourceNames()) {
            if (name.starts_with(kListName)) kept.push_back(name);
        }
    }
    renderer_->build(purpose, kept);
    renderer_->executor().poisonTransients(request.poison);
    gl::PassTimer timer(gl::TimerMode::finish);
    renderer_->renderFrame(timer);
}

Texels Frame::read(const std::string& resource, int layer) const {
    return read(renderer_->graph().find(resource), layer);
}

Texels Frame::read(const graph::ResourceRef& handle, int layer) const {
    const gl::Texture& texture = renderer_->texture(handle);
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

std::vector<std::string> textureNames(const Renderer& renderer) {
    const graph::Graph& graph = renderer.graph();
    std::vector<std::string> names;
    for (const std::string& name : graph.resourceNames()) {
        if (std::holds_alternative<graph::TextureDesc>(graph.descOf(graph.find(name))))
            names.push_back(name);
    }
    return names;
}

std::size_t countNotFinite(const Renderer& renderer, const std::string& texture) {
    const graph::Graph& graph = renderer.graph();
    std::vector<float> values = renderer.texture(graph.find(texture)).read();
    // What lies beyond a list of photons nobody writes, or reads.
    for (const char* listed : {"photons.", "hits."}) {
        if (!texture.starts_with(listed)) continue;
        // The list has the same suffix, behind a name that may have underscores of its own.
        std::size_t suffix = std::string(listed).size();
        graph::ResourceRef list;
        while (!list.valid() && suffix < texture.size()) {
            suffix = std::min(texture.find_first_of("._", suffix + 1), texture.size());
            list = graph.find(kListName + texture.substr(suffix));
        }
        if (!list.valid()) continue;
        const auto count = renderer.buffer(list).read<transport::PhotonList>().front().count;
        values.resize(std::min<std::size_t>(values.size(), 4 * std::size_t{count}));
    }
    return static_cast<std::size_t>(std::count_if(
        values.begin(), values.end(), [](float value) { return !std::isfinite(value); }));
}

glm::dvec3 Frame::toWorld(const glm::dvec3& positionVs) const {
    return glm::dvec3(glm::inverse(view_.worldToView) * glm::dvec4(positionVs, 1.0));
}

glm::dvec3 Frame::worldAt(int x, int y, double depth) const {
    const glm::dvec2 ndc((x + 0.5) / view_.width * 2.0 - 1.0, (y + 0.5) / view_.height * 2.0 - 1.0);
    return toWorld(glm::dvec3(ndc * view_.halfExtent, -1.0) * depth);
}

}  // namespace kaustik::numerics
