// SPDX-License-Identifier: MIT
// What the workbench shows and how, besides the document itself: kept over a restart as far as it
// is the user's choice.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/gui/look.h"
#include "framework/gui/window.h"

namespace kaustik::gui {

// What the image is compared with: it is seen to the right of the split.
// difference: what is to the left minus another one (ViewState::comparedKept).
enum class ComparedImage : int { none, other, reference, error, kept, difference };

struct ViewState {
    std::string resource;  // "": the picture
    int layer = 0;
    std::map<std::string, Look> looks;  // of each texture that has been given one; "": the picture
    ComparedImage comparedWith = ComparedImage::none;
    int comparedKept = -1;     // which of the kept variants that is; below 0: variant B
    int flipped = -1;          // which of them is seen in place of the newest frame; below 0: none
    float split = 0.5f;        // of the picture's width
    float zoom = 0.0f;         // window pixels a pixel; 0: fits
    glm::vec2 middle{0.5f};    // of the view, in pictures
    std::string soughtRegion;  // of the texture, that the view goes to once it is there
    bool probes = false;
    glm::ivec2 probePixel{-1};  // x < 0: none
    float probeRadius = 1.0f;   // pixels
    bool showsLights = true;
    std::string pass;  // that is looked at closely; "": none

    // Of an image by its name (ShownImage::resource).
    [[nodiscard]] Look lookOf(const std::string& name) const {
        const auto found = looks.find(name);
        return found != looks.end() ? found->second : Look();
    }
};

struct PanelState {
    float leftWidth = 440.0f;  // at scale 1
    float rightWidth = 266.0f;
    float chartHeight = 120.0f;
    // Which of the areas around the picture are there: it has all the room that they leave.
    bool isLeftOpen = false;
    bool isRightOpen = true;
    bool isChartOpen = false;
    bool showsGraph = false;         // in the place of the picture
    std::set<std::string> leftTabs;  // panels that are to the left; others are to the right
    std::string leftTab;             // that are in front
    std::string rightTab = "Passes";
    std::string parameterSearch;
    // What there is to say of what was typed last, by the parameter's full name, as long as the
    // same variant is edited and has the same value.
    struct TypedProblem {
        std::string sentence;
        std::size_t variant = 0;
        std::string assigned;  // "": its default
    };
    std::map<std::string, TypedProblem> parameterProblems;
    bool showsAllParameters = false;
    bool showsChangedParameters = false;  // just what differs from the technique's default
    int tradeOffMeasure = 0;              // of the panel Trade-off, relMSE first
    // Of the panel Study: what is varied, with its values as they were typed.
    struct VariedSetting {
        std::string key;
        std::string text;
    };
    std::vector<VariedSetting> studyAxes;
    int studyFrames = 8;
    bool judgesStudies = true;  // against the reference
    int edited = 0;             // variant: 0 A, 1 B
    bool isPrecise = false;
    bool isEndless = false;     // frames go on although nothing changes
    bool judgesReports = true;  // against the reference
    double referencePhotons = 8e6;
    std::string recordFolder = "results/runs/workbench";
    static constexpr int kMaxSequenceFrames = 100000;
    int sequenceFrames = 60;
    float sequenceStep = 1.0f / 30.0f;  // s
};

struct SavedState {
    ViewState view;
    PanelState panels;
    Window::Placement window;
    bool isDeviceKnown = false;  // isPrecise was chosen by or for the user
};

[[nodiscard]] nlohmann::json toJson(const SavedState& kept);
// What is missing is as at the first start; so is what makes no sense, and a sentence says which.
[[nodiscard]] SavedState savedStateFromJson(const nlohmann::json& json,
                                            std::vector<std::string>& problems);

// $XDG_CONFIG_HOME/kaustik, else ~/.config/kaustik; made if it is not there. "" where there is no
// such place, and nothing is kept then.
[[nodiscard]] std::filesystem::path settingsFolder();

}  // namespace kaustik::gui
