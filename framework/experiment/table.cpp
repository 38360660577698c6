// SPDX-License-Identifier: MIT
#include "framework/experiment/table.h"

#include <algorithm>
#include <map>

#include "framework/experiment/run_folder.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;

// The numbers below `value`, by dotted name.
void addNumbers(Row& row, const std::string& name, const json& value) {
    if (value.is_number()) row.emplace_back(name, value);
    if (!value.is_object()) return;
    for (const auto& [key, inner] : value.items())
        addNumbers(row, name + "." + key, inner);
}

// How many maps the light is stored in, and of how many texels, which a list of them says.
void addMaps(Row& row, const json& map) {
    const json maps = map.is_object() ? map.value("maps", json::array()) : json::array();
    long long texels = 0;
    for (const json& one : maps)
        texels += one.at("size").at(0).get<long long>() * one.at("size").at(1).get<long long>() *
                  one.at("views").get<long long>();
    row.emplace_back("map.count", maps.size());
    row.emplace_back("map.side", maps.empty() ? json(0) : maps.front().at("size").at(0));
    row.emplace_back("map.texels", texels);
}

std::string cell(const json& value) {
    if (value.is_null()) return "";
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + "\"";
}

std::vector<std::string> columnsOf(const std::vector<Row>& rows) {
    std::vector<std::string> columns;
    for (const Row& row : rows) {
        auto position = columns.begin();
        for (const auto& [name, value] : row) {
            const auto known = std::find(columns.begin(), columns.end(), name);
            position = known != columns.end() ? known : columns.insert(position, name);
            ++position;
        }
    }
    return columns;
}

}  // namespace

Row identityColumns(const PlannedRun& run, int repeat, const std::string& message) {
    Row row = {{"folder", folderName(run, repeat)},
               {"hash", run.hash},
               {"repeat", repeat},
               {"status", message.empty() ? "done" : "failed"},
               {"message", message}};
    for (const auto& [key, value] : run.axes.items())
        row.emplace_back(key, value);
    return row;
}

Row resultColumns(const json& report) {
    Row row;
    addNumbers(row, "frame_ms", report.value("frame_ms", json()));
    addNumbers(row, "startup_ms", report.value("startup_ms", json()));
    for (const json& pass : report.value("passes", json::array())) {
        if (!pass.value("ran", false) || !pass.contains("gpu_ms")) continue;
        row.emplace_back("pass:" + pass.at("name").get<std::string>(),
                         pass.at("gpu_ms").at("median"));
    }
    for (const char* part :
         {"photons", "cells", "layers", "map", "hits", "error", "energy", "memory"})
        addNumbers(row, part, report.value(part, json()));
    addMaps(row, report.value("map", json()));
    addNumbers(row, "scene.triangles",
               report.value("scene", json::object()).value("triangles", json()));
    row.emplace_back("warnings", report.value("warnings", json::array()).size());
    // Together the model that the times are of: on a software rasteriser it is the processor.
    const json device = report.value("device", json::object());
    row.emplace_back("device", device.value("renderer", ""));
    row.emplace_back("cpu", device.value("cpu", ""));
    row.emplace_back("threads", device.value("threads", json()));
    const json timing = report.value("timing", json::object());
    row.emplace_back("other_processors", timing.value("other_processors", json()));
    row.emplace_back("dropped_frames", timing.value("dropped_frames", json()));
    row.emplace_back("measuring_ms", timing.value("measuring_ms", json()));
    row.emplace_back("of_measured_frame", timing.value("of_measured_frame", json()));
    row.emplace_back("date", timing.value("date", ""));
    row.emplace_back("version", report.value("version", ""));
    return row;
}

std::string toCsv(const std::vector<Row>& rows) {
    const std::vector<std::string> columns = columnsOf(rows);
    std::string csv;
    const auto addLine = [&](const auto& textOf) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (i > 0) csv += ',';
            csv += textOf(columns[i]);
        }
        csv += '\n';
    };
    addLine([](const std::string& column) { return cell(column); });
    for (const Row& row : rows) {
        const std::map<std::string, json> values(row.begin(), row.end());
        addLine([&](const std::string& column) {
            const auto value = values.find(column);
            return value == values.end() ? std::string() : cell(value->second);
        });
    }
    return csv;
}

}  // namespace kaustik::experiment
