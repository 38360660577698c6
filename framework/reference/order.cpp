// SPDX-License-Identifier: MIT
#include "framework/reference/order.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik::reference {
namespace {

Estimator estimatorOf(const Order& order, const Spelling& spelled) {
    if (order.estimator == "light") return Estimator::light;
    if (order.estimator == "sppm") return Estimator::sppm;
    throw ConfigError(
        fmt::format("{}: '{}' is neither light nor sppm.", spelled("estimator"), order.estimator));
}

void requireWithin(const std::string& name, int value, int minimum, int maximum) {
    if (value < minimum || value > maximum)
        throw ConfigError(
            fmt::format("{}: {} is not from {} to {}.", name, value, minimum, maximum));
}

void requireAboveZero(const std::string& name, double value) {
    if (!(value > 0.0)) throw ConfigError(fmt::format("{}: must be above 0.", name));
}

}  // namespace

ReferenceRequest requestOf(const Order& order, const Spelling& spelled) {
    ReferenceRequest request;
    request.estimator = estimatorOf(order, spelled);
    request.width = order.width;
    request.height = order.height;
    if (order.seed < 0)
        throw ConfigError(fmt::format("{}: must not be negative.", spelled("seed")));
    request.seed = static_cast<std::uint64_t>(order.seed);
    request.filter.transmissionOnly = order.transmissionOnly;
    requireWithin(spelled("interactions"), order.interactions, 1, 1000);
    request.filter.maximumInteractions = order.interactions;
    request.causticView = order.causticView;
    if (order.classes.byObject && order.classes.count == 0) {
        throw ConfigError(
            fmt::format("{}: says how the classes of {} are chosen; give their number.",
                        spelled("by-object"), spelled("classes")));
    }
    if (request.causticView && request.estimator != Estimator::sppm) {
        throw ConfigError(fmt::format("{}: only {} sppm sees through specular surfaces.",
                                      spelled("caustic-view"), spelled("estimator")));
    }
    return request;
}

RunOptions optionsOf(const Order& order, const Spelling& spelled) {
    RunOptions options;
    if (order.photons) {
        requireAboveZero(spelled("photons"), static_cast<double>(*order.photons));
        options.stop.photons = static_cast<std::uint64_t>(*order.photons);
    }
    if (order.seconds) {
        requireAboveZero(spelled("seconds"), *order.seconds);
        options.stop.seconds = order.seconds;
    }
    if (order.relativeError) {
        requireAboveZero(spelled("error"), *order.relativeError);
        options.stop.relativeError = order.relativeError;
    }
    if (!order.photons && !order.seconds && !order.relativeError)
        options.stop.photons = static_cast<std::uint64_t>(kUsualPhotons);
    requireWithin(spelled("threads"), order.threads, 0, 1024);
    options.threads = order.threads;
    return options;
}

void addClasses(const EmbreeScene& scene, const Order& order, const Spelling& spelled,
                const std::function<void(const std::string&)>& report, ReferenceRequest& request) {
    if (order.classes.isEmpty()) return;
    request.classes =
        chooseClasses(scene, request, order.classes, spelled("class"), spelled("classes"));
    if (request.classes.empty()) {
        throw ConfigError(fmt::format(
            "{}: no caustic light arrives anywhere in this scene, so there are no classes of it.",
            spelled("classes")));
    }
    std::vector<std::string> names;
    for (const PathClass& one : request.classes)
        names.push_back(one.name);
    names.emplace_back(kOtherClass);
    const std::uint64_t bytes = bytesOfSums(scene, request, order.threads);
    const auto machineBytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                              static_cast<std::uint64_t>(::sysconf(_SC_PAGE_SIZE));
    const auto mebibytes = [](std::uint64_t count) {
        return static_cast<double>(count) / (1024.0 * 1024.0);
    };
    if (bytes > machineBytes) {
        throw ConfigError(
            fmt::format("{}: {} classes of {}x{} pixels take {:.0f} MiB, and this "
                        "machine has {:.0f} MiB; keep fewer apart.",
                        spelled("classes"), names.size(), request.width, request.height,
                        mebibytes(bytes), mebibytes(machineBytes)));
    }
    report(fmt::format("classes {}: {:.0f} MiB of memory", joinNames(names), mebibytes(bytes)));
}

}  // namespace kaustik::reference
