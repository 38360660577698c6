// SPDX-License-Identifier: MIT
#include "framework/report/device_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "framework/core/error.h"
#include "framework/core/json_schema.h"

namespace kaustik::report {
namespace {

using nlohmann::json;

double megabytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) * 1e-6;
}

std::optional<double> measuredOf(const std::map<std::string, double>& measured,
                                 const std::string& pass) {
    const auto found = measured.find(pass);
    if (found == measured.end()) return std::nullopt;
    return found->second;
}

struct ResourceTable {
    const gl::PassAccesses::Resource& resource;
};
template <class F>
void reflect(F& f, const ResourceTable& table) {
    f.field("name", table.resource.name, "As the pass' shaders have it");
    f.field("bytes", table.resource.bytes, "All of it");
    f.field("read_bytes", table.resource.readBytes, "Of it that are read");
    f.field("written_bytes", table.resource.writtenBytes, "Of it that are written");
}

struct CostPassTable {
    gl::PassAccesses pass;
    double boundMilliseconds = 0.0;
    std::optional<double> timesBound;
};
template <class F>
void reflect(F& f, const CostPassTable& table) {
    const gl::PassAccesses& pass = table.pass;
    f.field("name", pass.name, "Of the pass");
    f.field("read_bytes", pass.readBytes, "That it reads, each once");
    f.field("written_bytes", pass.writtenBytes, "That it writes, each once");
    f.field("requested_read_bytes", pass.requestedReadBytes, "That its threads ask for");
    f.field("requested_written_bytes", pass.requestedWrittenBytes, "That its threads hand over");
    f.field("atomics", pass.atomics, "On textures and buffers");
    f.field("threads", pass.threads, "Of all its shaders");
    f.field("work_groups", pass.workGroups, "That it dispatches");
    f.field("commands", pass.commands, "Draws and dispatches");
    f.field("barriers", pass.barriers, "Between commands, for memory");
    f.field("read_backs", pass.readBacks, "After which the processor waits for the device");
    f.field("bound_ms", table.boundMilliseconds, "The least time by the memory's bandwidth");
    f.field("times_bound", table.timesBound, "The measured median is so many times as long");
}

struct CostTable {
    double gigabytesPerSecond = 0.0;
    double boundMilliseconds = 0.0;
    std::vector<CostPassTable> passes;
};
template <class F>
void reflect(F& f, const CostTable& table) {
    f.field("bandwidth_gb_s", table.gigabytesPerSecond, "Of the modelled memory, 10⁹ bytes/s");
    f.field("bound_ms", table.boundMilliseconds, "Of the frame: the passes' together");
    f.field("passes", table.passes, "Those that ran");
}

}  // namespace

DeviceModel parseDeviceModel(const std::string& text, const std::string& option) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [unitBegin, error] = std::from_chars(text.data(), end, value);
    std::string unit(unitBegin, end);
    unit.erase(0, unit.find_first_not_of(' '));
    const double factor = unit == "GB/s" ? 1e9 : unit == "TB/s" ? 1e12 : 0.0;
    const DeviceModel model{value * factor};
    // From what a slow disk gives to a hundred times what the fastest memory does.
    if (error != std::errc() || !(model.bytesPerSecond >= 1e8 && model.bytesPerSecond <= 1e15)) {
        throw ConfigError(fmt::format(
            "{}: '{}' is no bandwidth of memory; it is a number from 0.1 to 1000000 and GB/s, or "
            "TB/s, such as 1000GB/s.",
            option, text));
    }
    return model;
}

double boundMilliseconds(const gl::PassAccesses& pass, const DeviceModel& model) {
    return 1e3 * static_cast<double>(pass.readBytes + pass.writtenBytes) / model.bytesPerSecond;
}

double boundMilliseconds(const FrameCost& cost) {
    double sum = 0.0;
    for (const gl::PassAccesses& pass : cost.passes)
        sum += boundMilliseconds(pass, cost.model);
    return sum;
}

std::string costTable(const FrameCost& cost, const std::map<std::string, double>& measured) {
    std::string text = fmt::format(
        "memory of {:g} GB/s: what each pass must move, every byte once, and how long that takes\n"
        "{:<24}{:>10}{:>10}{:>10}{:>10}{:>9}{:>9}{:>6}{:>10}{}\n",
        cost.model.bytesPerSecond / 1e9, "pass", "read MB", "write MB", "asked MB", "atomics",
        "threads", "groups", "bar.", "bound ms", measured.empty() ? "" : "  measured");
    gl::PassAccesses sum;
    for (const gl::PassAccesses& pass : cost.passes) {
        const double bound = boundMilliseconds(pass, cost.model);
        text += fmt::format("{:<24}{:>10.2f}{:>10.2f}{:>10.2f}{:>10}{:>9}{:>9}{:>6}{:>10.4f}",
                            pass.name, megabytes(pass.readBytes), megabytes(pass.writtenBytes),
                            megabytes(pass.requestedReadBytes + pass.requestedWrittenBytes),
                            pass.atomics, pass.threads, pass.workGroups, pass.barriers, bound);
        const std::optional<double> took = measuredOf(measured, pass.name);
        if (took && bound > 0.0) text += fmt::format("  {:.0f} times", *took / bound);
        text += "\n";
        sum.readBytes += pass.readBytes;
        sum.writtenBytes += pass.writtenBytes;
        sum.requestedReadBytes += pass.requestedReadBytes + pass.requestedWrittenBytes;
        sum.atomics += pass.atomics;
        sum.threads += pass.threads;
        sum.workGroups += pass.workGroups;
        sum.barriers += pass.barriers;
        sum.readBacks += pass.readBacks;
    }
    text += fmt::format("{:<24}{:>10.2f}{:>10.2f}{:>10.2f}{:>10}{:>9}{:>9}{:>6}{:>10.4f}\n",
                        "all passes", megabytes(sum.readBytes), megabytes(sum.writtenBytes),
                        megabytes(sum.requestedReadBytes), sum.atomics, sum.threads, sum.workGroups,
                        sum.barriers, boundMilliseconds(cost));
    if (sum.readBacks > 0)
        text += fmt::format("the processor waits for the device {} times in the frame\n",
                            sum.readBacks);
    return text;
}

namespace {

CostTable tableOf(const FrameCost& cost, const std::map<std::string, double>& measured) {
    CostTable table{cost.model.bytesPerSecond / 1e9, boundMilliseconds(cost), {}};
    for (const gl::PassAccesses& pass : cost.passes) {
        CostPassTable& row = table.passes.emplace_back();
        row = {pass, boundMilliseconds(pass, cost.model), {}};
        const std::optional<double> took = measuredOf(measured, pass.name);
        if (took && row.boundMilliseconds > 0.0) row.timesBound = *took / row.boundMilliseconds;
    }
    return table;
}

}  // namespace

json costJson(const FrameCost& cost, const std::map<std::string, double>& measured) {
    return jsonOf(tableOf(cost, measured));
}

json costSchema() {
    return jsonSchemaOf<CostTable>();
}

}  // namespace kaustik::report
