// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <glm/gtc/type_ptr.hpp>

#include "framework/gui/number_fields.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/picture_choice.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

// Of places, and of times in seconds: what is typed may be anything.
constexpr double kMinTyped = -1e6;
constexpr double kMaxTyped = 1e6;

bool dragVector(Bench& bench, const char* label, glm::dvec3& value, float speed,
                const std::string& name, const char* format = "%.4g") {
    const bool isChanged =
        ImGui::DragScalarN(label, ImGuiDataType_Double, glm::value_ptr(value), 3, speed, &kMinTyped,
                           &kMaxTyped, format, ImGuiSliderFlags_AlwaysClamp);
    bench.map.control(name, fmt::format("{} {} {}", value.x, value.y, value.z));
    return isChanged;
}

void openScene(Bench& bench, const std::string& scene) {
    if (scene == bench.document.scene) return;
    bench.document.scene = scene;
    bench.document.edits = {};
    bench.view.probePixel = glm::ivec2(-1);
}

// Scenes by name, each by the technique that a new document has.
void drawScenePictures(Bench& bench) {
    std::vector<PictureOption> options;
    for (const scene::SceneListing& listing : bench.scenes) {
        options.push_back({listing.name, listing.description, {listing.name, kDefaultTechnique}});
    }
    if (const auto chosen = chooseByPicture(bench, "scene.pictures", "A scene by its picture",
                                            options, bench.document.scene))
        openScene(bench, options[*chosen].name);
}

void drawChoiceOfScene(Bench& bench) {
    std::vector<std::string> names;
    int index = -1;
    for (const scene::SceneListing& listing : bench.scenes) {
        if (listing.name == bench.document.scene) index = static_cast<int>(names.size());
        names.push_back(listing.name);
    }
    if (index < 0) {  // a file
        index = static_cast<int>(names.size());
        names.push_back(bench.document.scene);
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (choose(bench, "##scene", names, index, "scene.choice"))
        openScene(bench, names[static_cast<std::size_t>(index)]);
    tooltip(
        "Or drop a scene (.toml, .gltf, .glb) or a mesh (.obj, .ply, .stl, .3ds) on the window.");
    drawScenePictures(bench);
    ImGui::SameLine();
    if (button(bench, "Read its file again (F5)", "scene.reload")) ++bench.sceneReloads;
    if (bench.document.edits != scene::SceneEdits()) {
        ImGui::SameLine();
        if (button(bench, "Undo all changes", "scene.reset")) bench.document.edits = {};
    }
    if (bench.result->scene) {
        const SceneFacts& facts = *bench.result->scene;
        if (!facts.description.empty()) ImGui::TextWrapped("%s", facts.description.c_str());
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextDisabled("%zu triangles; specular interfaces on the longest chain: %d",
                            facts.triangles, facts.needs.specularInterfaces);
        ImGui::PopTextWrapPos();
    }
    ImGui::SetNextItemWidth(widthBeside("picture size, px"));
    static_cast<void>(inputExtent("picture size, px", bench.document.size, 1, 16384));
    bench.map.control("scene.size",
                      fmt::format("{}x{}", bench.document.size.width, bench.document.size.height));
}

void drawTime(Bench& bench, const SceneFacts& facts) {
    ImGui::Separator();
    scene::SceneEdits& edits = bench.document.edits;
    double time = bench.timeSeconds();
    if (button(bench, bench.isPlaying ? "Pause" : "Play", "scene.play"))
        bench.isPlaying = !bench.isPlaying;
    tooltip("Space. Every picture is rendered; time goes on by the step below.");
    ImGui::SameLine();
    if (button(bench, "Step", "scene.step")) {
        bench.isPlaying = false;
        edits.timeSeconds = time + double(bench.panels.sequenceStep);
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize(" time, s").x);
    if (ImGui::DragScalar("time, s", ImGuiDataType_Double, &time, 0.01f, &kMinTyped, &kMaxTyped,
                          "%.4f", ImGuiSliderFlags_AlwaysClamp))
        edits.timeSeconds = time;
    bench.map.control("scene.time", fmt::format("{}", time));
    ImGui::DragFloat("step, s", &bench.panels.sequenceStep, 0.001f, 0.0001f, 10.0f, "%.4g");
    if (!ImGui::IsAnyItemActive())
        keepWithin(bench, "step, s", bench.panels.sequenceStep, 0.0001f, 10.0f);
    if (!facts.needs.animated) ImGui::TextDisabled("Nothing moves in this scene.");
}

void drawCamera(Bench& bench, const SceneFacts& facts) {
    if (!ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) return;
    scene::Camera camera = bench.camera();
    const auto speed =
        static_cast<float>(0.002 * glm::length(facts.bounds.maximum - facts.bounds.minimum));
    bool isChanged = dragVector(bench, "position, m", camera.position, speed, "scene.camera");
    isChanged |= dragVector(bench, "target, m", camera.target, speed, "scene.target");
    auto angle = static_cast<float>(camera.verticalFovDegrees);
    if (ImGui::SliderFloat("field of view", &angle, 5.0f, 150.0f, "%.1f°",
                           ImGuiSliderFlags_AlwaysClamp)) {
        camera.verticalFovDegrees = double(angle);
        isChanged = true;
    }
    const bool isPossible =
        glm::length(glm::cross(camera.target - camera.position, camera.up)) > 1e-9;
    if (isChanged && isPossible) {
        bench.document.edits.camera = camera;
        bench.isTurning = true;
    }
    if (bench.document.edits.camera &&
        button(bench, "Back to the scene's camera (R)", "scene.camera_reset")) {
        bench.document.edits.camera.reset();
    }
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled(
        "On the picture: drag to orbit, right drag to look, Ctrl and wheel to come nearer, W A S D "
        "Q E to fly.");
    ImGui::PopTextWrapPos();
}

void drawLight(Bench& bench, const scene::Light& light, float speed) {
    ImGui::PushID(light.name.c_str());
    std::map<std::string, scene::LightEdit>& edits = bench.document.edits.lights;
    const bool isEdited = edits.contains(light.name);
    scene::LightEdit edit = isEdited ? edits.at(light.name) : scene::LightEdit();
    bool isChanged = false;
    ImGui::TextUnformatted(light.name.c_str());
    if (isEdited) {
        ImGui::SameLine();
        if (resetMark(bench, "light." + light.name, "the scene's own")) {
            edits.erase(light.name);
            ImGui::PopID();
            return;
        }
    }
    if (light.kind != scene::LightKind::point) {
        glm::dvec3 direction = edit.direction.value_or(light.direction);
        if (dragVector(bench, "direction", direction, 0.005f, "scene.light." + light.name,
                       "%.3g") &&
            glm::length(direction) > 1e-6) {
            edit.direction = direction;
            isChanged = true;
        }
    }
    if (light.kind != scene::LightKind::directional) {
        glm::dvec3 position = edit.position.value_or(light.position);
        if (dragVector(bench, "position, m", position, speed, "scene.lamp." + light.name)) {
            edit.position = position;
            isChanged = true;
        }
    }
    if (light.kind == scene::LightKind::directional) {
        auto degrees = static_cast<float>(edit.angularDiameterDegrees.value_or(
            glm::degrees(static_cast<double>(light.angularDiameterRadians))));
        if (ImGui::SliderFloat("its disc, degrees", &degrees, 0.0f, 20.0f, "%.2f",
                               ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
            edit.angularDiameterDegrees = static_cast<double>(degrees);
            isChanged = true;
        }
        bench.map.control("scene.disc." + light.name, fmt::format("{}", degrees));
    }
    float factor = edit.powerFactor.value_or(1.0f);
    if (ImGui::SliderFloat("times its power", &factor, 0.0f, 10.0f, "%.2f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
        edit.powerFactor = factor;
        isChanged = true;
    }
    bench.map.control("scene.power." + light.name, fmt::format("{}", factor));
    if (isChanged) edits[light.name] = edit;
    ImGui::PopID();
}

void drawWater(Bench& bench, const SceneFacts::Water& water) {
    ImGui::PushID(water.object.c_str());
    auto& edits = bench.document.edits.waves;
    const bool isEdited = edits.contains(water.object);
    std::vector<scene::Wave> waves = isEdited ? edits.at(water.object) : water.waves;
    bool isChanged = false;
    ImGui::TextUnformatted(water.object.c_str());
    if (isEdited) {
        ImGui::SameLine();
        if (resetMark(bench, "water." + water.object, "the scene's own")) {
            edits.erase(water.object);
            ImGui::PopID();
            return;
        }
    }
    for (std::size_t i = 0; i < waves.size(); ++i) {
        scene::Wave& wave = waves[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::TextDisabled("wave %zu", i + 1);
        isChanged |=
            ImGui::SliderFloat("amplitude, m", &wave.amplitudeMeters, 0.0f,
                               0.2f * wave.wavelengthMeters, "%.4f", ImGuiSliderFlags_AlwaysClamp);
        bench.map.control(fmt::format("scene.wave.{}.{}.amplitude", water.object, i),
                          fmt::format("{}", wave.amplitudeMeters));
        isChanged |= ImGui::DragFloat("length, m", &wave.wavelengthMeters, 0.005f, 0.01f, 1e4f,
                                      "%.3f", ImGuiSliderFlags_AlwaysClamp);
        isChanged |= ImGui::DragFloat("direction", &wave.directionDegrees, 0.5f, -360.0f, 360.0f,
                                      "%.1f°", ImGuiSliderFlags_AlwaysClamp);
        if (ImGui::SmallButton("remove")) {
            waves.erase(waves.begin() + static_cast<std::ptrdiff_t>(i));
            isChanged = true;
            ImGui::PopID();
            break;
        }
        ImGui::PopID();
    }
    if (ImGui::SmallButton("add a wave")) {
        waves.push_back({});
        isChanged = true;
    }
    if (isChanged) edits[water.object] = waves;
    ImGui::PopID();
}

void drawMedium(Bench& bench, const scene::Medium& own) {
    if (!ImGui::CollapsingHeader("Medium")) return;
    scene::Medium medium = bench.document.edits.medium.value_or(own);
    bool isChanged = ImGui::DragFloat3("scattering, 1/m", glm::value_ptr(medium.scatteringPerMeter),
                                       0.002f, 0.0f, 1e3f, "%.4f", ImGuiSliderFlags_AlwaysClamp);
    isChanged |= ImGui::DragFloat3("absorption, 1/m", glm::value_ptr(medium.absorptionPerMeter),
                                   0.002f, 0.0f, 1e3f, "%.4f", ImGuiSliderFlags_AlwaysClamp);
    isChanged |= ImGui::SliderFloat("anisotropy", &medium.anisotropy, -0.99f, 0.99f, "%.2f",
                                    ImGuiSliderFlags_AlwaysClamp);
    if (isChanged) bench.document.edits.medium = medium;
}

}  // namespace

void drawScene(Bench& bench) {
    drawChoiceOfScene(bench);
    if (!bench.isSceneCurrent()) return;
    const SceneFacts& facts = *bench.result->scene;
    ImGui::PushItemWidth(widthBeside("its disc, degrees"));
    drawTime(bench, facts);
    drawCamera(bench, facts);
    if (!facts.lights.empty() &&
        ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) {
        static_cast<void>(
            checkbox(bench, "handles on the picture (L)", bench.view.showsLights, "scene.handles"));
        const auto speed =
            static_cast<float>(0.002 * glm::length(facts.bounds.maximum - facts.bounds.minimum));
        for (const scene::Light& light : facts.lights)
            drawLight(bench, light, speed);
    }
    if (!facts.waters.empty()) {
        const bool isOpen = ImGui::CollapsingHeader("Water");
        bench.map.control("scene.header.water", isOpen ? "open" : "");
        for (const SceneFacts::Water& water : facts.waters) {
            if (isOpen) drawWater(bench, water);
        }
    }
    if (facts.medium) drawMedium(bench, *facts.medium);
    ImGui::PopItemWidth();
}

}  // namespace kaustik::gui
