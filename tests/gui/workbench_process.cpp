// SPDX-License-Identifier: MIT
#include "tests/gui/workbench_process.h"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "framework/core/files.h"
#include "framework/core/names.h"

namespace kaustik::test {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

// Not a measure of speed: on a software rasteriser that shares its cores a scene may take minutes,
// and a workbench that never gets there fails the test only then.
constexpr auto kLimit = std::chrono::seconds(300);
constexpr auto kPollInterval = std::chrono::milliseconds(5);

constexpr const char* kDescription = "screen.json";

// An old description would be taken for this process's own.
fs::path withoutFile(const fs::path& file) {
    fs::remove(file);
    return file;
}

std::vector<std::string> withGui(const std::vector<std::string>& arguments, const fs::path& file) {
    std::vector<std::string> all = {"gui"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"--describe", file.string(), "--unattended"});
    return all;
}

Conditions conditionsIn(const fs::path& folder, const std::string& display,
                        const std::map<std::string, std::string>& more) {
    Conditions conditions;
    conditions.folder = folder;
    conditions.environment = more;
    conditions.environment.insert({{"DISPLAY", display},
                                   {"XDG_CONFIG_HOME", folder / "config"},
                                   {"KAUSTIK_CACHE", folder / "cache"}});
    return conditions;
}

long keysOf(const std::string& chord) {
    // "ctrl++" is a chord with the key "+".
    return 1 + std::count(chord.begin(), chord.end() - 1, '+');
}

std::vector<std::string> nearestNames(const std::string& name, std::vector<std::string> names) {
    constexpr std::size_t enough = 5;
    std::vector<std::string> nearest;
    while (nearest.size() < enough) {
        const std::string next = nearestName(name, names);
        if (next.empty()) break;
        nearest.push_back(next);
        std::erase(names, next);
    }
    return nearest.empty() ? names : nearest;
}

}  // namespace

WorkbenchProcess::WorkbenchProcess(Desktop& desktop, const fs::path& folder,
                                   const std::vector<std::string>& arguments,
                                   const std::map<std::string, std::string>& environment)
    : desktop_(desktop),
      file_(withoutFile(fs::absolute(folder) / kDescription)),
      program_(withGui(arguments, file_),
               conditionsIn(fs::absolute(folder), desktop.name(), environment)) {}

std::optional<WorkbenchProcess::Json> WorkbenchProcess::description() const {
    std::error_code ignored;
    if (!fs::exists(file_, ignored)) return {};
    return Json::parse(readFile(file_));
}

WorkbenchProcess::Json WorkbenchProcess::screen() {
    std::optional<Json> latest;
    const auto isThere = [&] { return (latest = description()).has_value(); };
    if (!poll("a first description", isThere) && !isThere()) {
        fail("The workbench has ended without a description.");
    }
    return *latest;
}

bool WorkbenchProcess::has(const std::string& control) {
    return screen().at("controls").contains(control);
}

WorkbenchProcess::Json WorkbenchProcess::entryOf(const std::string& name) {
    const Json controls = screen().at("controls");
    if (!controls.contains(name)) {
        std::vector<std::string> names;
        for (const auto& [other, rectangle] : controls.items())
            names.push_back(other);
        fail("There is no control '" + name + "' on the screen; there are " +
             joinNames(nearestNames(name, names)) + ".");
    }
    return controls.at(name);
}

Rectangle WorkbenchProcess::control(const std::string& name) {
    const Json found = entryOf(name);
    return {found.at("x"), found.at("y"), found.at("w"), found.at("h")};
}

std::string WorkbenchProcess::value(const std::string& control) {
    return entryOf(control).at("value");
}

void WorkbenchProcess::waitFor(const std::string& what,
                               const std::function<bool(const Json&)>& isSo) {
    std::string missing;
    const auto isSoNow = [&] {
        const std::optional<Json> latest = description();
        try {
            missing.clear();
            return latest && isSo(*latest);
        } catch (const Json::exception& error) {
            missing = error.what();
            return false;
        }
    };
    // What it wrote last counts, even if it has ended since.
    if (poll(what, isSoNow) || isSoNow()) return;
    fail("The workbench never showed " + what + ", and has ended." +
         (missing.empty() ? "" : "\n" + missing));
}

void WorkbenchProcess::hover(const std::string& control, Spot spot) {
    moveTo(placeOf(control, spot));
}

void WorkbenchProcess::moveTo(Place place) {
    const Place origin = desktop_.originOf(window());
    desktop_.moveTo(place.x, place.y, 2);
    untilTaken([&](const Json& screen) {
        const Json& status = screen.at("status");
        return status.contains("mouse") && status.at("mouse").at(0) == place.x - origin.x &&
               status.at("mouse").at(1) == place.y - origin.y;
    });
}

// Dear ImGui before 1.87 asks for the state of buttons and keys once a frame, so that one which is
// released too soon was never pressed.
void WorkbenchProcess::press(unsigned button) {
    const long before = strokes();
    desktop_.press(button);
    untilStrokesTaken(before, 1);
}

void WorkbenchProcess::release(unsigned button) {
    const long before = strokes();
    desktop_.release(button);
    untilStrokesTaken(before, 1);
}

void WorkbenchProcess::keyDown(const std::string& chord) {
    static_cast<void>(window());
    const long before = strokes();
    desktop_.keyDown(chord);
    untilStrokesTaken(before, keysOf(chord));
}

void WorkbenchProcess::keyUp(const std::string& chord) {
    const long before = strokes();
    desktop_.keyUp(chord);
    untilStrokesTaken(before, keysOf(chord));
}

void WorkbenchProcess::click(const std::string& control, unsigned button, Spot spot) {
    hover(control, spot);
    press(button);
    release(button);
}

// Dear ImGui wants the second press within 0.3 seconds of the first, which leaves no time to see
// each press taken, and in a later frame than the first release. A press counts in the next frame
// even if it is over by then, which is the one after `first` at the latest; the release, in the one
// after that. A hand that trembles keeps a workbench with nothing to do from waiting in between.
void WorkbenchProcess::doubleClick(const std::string& control) {
    constexpr auto untilNextFrameHasBegun = std::chrono::milliseconds(40);
    const Place place = placeOf(control);
    hover(control);
    desktop_.press();
    desktop_.release();
    int trembled = 0;
    const auto isPast = [&](long frame) {
        trembled = 1 - trembled;
        desktop_.moveTo(place.x + trembled, place.y, 1);
        return this->frame() > frame;
    };
    const long before = frame();
    static_cast<void>(poll("a next frame", [&] { return isPast(before); }));
    const long first = frame();
    static_cast<void>(poll("the frame after it", [&] { return isPast(first); }));
    desktop_.moveTo(place.x, place.y, 1);
    std::this_thread::sleep_for(untilNextFrameHasBegun);
    desktop_.press();
    desktop_.release();
    untilTaken();
}

void WorkbenchProcess::drag(const std::string& control, int dx, int dy, unsigned button,
                            Spot spot) {
    constexpr int steps = 10;
    const Place from = placeOf(control, spot);
    hover(control, spot);
    press(button);
    desktop_.moveTo(from.x + dx, from.y + dy, steps);
    untilTaken();
    release(button);
}

void WorkbenchProcess::wheel(const std::string& control, int notches, Spot spot) {
    const Place place = placeOf(control, spot);
    hover(control, spot);
    desktop_.wheel(place.x, place.y, notches);
    untilTaken();
}

void WorkbenchProcess::dropFiles(const std::vector<fs::path>& files, const std::string& control) {
    const Place place = placeOf(control);
    desktop_.dropFiles(files, place.x, place.y);
    untilTaken();
}

void WorkbenchProcess::key(const std::string& chord) {
    keyDown(chord);
    keyUp(chord);
}

void WorkbenchProcess::type(const std::string& text) {
    static_cast<void>(window());
    // Characters are queued, so that they may come faster than frames.
    desktop_.type(text);
    untilTaken();
}

void WorkbenchProcess::typeInto(const std::string& control, const std::string& text, Entry entry,
                                const std::string& lastKey, Spot spot) {
    if (entry == Entry::controlClick) {
        keyDown("ctrl");
        click(control, kLeftButton, spot);
        keyUp("ctrl");
    } else {
        click(control, kLeftButton, spot);
    }
    key("ctrl+a");
    type(text);
    if (!lastKey.empty()) key(lastKey);
}

void WorkbenchProcess::close() {
    desktop_.close(window());
}

Outcome WorkbenchProcess::wait() {
    static_cast<void>(poll("its end", [] { return false; }));
    return program_.wait();
}

void WorkbenchProcess::kill() {
    program_.send(SIGKILL);
    static_cast<void>(program_.wait());
}

fs::path WorkbenchProcess::keepScreenshot(const std::string& name) {
    untilDrawn();
    return desktop_.keepScreenshot(name);
}

WindowId WorkbenchProcess::window() {
    if (window_) return *window_;
    const auto isThere = [&] { return (window_ = desktop_.windowTitled("Kaustik")).has_value(); };
    if (!poll("a window titled \"Kaustik...\"", isThere)) fail("The workbench has ended.");
    desktop_.focus(*window_);
    return *window_;
}

Place WorkbenchProcess::placeOf(const std::string& control, Spot spot) {
    const Rectangle rectangle = this->control(control);
    const Place origin = desktop_.originOf(window());
    return {origin.x + static_cast<int>(std::floor(rectangle.x + spot.x * rectangle.w)),
            origin.y + static_cast<int>(std::floor(rectangle.y + spot.y * rectangle.h))};
}

long WorkbenchProcess::frame() const {
    const std::optional<Json> latest = description();
    return latest ? latest->at("frame").get<long>() : -1;
}

long WorkbenchProcess::strokes() const {
    const std::optional<Json> latest = description();
    return latest ? latest->at("status").at("strokes").get<long>() : 0;
}

void WorkbenchProcess::untilStrokesTaken(long before, long count) {
    untilTaken([&](const Json& screen) {
        return screen.at("status").at("strokes").get<long>() >= before + count;
    });
}

void WorkbenchProcess::untilTaken() {
    untilTaken([](const Json&) { return false; });
}

void WorkbenchProcess::untilTaken(const std::function<bool(const Json&)>& isTaken) {
    // A window that input opens is in sight two frames later.
    constexpr long framesToShow = 2;
    // Where nothing says that it was taken: the first description after the input may be of a frame
    // that had begun before it, and an X server that has pictures of the workbench's to put up
    // first keeps its events back for so long: seen for a frame, on a busy machine. The frame after
    // has taken the input.
    constexpr long framesToTake = 2;
    const long before = frame();
    std::optional<long> shown;
    std::optional<long> shownAtTheLatest;
    static_cast<void>(poll("the frames after an input", [&] {
        const std::optional<Json> latest = description();
        if (!latest) return false;
        const long now = latest->at("frame").get<long>();
        if (!shownAtTheLatest && now > before) shownAtTheLatest = now + framesToTake + framesToShow;
        if (!shown && isTaken(*latest)) shown = now + framesToShow;
        return (shown && now >= *shown) || (shownAtTheLatest && now >= *shownAtTheLatest);
    }));
}

void WorkbenchProcess::untilDrawn() {
    const long described = frame();
    static_cast<void>(poll("the pixels of a frame", [&] {
        const std::optional<Json> latest = description();
        return latest && latest->at("status").at("drawn_frame").get<long>() >= described;
    }));
}

bool WorkbenchProcess::poll(const std::string& what, const std::function<bool()>& isSo) const {
    const auto end = Clock::now() + kLimit;
    while (!isSo()) {
        if (!program_.isRunning()) return false;
        if (Clock::now() > end) {
            fail("The workbench never showed " + what + " in " + std::to_string(kLimit.count()) +
                 " seconds.");
        }
        std::this_thread::sleep_for(kPollInterval);
    }
    return true;
}

void WorkbenchProcess::fail(const std::string& message) const {
    std::optional<Json> latest = description();
    if (latest) latest->at("status").erase("interface_ms");
    const std::string ending = program_.ending();
    throw std::runtime_error(message + (ending.empty() ? "" : "\nIt has ended with " + ending) +
                             "\nLast status: " + (latest ? latest->at("status").dump() : "none") +
                             "\nStandard error: " + program_.messages());
}

}  // namespace kaustik::test
