// SPDX-License-Identifier: MIT
#include "framework/gui/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// One of the parts of what is kept. What cannot be taken stays as it was: a restart must never fail
// for it.
class Part {
  public:
    Part(const json& all, const char* name, std::vector<std::string>& problems)
        : name_(name), problems_(problems) {
        const auto found = all.find(name);
        if (found == all.end()) return;
        if (found->is_object()) {
            values_ = *found;
        } else {
            problems_.push_back(fmt::format("'{}' is no object", name));
        }
    }

    template <class T>
    void take(const char* key, T& value) {
        const auto found = values_.find(key);
        if (found == values_.end()) return;
        try {
            value = found->template get<T>();
        } catch (const json::exception&) {
            addProblem(key);
        }
    }

    [[nodiscard]] float between(const char* key, float fallback, float low, float high) {
        const auto found = values_.find(key);
        // What was not finite is written as null.
        if (found == values_.end() || found->is_null()) return fallback;
        if (!found->is_number()) {
            addProblem(key);
            return fallback;
        }
        const float value = found->get<float>();
        return std::isfinite(value) ? std::clamp(value, low, high) : fallback;
    }
    [[nodiscard]] int between(const char* key, int fallback, int low, int high) {
        return static_cast<int>(between(key, static_cast<float>(fallback), static_cast<float>(low),
                                        static_cast<float>(high)));
    }

  private:
    void addProblem(const char* key) {
        problems_.push_back(fmt::format("'{}.{}' makes no sense", name_, key));
    }

    json values_ = json::object();
    const char* name_;
    std::vector<std::string>& problems_;
};

// Kept variants are in memory, and gone with it.
bool isKept(ComparedImage image) {
    return image == ComparedImage::kept || image == ComparedImage::difference;
}

json toJson(const std::vector<PanelState::VariedSetting>& axes) {
    json all = json::array();
    for (const PanelState::VariedSetting& axis : axes)
        all.push_back({axis.key, axis.text});
    return all;
}

// Each key once; the panel says itself what is wrong with one.
std::vector<PanelState::VariedSetting> axesFrom(
    const std::vector<std::pair<std::string, std::string>>& all) {
    std::vector<PanelState::VariedSetting> axes;
    std::set<std::string> known;
    for (const auto& pair : all) {
        if (known.insert(pair.first).second) axes.push_back({pair.first, pair.second});
    }
    return axes;
}

json toJson(const std::map<std::string, Look>& looks) {
    json all = json::object();
    for (const auto& [name, look] : looks) {
        all[name] = {{"channel", static_cast<int>(look.channel)},
                     {"exposure_automatic", look.isExposureAutomatic},
                     {"exposure", look.exposureStops},
                     {"false_color", look.isFalseColor},
                     {"scale", static_cast<int>(look.scale)},
                     {"range_automatic", look.isRangeAutomatic},
                     {"low", look.low},
                     {"high", look.high}};
    }
    return all;
}

std::map<std::string, Look> looksFromJson(const json& all, std::vector<std::string>& problems) {
    std::map<std::string, Look> looks;
    if (!all.is_object()) {
        problems.emplace_back("'view.looks' is no object");
        return looks;
    }
    for (const auto& [name, values] : all.items()) {
        Part part(all, name.c_str(), problems);
        Look& look = looks[name];
        look.channel = static_cast<Channel>(part.between("channel", 0, 0, 5));
        part.take("exposure_automatic", look.isExposureAutomatic);
        look.exposureStops = part.between("exposure", 0.0f, -kMaxStops, kMaxStops);
        part.take("false_color", look.isFalseColor);
        look.scale = static_cast<Scale>(part.between("scale", 0, 0, 2));
        part.take("range_automatic", look.isRangeAutomatic);
        look.low = part.between("low", 0.0f, -1e30f, 1e30f);
        look.high = part.between("high", 1.0f, -1e30f, 1e30f);
    }
    return looks;
}

}  // namespace

json toJson(const SavedState& kept) {
    const ViewState& view = kept.view;
    const PanelState& panels = kept.panels;
    return {{"view",
             {{"resource", view.resource},
              {"layer", view.layer},
              {"looks", toJson(view.looks)},
              {"compared_with", static_cast<int>(isKept(view.comparedWith) ? ComparedImage::none
                                                                           : view.comparedWith)},
              {"split", view.split},
              {"shows_lights", view.showsLights}}},
            {"panels",
             {{"left", panels.leftWidth},
              {"right", panels.rightWidth},
              {"chart", panels.chartHeight},
              {"left_open", panels.isLeftOpen},
              {"right_open", panels.isRightOpen},
              {"chart_open", panels.isChartOpen},
              {"left_tabs", panels.leftTabs},
              {"left_tab", panels.leftTab},
              {"right_tab", panels.rightTab},
              {"all_parameters", panels.showsAllParameters},
              {"changed_parameters", panels.showsChangedParameters},
              {"graph", panels.showsGraph},
              {"trade_off_measure", panels.tradeOffMeasure},
              {"study", toJson(panels.studyAxes)},
              {"study_frames", panels.studyFrames},
              {"judged_studies", panels.judgesStudies},
              {"precise", panels.isPrecise},
              {"endless", panels.isEndless},
              {"judged_reports", panels.judgesReports},
              {"truth_photons", panels.referencePhotons},
              {"record_folder", panels.recordFolder},
              {"sequence_frames", panels.sequenceFrames},
              {"sequence_step", panels.sequenceStep}}},
            {"window",
             {{"width", kept.window.width},
              {"height", kept.window.height},
              {"x", kept.window.x},
              {"y", kept.window.y}}},
            {"knows_device", kept.isDeviceKnown}};
}

SavedState savedStateFromJson(const json& j, std::vector<std::string>& problems) {
    SavedState kept;
    if (!j.is_object()) {
        problems.emplace_back("it is no object");
        return kept;
    }
    Part view(j, "view", problems);
    view.take("resource", kept.view.resource);
    kept.view.layer = view.between("layer", 0, 0, 63);
    json looks = json::object();
    view.take("looks", looks);
    kept.view.looks = looksFromJson(looks, problems);
    kept.view.comparedWith = static_cast<ComparedImage>(view.between("compared_with", 0, 0, 3));
    kept.view.split = view.between("split", 0.5f, 0.0f, 1.0f);
    view.take("shows_lights", kept.view.showsLights);
    Part panels(j, "panels", problems);
    kept.panels.leftWidth = panels.between("left", kept.panels.leftWidth, 150.0f, 1200.0f);
    kept.panels.rightWidth = panels.between("right", kept.panels.rightWidth, 150.0f, 1200.0f);
    kept.panels.chartHeight = panels.between("chart", kept.panels.chartHeight, 40.0f, 800.0f);
    panels.take("left_open", kept.panels.isLeftOpen);
    panels.take("right_open", kept.panels.isRightOpen);
    panels.take("chart_open", kept.panels.isChartOpen);
    panels.take("left_tabs", kept.panels.leftTabs);
    panels.take("left_tab", kept.panels.leftTab);
    panels.take("right_tab", kept.panels.rightTab);
    panels.take("all_parameters", kept.panels.showsAllParameters);
    panels.take("changed_parameters", kept.panels.showsChangedParameters);
    panels.take("graph", kept.panels.showsGraph);
    kept.panels.tradeOffMeasure = panels.between("trade_off_measure", 0, 0, 5);
    std::vector<std::pair<std::string, std::string>> axes;
    panels.take("study", axes);
    kept.panels.studyAxes = axesFrom(axes);
    kept.panels.studyFrames = panels.between("study_frames", 8, 1, 10000);
    panels.take("judged_studies", kept.panels.judgesStudies);
    panels.take("precise", kept.panels.isPrecise);
    panels.take("endless", kept.panels.isEndless);
    panels.take("judged_reports", kept.panels.judgesReports);
    kept.panels.referencePhotons = double(panels.between("truth_photons", 8e6f, 1e5f, 1e12f));
    panels.take("record_folder", kept.panels.recordFolder);
    kept.panels.sequenceFrames =
        panels.between("sequence_frames", 60, 1, PanelState::kMaxSequenceFrames);
    kept.panels.sequenceStep = panels.between("sequence_step", 1.0f / 30.0f, 1e-4f, 10.0f);
    Part window(j, "window", problems);
    kept.window.width = window.between("width", 1440, 400, 16384);
    kept.window.height = window.between("height", 900, 300, 16384);
    kept.window.x = window.between("x", -1, -1, 16384);
    kept.window.y = window.between("y", -1, -1, 16384);
    const auto knows = j.find("knows_device");
    if (knows != j.end() && knows->is_boolean()) kept.isDeviceKnown = knows->get<bool>();
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
