// SPDX-License-Identifier: MIT
#include "framework/run/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/gl/objects.h"
#include "framework/pipeline/effect.h"
#include "framework/scene/emitters.h"
#include "framework/scene/spectrum.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/run/path_account.h"
#endif

namespace kaustik::run {
namespace {

using nlohmann::json;

const char* stateName(graph::PassState state) {
    switch (state) {
        case graph::PassState::ran:
            return "runs";
        case graph::PassState::bypassed:
            return "bypassed";
        case graph::PassState::culled:
            return "culled";
        case graph::PassState::skipped:
            return "skipped";
    }
    return "";
}

std::string needsText(const scene::Scene& scene, const scene::SceneNeeds& needs) {
    const auto line = [](const char* what, const auto& value) {
        return fmt::format("  {:<42}{}\n", what, value);
    };
    const auto orNone = [](bool has) { return has ? "yes" : "none"; };
    return fmt::format("scene {}: {} triangles\n", scene.name, triangleCount(scene)) +
           line("specular interfaces on the longest chain", needs.specularInterfaces) +
           line("reflectors, refractors",
                fmt::format("{}, {}", needs.reflectors, needs.refractors)) +
           line("medium", orNone(needs.medium)) +
           line("glossy receivers", orNone(needs.glossyReceivers)) +
           line("depth complexity from the eye",
                needs.measuredDepthComplexity < 0 ? "not measured"
                                                  : std::to_string(needs.measuredDepthComplexity)) +
           line("animated", needs.animated ? "yes" : "no") + line("lights", needs.lights);
}

// Of lights that have a size, how many points stand for each, and whether that can be seen.
std::string emittersText(const Renderer& renderer) {
    const scene::Scene& scene = renderer.scene();
    std::string text;
    for (std::size_t e = 0; e < scene.emitters.size(); ++e) {
        const scene::Emitter& emitter = scene.emitters[e];
        const auto count = std::count_if(
            scene.lights.begin(), scene.lights.end(),
            [&](const scene::Light& light) { return light.emitter == static_cast<int>(e); });
        const scene::EmitterPoints points =
            pointsOf(scene, emitter, static_cast<int>(count), renderer.pictureView().height);
        text += fmt::format(
            "  light '{}' has a size: {} point{} (emit.light_points); it spreads light by {:.2g} m "
            "at most, where a pixel sees {:.2g} m\n",
            nameOf(scene, emitter), count, count == 1 ? "" : "s", points.blurMeters,
            points.pixelMeters);
    }
    return text;
}

// Into how many parts white light is taken, and whether that can be seen.
std::string bandsText(const Renderer& renderer) {
    const scene::Scene& scene = renderer.scene();
    if (!renderer.needs().disperses) return "";
    const int bands = renderer.needs().bands;
    const scene::BandCount count = bandsOf(scene, bands, renderer.pictureView().height, 0.0);
    return fmt::format(
        "  light is followed at {} wavelength{} (emit.wavelengths); colors part by {:.2g} m at "
        "most, where a pixel sees {:.2g} m; the eye's rays are bent as the d line is\n",
        bands, bands == 1 ? "" : "s", count.partingMeters, count.pixelMeters);
}

std::string describe(const graph::ResourceDesc& desc) {
    if (const auto* texture = std::get_if<graph::TextureDesc>(&desc)) {
        return fmt::format("{}x{}{} {}", texture->width, texture->height,
                           texture->layers > 0 ? fmt::format("x{}", texture->layers) : "",
                           graph::formatName(texture->format));
    }
    return fmt::format("{} bytes", graph::bytesOf(desc));
}

// Parameters of nodes that the frame has, by what keeps them from having an effect.
std::string effectText(const Renderer& renderer) {
    const params::ParamSet& params = renderer.settings().params;
    std::map<std::string, std::vector<std::string>> byReason;
    for (const params::NamedField& named : params.all()) {
        const std::string& name = named.fullName;
        if (isOfOtherNode(splitParameterName(name), params)) continue;
        const std::string reason = renderer.whyNoEffect(name);
        if (!reason.empty()) byReason[reason].push_back(name);
    }
    if (byReason.empty()) return "";
    std::string text = "parameters without effect\n";
    for (const auto& [reason, names] : byReason)
        text += fmt::format("  {}: {}\n", reason, fmt::join(names, ", "));
    return text;
}

// By a census of the scene's paths, what of their light the technique forms and does not.
std::string lightText(const Renderer& renderer) {
#ifdef KAUSTIK_HAS_EMBREE
    const std::optional<reference::PathCensus> census = findCensus(renderer.scene());
    if (!census) {
        return fmt::format(
            "  which of the scene's light it cannot form is not known; kaustik census {} finds "
            "out\n",
            renderer.scene().file.string());
    }
    const ModelledPaths& paths = renderer.outputs().hits.incoming.paths;
    const std::string sentence =
        unformedSentence(*census, paths, renderer.settings().technique.name);
    if (!sentence.empty()) return fmt::format("  {}\n", sentence);
    return fmt::format("  of the caustic light, {:.4g} W, it cannot form {:.2g} W\n",
                       census->all.watts, unformedLight(*census, paths).watts);
#else
    static_cast<void>(renderer);
    return "";
#endif
}

}  // namespace

std::string explain(const Renderer& renderer) {
    std::string text = needsText(renderer.scene(), renderer.needs());
    text += emittersText(renderer) + bandsText(renderer);
    text += fmt::format("technique {}{}\n", renderer.settings().technique.name,
                        renderer.settings().technique.isAsPublished ? ", as published" : "");
    text += lightText(renderer);
    const std::vector<graph::PassRecord>& passes = renderer.compiled().records;
    std::size_t longest = 0;
    for (const graph::PassRecord& pass : passes)
        longest = std::max(longest, pass.name.size());
    for (const graph::PassRecord& pass : passes) {
        text += fmt::format("  {:<{}}  {:<10}{}\n", pass.name, longest, stateName(pass.state),
                            pass.reason);
    }
    text += "resources (--save takes the textures)\n";
    const std::vector<std::string> resources = renderer.graph().resourceNames();
    longest = 0;
    for (const std::string& name : resources)
        longest = std::max(longest, name.size());
    for (const std::string& name : resources) {
        text += fmt::format("  {:<{}}  {}\n", name, longest,
                            describe(renderer.graph().descOf(renderer.graph().find(name))));
    }
    text += effectText(renderer);
    for (const auto* warnings : {&renderer.scene().warnings, &renderer.warnings()}) {
        for (const std::string& warning : *warnings)
            text += fmt::format("warning: {}\n", warning);
    }
    return text;
}

json listPasses(const Renderer& renderer) {
    json passes = json::array();
    for (const graph::PassRecord& pass : renderer.compiled().records) {
        passes.push_back({{"name", pass.name},
                          {"stage", pass.name.substr(0, pass.name.find('.'))},
                          {"state", stateName(pass.state)},
                          {"why", pass.reason}});
    }
    return passes;
}

json listResources(const Renderer& renderer) {
    json resources = json::array();
    for (const std::string& name : renderer.graph().resourceNames()) {
        const graph::ResourceDesc& desc = renderer.graph().descOf(renderer.graph().find(name));
        if (const auto* texture = std::get_if<graph::TextureDesc>(&desc)) {
            resources.push_back({{"name", name},
                                 {"kind", "texture"},
                                 {"width", texture->width},
                                 {"height", texture->height},
                                 {"channels", gl::formatInfo(texture->format).channels},
                                 {"layers", texture->layers},
                                 {"format", graph::formatName(texture->format)}});
        } else {
            resources.push_back(
                {{"name", name}, {"kind", "buffer"}, {"bytes", graph::bytesOf(desc)}});
        }
    }
    return resources;
}

}  // namespace kaustik::run
