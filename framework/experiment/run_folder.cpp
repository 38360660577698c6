// SPDX-License-Identifier: MIT
#include "framework/experiment/run_folder.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <set>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kRecord = "run.json";

std::string checksum(const std::string& bytes) {
    const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
    return fmt::format("{:08x}", ::crc32_z(0, data, bytes.size()));
}

json readJson(const fs::path& file) {
    return parseJson(readFile(file), file.string());
}

json manifestOf(const fs::path& folder) {
    json files = json::object();
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name == kRecord || !entry.is_regular_file()) continue;
        const std::string bytes = readFile(entry.path());
        files[name] = {{"bytes", bytes.size()}, {"crc32", checksum(bytes)}};
    }
    return files;
}

void require(bool holds, const fs::path& file, const std::string& what) {
    if (!holds) throw IoError(fmt::format("{}: {}.", file.string(), what));
}

// That the program did what it was asked to, as far as it says.
void requireReportOf(const json& report, const PlannedRun& run, const fs::path& file) {
    const auto same = [&](const char* inReport, const json& requested) {
        require(report.contains(inReport) && report.at(inReport) == requested, file,
                fmt::format("this is the report of another run: its {} are not those that were "
                            "asked for",
                            inReport));
    };
    require(report.is_object() && report.value("schema", "") == "kaustik.report/1", file,
            "this is not a kaustik.report/1");
    const json& settings = run.settings;
    same("technique", settings.at("technique"));
    same("as_published", settings.value("as_published", false));
    same("parameters", settings.at("parameters"));
    same("seed", settings.at("seed"));
    same("frames", settings.at("frames"));
    same("warmup", settings.at("warmup"));
}

}  // namespace

std::string folderName(const PlannedRun& run, int repeat) {
    return repeat == 1 ? run.hash : fmt::format("{}-r{}", run.hash, repeat);
}

FinishedRun readFinishedRun(const fs::path& folder, const PlannedRun& run, int repeat) try {
    FinishedRun finished;
    const fs::path recordFile = folder / kRecord;
    finished.record = readJson(recordFile);
    require(finished.record.is_object() && finished.record.value("schema", "") == "kaustik.run/1",
            recordFile, "this is not a kaustik.run/1");
    require(finished.record.value("settings", json()) == run.settings, recordFile,
            "these are the settings of another run");
    require(finished.record.value("repeat", json()) == repeat, recordFile,
            "this is another repeat");
    const json files = finished.record.value("files", json());
    require(files.is_object() && files.contains("report.json") && files.contains("samples.json"),
            recordFile, "it lists no report.json and samples.json");
    for (const auto& [name, expected] : files.items()) {
        const std::string bytes = readFile(folder / name);
        require(expected == json{{"bytes", bytes.size()}, {"crc32", checksum(bytes)}},
                folder / name, "this file is damaged");
    }
    finished.report = readJson(folder / "report.json");
    finished.samples = readJson(folder / "samples.json");
    return finished;
} catch (const json::exception& error) {
    throw IoError(fmt::format("{} is damaged: {}.", (folder / kRecord).string(), error.what()));
}

void finalizeRun(const fs::path& folder, const PlannedRun& run, int repeat, double wallSeconds) {
    requireReportOf(readJson(folder / "report.json"), run, folder / "report.json");
    const json record = {{"schema", "kaustik.run/1"},
                         {"version", versionString()},
                         {"hash", run.hash},
                         {"repeat", repeat},
                         {"settings", run.settings},
                         {"finished", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))},
                         {"wall_s", wallSeconds},
                         {"files", manifestOf(folder)}};
    writeFileWhole(folder / kRecord, jsonText(record, 2) + "\n");
}

void moveIntoPlace(const fs::path& fresh, const fs::path& folder) {
    std::error_code error;
    fs::rename(fresh, folder, error);  // fails where there is one, perhaps since a moment ago
    if (!error) return;
    error.clear();
    if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) {
        fs::remove_all(fresh, error);
        error.clear();
    } else {
        // A file system that cannot exchange two names: what is there makes way first.
        fs::path old = fresh;
        old += ".old";
        fs::rename(folder, old, error);
        if (!error) fs::rename(fresh, folder, error);
        std::error_code ignored;
        if (!error) fs::remove_all(old, ignored);
    }
    if (error) {
        throw IoError(
            fmt::format("{} cannot be put in place: {}.", folder.string(), error.message()));
    }
}

}  // namespace kaustik::experiment
