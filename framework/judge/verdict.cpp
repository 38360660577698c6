// SPDX-License-Identifier: MIT
// A verdict as JSON, as text and as a picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/judge/judge.h"
#include "framework/judge/primaries.h"

namespace kaustik::judge {

using nlohmann::json;

namespace {

// A line where its colours tell its primaries from few others, or from none; else nothing.
std::string untoldPrimaries(const Verdict& verdict) {
    const std::vector<Primaries>& others = verdict.otherPrimaries;
    if (others.empty()) return "";
    if (others.size() + 1 == kAllPrimaries.size()) {
        return fmt::format(
            "its primaries cannot be told, since it has too little colour, and are taken for "
            "{}\n",
            titleOf(verdict.primaries));
    }
    std::string names;
    for (std::size_t k = 0; k < others.size(); ++k) {
        names += (k == 0 ? "" : k + 1 < others.size() ? ", " : " or ") + titleOf(others[k]);
    }
    return fmt::format("its primaries cannot be told from {}\n", names);
}

}  // namespace

const char* nameOf(Encoding encoding) {
    switch (encoding) {
        case Encoding::srgb:
            return "srgb";
        case Encoding::gamma22:
            return "gamma2.2";
        case Encoding::automatic:
            return "auto";
        default:
            return "linear";
    }
}

const char* nameOf(Primaries primaries) {
    switch (primaries) {
        case Primaries::rec2020:
            return "rec2020";
        case Primaries::p3:
            return "p3";
        case Primaries::acescg:
            return "acescg";
        case Primaries::aces2065:
            return "aces2065";
        case Primaries::automatic:
            return "auto";
        default:
            return "rec709";
    }
}

std::string titleOf(const std::string& className) {
    const std::string path = className.substr(0, className.find('@'));
    const std::string by = path.size() < className.size()
                               ? fmt::format(", first at {}", className.substr(path.size() + 1))
                               : "";
    const bool isPath = !path.empty() && path.find_first_not_of("RT") == std::string::npos;
    if (!isPath) return path == "other" ? "all other light" + by : "light by " + path + by;
    if (path.find('T') == std::string::npos) {
        return (path.size() == 1 ? std::string("light that is reflected")
                                 : fmt::format("light that is reflected {} times", path.size())) +
               by;
    }
    if (path == "T") return "light that is refracted once" + by;
    if (path == "TT") return "light that is refracted twice" + by;
    const bool isInside = path.front() == 'T' && path.back() == 'T' &&
                          path.find_first_not_of('R', 1) == path.size() - 1;
    const std::size_t times = path.size() - 2;
    if (isInside) {
        return fmt::format("light that is reflected {} inside{}",
                           times == 1   ? "once"
                           : times == 2 ? "twice"
                                        : fmt::format("{} times", times),
                           by);
    }
    return "light by the path " + path + by;
}

json toJson(const Verdict& verdict) {
    json classes = json::array();
    for (const ClassVerdict& of : verdict.classes) {
        classes.push_back({{"name", of.name},
                           {"title", of.title},
                           {"flux_share", of.fluxShare},
                           {"c", of.coefficient},
                           {"c_stderr", std::isfinite(of.error) ? json(of.error) : json(nullptr)},
                           {"verdict", of.verdict}});
    }
    json otherPrimaries = json::array();
    for (const Primaries primaries : verdict.otherPrimaries)
        otherPrimaries.push_back(nameOf(primaries));
    json findings = json::array();
    for (const Finding& finding : verdict.findings) {
        findings.push_back({{"name", finding.name},
                            {"value", finding.value},
                            {"stderr", finding.error},
                            {"sentence", finding.sentence},
                            {"also", finding.also}});
    }
    return {{"schema", "kaustik.judge/1"},
            {"scene", verdict.scene},
            {"theirs", verdict.theirs},
            {"registration",
             {{"flipped_x", verdict.registration.isFlippedX},
              {"flipped_y", verdict.registration.isFlippedY},
              {"scale", verdict.registration.scale},
              {"shift_px", {verdict.registration.shift.x, verdict.registration.shift.y}},
              {"correlation", verdict.registration.correlation}}},
            {"encoding", nameOf(verdict.encoding)},
            {"primaries", nameOf(verdict.primaries)},
            {"other_primaries", otherPrimaries},
            {"direct_light", verdict.hasDirect},
            {"glass_hidden", verdict.glassIsHidden},
            {"exposure", verdict.exposure},
            {"exposure_stderr", verdict.exposureError},
            {"exposure_by", verdict.exposureBy},
            {"blur_px", verdict.blurPixels},
            {"left_out",
             {{"not_diffuse", verdict.leftOut.notDiffuse},
              {"glass", verdict.leftOut.glass},
              {"outside", verdict.leftOut.outside}}},
            {"classes", classes},
            {"findings", findings},
            {"residual",
             {{"pixels", verdict.pixels},
              {"unexplained_share", verdict.unexplainedShare},
              {"explained_share",
               verdict.explainedShare ? json(*verdict.explainedShare) : json(nullptr)},
              {"critical_z", verdict.criticalZ},
              {"largest_z", verdict.largestZ},
              {"significant_pixels", verdict.significantPixels}}}};
}

std::string toText(const Verdict& verdict) {
    std::string text = fmt::format(
        "{} against {}: {} pixels counted, {}, {}\n", verdict.theirs, verdict.scene, verdict.pixels,
        verdict.hasDirect ? "with direct light" : "caustics alone",
        verdict.glassIsHidden ? "straight through glass" : "without those that see glass");
    const LeftOut& out = verdict.leftOut;
    const double share = out.notDiffuse + out.glass + out.outside;
    if (share > 0.0) {
        text += fmt::format(
            "not judged: {:.1f} % of the pixels (on {:.1f} % there is a mirror, gloss, a lamp, an "
            "edge or nothing, on {:.1f} % the eye sees glass, {:.1f} % are outside the picture)\n",
            100.0 * share, 100.0 * out.notDiffuse, 100.0 * out.glass, 100.0 * out.outside);
    }
    text += fmt::format("exposure {:.5g} ± {:.2g}, by {}; values are {}, in {} primaries\n",
                        verdict.exposure, verdict.exposureError, verdict.exposureBy,
                        nameOf(verdict.encoding), titleOf(verdict.primaries));
    text += untoldPrimaries(verdict) + "\n";
    text += fmt::format("{:<14} {:>9}  {:>8} {:>8}  {}\n", "class", "of light", "c", "±", "");
    for (const ClassVerdict& of : verdict.classes) {
        text += fmt::format("{:<14} {:>7.2f} %  {:>8.3f} {:>8.3f}  {}\n", of.name,
                            100.0 * of.fluxShare, of.coefficient, of.error, of.verdict);
    }
    text += "\n";
    if (verdict.findings.empty()) text += "No fault was found.\n";
    for (const Finding& finding : verdict.findings) {
        text += fmt::format("- {}.\n", finding.sentence);
        for (const std::string& other : finding.also)
            text += fmt::format("  or, nearly as well: {}.\n", other);
    }
    text += fmt::format(
        "Unexplained: {:.2f} % of the light; {} of {} pixels beyond |z| = {:.2f}, the most "
        "{:.1f}.\n",
        100.0 * verdict.unexplainedShare, verdict.significantPixels, verdict.pixels,
        verdict.criticalZ, verdict.largestZ);
    return text;
}

Image whereOf(const Verdict& verdict) {
    const Image& z = verdict.z;
    Image picture(z.width, z.height, 3);
    for (int y = 0; y < z.height; ++y) {
        for (int x = 0; x < z.width; ++x) {
            const float value = z.at(x, y, 0);
            const double share =
                std::min(std::abs(static_cast<double>(value)) / (2.0 * verdict.criticalZ), 1.0);
            const auto pale = static_cast<float>(1.0 - share);
            const bool isCounted = value != 0.0f;
            picture.at(x, y, 0) = !isCounted ? 0.5f : value > 0.0f ? 1.0f : pale;
            picture.at(x, y, 1) = !isCounted ? 0.5f : pale;
            picture.at(x, y, 2) = !isCounted ? 0.5f : value > 0.0f ? pale : 1.0f;
        }
    }
    return picture;
}

}  // namespace kaustik::judge
