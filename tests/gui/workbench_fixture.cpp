// SPDX-License-Identifier: MIT
#include "tests/gui/workbench_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/core/files.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace fs = std::filesystem;
using Json = nlohmann::json;

WorkbenchTest::WorkbenchTest(int desktopWidth, int desktopHeight)
    : desktop(desktopWidth, desktopHeight) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
}

Json WorkbenchTest::smallDocument(const std::string& scene) {
    return {{"scene", scene},
            {"edits", Json::object()},
            {"size", {64, 48}},
            {"variant",
             {{"technique", "screen_space_photons"},
              {"set", {{"emit.photons", "32x32"}, {"shadow.map.size", "64"}}},
              {"disable", Json::array()}}}};
}

Json WorkbenchTest::savedStateWith(const Json& document) {
    return {{"document", document},
            {"view", {{"shows_lights", false}}},
            {"panels",
             {{"precise", true},
              {"left_open", true},
              {"chart_open", true},
              {"right", 360},
              {"left_tabs", {"Passes", "Technique", "Scene"}},
              {"left_tab", "Passes"},
              {"right_tab", "Parameters"},
              {"record_folder", "out"},
              {"judged_reports", false},
              {"truth_photons", 1e6}}},
            {"knows_device", true}};
}

Json WorkbenchTest::savedStateShowing(const std::string& resource, int layer) {
    Json kept = savedStateWith(smallDocument());
    kept["view"]["resource"] = resource;
    kept["view"]["layer"] = layer;
    return kept;
}

void WorkbenchTest::writeSavedState(const Json& kept) const {
    const fs::path file = folder / "config/kaustik/workbench.json";
    fs::create_directories(file.parent_path());
    writeFileWhole(file, kept.dump(1));
}

Json WorkbenchTest::readSavedState() const {
    return readJson("config/kaustik/workbench.json");
}

void WorkbenchTest::start(const Json& kept, const std::map<std::string, std::string>& environment) {
    writeSavedState(kept);
    startAgain(environment);
}

void WorkbenchTest::startAgain(const std::map<std::string, std::string>& environment) {
    bench.reset();
    bench.emplace(desktop, folder / "", std::vector<std::string>{}, environment);
    untilSettled();
}

void WorkbenchTest::endByClosing() {
    bench->close();
    const Outcome outcome = bench->wait();
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

void WorkbenchTest::switchPass(const std::string& name) {
    if (!bench->has("passes.on." + name)) bench->wheel("passes.on.emit.grid", -20);
    bench->click("passes.on." + name);
}

void WorkbenchTest::untilSettled() {
    bench->waitFor("a settled picture", [](const Json& screen) {
        const Json& status = screen.at("status");
        return status.at("settled") == true && status.at("rendered_order") == status.at("order");
    });
    // The frame that said so is not on the desktop yet.
    bench->untilDrawn();
}

void WorkbenchTest::untilRecorded() {
    bench->waitFor("the end of the recording", [](const Json& screen) {
        return screen.at("controls")
            .at("record.state")
            .at("value")
            .get<std::string>()
            .starts_with("idle: ");
    });
}

void WorkbenchTest::choose(const std::string& control, const std::string& option) {
    bench->click(control);
    // A long list shows a part of itself.
    for (int tries = 0; tries < 20 && !bench->has(control + "=" + option); ++tries) {
        const Json controls = bench->screen().at("controls");
        for (const auto& [name, rectangle] : controls.items()) {
            if (!name.starts_with(control + "=")) continue;
            bench->wheel(name, -1);
            break;
        }
    }
    bench->click(control + "=" + option);
}

bool WorkbenchTest::says(const std::string& control, const std::string& part) {
    const Json controls = bench->screen().at("controls");
    return controls.contains(control) &&
           controls.at(control).at("value").get<std::string>().find(part) != std::string::npos;
}

Spot WorkbenchTest::pixel(int x, int y) const {
    return {(x + 0.5) / width, (y + 0.5) / height};
}

Image WorkbenchTest::seenPicture() {
    bench->hover("toolbar.keys");
    const Rectangle area = bench->control("picture");
    const Rectangle whole = bench->control("picture.image");
    const Place origin = desktop.originOf(desktop.windowTitled("Kaustik").value());
    const auto x0 = static_cast<int>(std::ceil(std::max(area.x, whole.x)));
    const auto y0 = static_cast<int>(std::ceil(std::max(area.y, whole.y)));
    const auto x1 = static_cast<int>(std::floor(std::min(area.x + area.w, whole.x + whole.w)));
    const auto y1 = static_cast<int>(std::floor(std::min(area.y + area.h, whole.y + whole.h)));
    bench->untilDrawn();
    const Image all = desktop.screenshot();
    Image part(x1 - x0, y1 - y0, 3);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            for (int c = 0; c < 3; ++c)
                part.at(x - x0, y - y0, c) = all.at(origin.x + x, origin.y + y, c);
        }
    }
    return part;
}

Outcome WorkbenchTest::run(const std::vector<std::string>& arguments) const {
    Conditions conditions;
    conditions.folder = folder / "";
    conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
    Outcome outcome = runKaustik(arguments, conditions);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome;
}

Outcome WorkbenchTest::renderSmall(const std::vector<std::string>& more,
                                   const std::string& scene) const {
    // Of the technique that the saved documents have.
    std::vector<std::string> options = {"--technique", "screen_space_photons"};
    options.insert(options.end(), more.begin(), more.end());
    std::vector<std::string> arguments = smallRun(scene, options);
    // As the workbench does, which keeps the ledger out of the frames that it measures.
    *(std::find(arguments.begin(), arguments.end(), "--warmup") + 1) = "1";
    return run(arguments);
}

Json WorkbenchTest::readJson(const fs::path& file) const {
    return Json::parse(readFile(folder / file.string()));
}

double meanOf(const Image& image) {
    double sum = 0.0;
    for (const float value : image.values)
        sum += static_cast<double>(value);
    return sum / static_cast<double>(image.values.size());
}

double largestDifference(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels)
        return std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        largest = std::max(
            largest, std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i])));
    }
    return largest;
}

Image columns(const Image& image, int x0, int x1) {
    Image part(x1 - x0, image.height, image.channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = x0; x < x1; ++x) {
            for (int c = 0; c < image.channels; ++c)
                part.at(x - x0, y, c) = image.at(x, y, c);
        }
    }
    return part;
}

}  // namespace kaustik::test
