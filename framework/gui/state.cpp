// SPDX-License-Identifier: MIT
#include "framework/gui/state.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

float between(const json& j, const char* key, float fallback, float low, float high) {
    const auto found = j.find(key);
    if (found == j.end() || !found->is_number()) return fallback;
    const float value = found->get<float>();
    return std::isfinite(value) ? std::clamp(value, low, high) : fallback;
}

template <class T>
void take(const json& j, const char* key, T& value) {
    const auto found = j.find(key);
    if (found == j.end()) return;
    try {
        value = found->get<T>();
    } catch (const json::exception&) {
        // As it was: a restart must never fail for what was kept.
    }
}

}  // namespace

json toJson(const Kept& kept) {
    const ViewState& view = kept.view;
    const PanelState& panels = kept.panels;
    return {{"view",
             {{"resource", view.resource},
              {"layer", view.layer},
              {"channel", static_cast<int>(view.channel)},
              {"exposure", view.exposureStops},
              {"false_color", view.isFalseColor},
              {"range_automatic", view.isRangeAutomatic},
              {"low", view.low},
              {"high", view.high},
              {"beside", static_cast<int>(view.beside)},
              {"split", view.split},
              {"shows_lights", view.showsLights}}},
            {"panels",
             {{"left", panels.leftWidth},
              {"right", panels.rightWidth},
              {"chart", panels.chartHeight},
              {"all_parameters", panels.showsAllParameters},
              {"precise", panels.isPrecise},
              {"endless", panels.isEndless},
              {"truth_photons", panels.truthPhotons},
              {"record_folder", panels.recordFolder},
              {"sequence_frames", panels.sequenceFrames},
              {"sequence_step", panels.sequenceStep}}},
            {"window",
             {{"width", kept.window.width},
              {"height", kept.window.height},
              {"x", kept.window.x},
              {"y", kept.window.y}}},
            {"knows_device", kept.knowsDevice}};
}

Kept keptFromJson(const json& j) {
    Kept kept;
    const json none = json::object();
    const auto part = [&](const char* name) -> const json& {
        const auto found = j.find(name);
        return found != j.end() && found->is_object() ? *found : none;
    };
    if (!j.is_object()) return kept;
    const json& view = part("view");
    take(view, "resource", kept.view.resource);
    kept.view.layer = static_cast<int>(between(view, "layer", 0.0f, 0.0f, 63.0f));
    kept.view.channel = static_cast<Channel>(static_cast<int>(between(view, "channel", 0, 0, 5)));
    kept.view.exposureStops = between(view, "exposure", 0.0f, -20.0f, 20.0f);
    take(view, "false_color", kept.view.isFalseColor);
    take(view, "range_automatic", kept.view.isRangeAutomatic);
    kept.view.low = between(view, "low", 0.0f, -1e9f, 1e9f);
    kept.view.high = between(view, "high", 1.0f, -1e9f, 1e9f);
    kept.view.beside = static_cast<Beside>(static_cast<int>(between(view, "beside", 0, 0, 3)));
    kept.view.split = between(view, "split", 0.5f, 0.0f, 1.0f);
    take(view, "shows_lights", kept.view.showsLights);
    const json& panels = part("panels");
    kept.panels.leftWidth = between(panels, "left", kept.panels.leftWidth, 150.0f, 1200.0f);
    kept.panels.rightWidth = between(panels, "right", kept.panels.rightWidth, 150.0f, 1200.0f);
    kept.panels.chartHeight = between(panels, "chart", kept.panels.chartHeight, 40.0f, 800.0f);
    take(panels, "all_parameters", kept.panels.showsAllParameters);
    take(panels, "precise", kept.panels.isPrecise);
    take(panels, "endless", kept.panels.isEndless);
    kept.panels.truthPhotons = double(between(panels, "truth_photons", 8e6f, 1e5f, 1e12f));
    take(panels, "record_folder", kept.panels.recordFolder);
    kept.panels.sequenceFrames =
        static_cast<int>(between(panels, "sequence_frames", 60.0f, 1.0f, 100000.0f));
    kept.panels.sequenceStep = between(panels, "sequence_step", 1.0f / 30.0f, 1e-4f, 10.0f);
    const json& window = part("window");
    kept.window.width = static_cast<int>(between(window, "width", 1440.0f, 400.0f, 16384.0f));
    kept.window.height = static_cast<int>(between(window, "height", 900.0f, 300.0f, 16384.0f));
    kept.window.x = static_cast<int>(between(window, "x", -1.0f, -1.0f, 16384.0f));
    kept.window.y = static_cast<int>(between(window, "y", -1.0f, -1.0f, 16384.0f));
    take(j, "knows_device", kept.knowsDevice);
    return kept;
}

fs::path settingsFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr ? fs::path(value) : fs::path();
    };
    fs::path folder;
    if (const fs::path xdg = variable("XDG_CONFIG_HOME"); !xdg.empty()) {
        folder = xdg / "kaustik";
    } else if (const fs::path home = variable("HOME"); !home.empty()) {
        folder = home / ".config/kaustik";
    }
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    return error ? fs::path() : folder;
}

}  // namespace kaustik::gui
