// SPDX-License-Identifier: MIT
// Studies of the wavy water: two values, twice each, with next to nothing to render.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {

inline constexpr const char* kStudyBase = R"(name = "layers"
repeats = 2
[base]
scene = "wavy.toml"
size = "32x24"
frames = 1
warmup = 0
"emit.photons" = "16x16"
"shadow.map.size" = 64
technique = "screen_space_photons"
)";

class ExperimentCommand : public CommandLine {
  protected:
    ExperimentCommand() {
        static_cast<void>(folder.file("wavy.toml", kWavyWater));
        writeStudy("[permute]\n'layers.count' = [1, 2]\n");
    }

    void writeStudy(const std::string& more) const {
        static_cast<void>(folder.file("study.toml", kStudyBase + more));
    }

    [[nodiscard]] static std::vector<std::string> study(const std::vector<std::string>& more = {},
                                                        const std::string& out = "out") {
        std::vector<std::string> arguments = {"experiment", "run", "study.toml", "--out", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    // The folders of finished runs, by name.
    [[nodiscard]] std::vector<std::string> runs(const std::string& out = "out") const {
        std::set<std::string> names;
        for (const std::string& file : files()) {
            const std::filesystem::path path = file;
            if (file.find(".part") != std::string::npos) continue;  // killed just before it was
            if (path.filename() == "run.json" && path.begin()->string() == out) {
                names.insert(path.parent_path().filename().string());
            }
        }
        return {names.begin(), names.end()};
    }

    // The lines of runs.csv, cells apart; of messages, which may have commas, within quotes.
    [[nodiscard]] std::vector<std::vector<std::string>> table(
        const std::string& out = "out") const {
        std::vector<std::vector<std::string>> lines(1, {""});
        bool isQuoted = false;
        for (const char c : contents(out + "/runs.csv")) {
            if (c == '"') {
                isQuoted = !isQuoted;
            } else if (isQuoted) {
                lines.back().back() += c;
            } else if (c == '\n') {
                lines.push_back({""});
            } else if (c == ',') {
                lines.back().emplace_back();
            } else {
                lines.back().back() += c;
            }
        }
        lines.pop_back();
        return lines;
    }

    [[nodiscard]] std::vector<std::string> column(const std::string& name,
                                                  const std::string& out = "out") const {
        const auto lines = table(out);
        const auto found = std::find(lines[0].begin(), lines[0].end(), name);
        std::vector<std::string> cells;
        if (found == lines[0].end()) return cells;
        for (std::size_t line = 1; line < lines.size(); ++line) {
            cells.push_back(lines[line][static_cast<std::size_t>(found - lines[0].begin())]);
        }
        return cells;
    }

    // What of a folder of results names neither times nor days.
    void expectSameResults(const std::string& one, const std::string& other) const {
        EXPECT_EQ(runs(one), runs(other));
        for (const std::string& run : runs(one)) {
            for (const char* file : {"caustic.exr", "beauty.exr", "beauty.png"}) {
                // Pixels, since an .exr also has the time at which it was written.
                EXPECT_EQ(readImage(folder / (one + "/" + run + "/" + file)).values,
                          readImage(folder / (other + "/" + run + "/" + file)).values)
                    << run << " " << file;
            }
        }
        for (const char* name : {"hash", "repeat", "status", "layers.count", "energy.emitted_w"})
            EXPECT_EQ(column(name, one), column(name, other)) << name;
    }
};

}  // namespace kaustik::test
