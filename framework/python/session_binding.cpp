// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "framework/core/error.h"
#include "framework/python/bindings.h"
#include "framework/python/scene_source.h"
#include "framework/python/session.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;
using KeepWaiting = WorkThread::ShouldContinue;

std::uint64_t seedOf(long long seed) {
    if (seed < 0) throw ConfigError("seed: must not be negative.");
    return static_cast<std::uint64_t>(seed);
}

Judgement judgementOf(const std::string& reference, long long photons) {
    if (photons < 1)
        throw ConfigError(fmt::format("reference_photons: {} is not above 0.", photons));
    return {reference, static_cast<std::uint64_t>(photons)};
}

std::unique_ptr<Session> openSession(const py::object& scene, const std::string& base,
                                     const std::string& technique, const py::object& size,
                                     const py::dict& settings,
                                     const std::vector<std::string>& disabled,
                                     std::optional<double> time, long long seed, bool precise,
                                     bool debug, const std::string& device, bool isAsPublished) {
    const SceneSource source(scene, base);
    const SessionOptions options{technique,
                                 settingText("size", size),
                                 settingTexts(settings),
                                 disabled,
                                 time,
                                 seedOf(seed),
                                 precise,
                                 debug,
                                 device,
                                 isAsPublished};
    return waitFor([&](const KeepWaiting& keepWaiting) {
        return std::make_unique<Session>([&] { return source.load(); }, options, keepWaiting);
    });
}

// A method without arguments whose result is JSON.
auto asPython(nlohmann::json (Session::*method)(const KeepWaiting&)) {
    return [method](Session& session) {
        return toPython(waitFor(
            [&](const KeepWaiting& keepWaiting) { return (session.*method)(keepWaiting); }));
    };
}

py::object step(Session& session, int frames, std::optional<double> time, double timeStep,
                int warmup) {
    const StepRequest request{frames, warmup, time, timeStep};
    return toPython(waitFor(
        [&](const KeepWaiting& keepWaiting) { return session.step(request, keepWaiting); }));
}

std::shared_ptr<Array> read(Session& session, const std::string& name, std::optional<long> layer) {
    if (layer && *layer < 0)
        throw ConfigError(fmt::format("There is no layer {}; they count from 0.", *layer));
    return waitFor([&](const KeepWaiting& keepWaiting) {
        return std::make_shared<Array>(session.read(
            name, layer ? std::optional<std::size_t>(*layer) : std::nullopt, keepWaiting));
    });
}

void edit(Session& session, const py::dict& changes) {
    const scene::TomlNode document = tomlFrom(changes);
    waitFor([&](const KeepWaiting& keepWaiting) {
        session.edit(
            [&] {
                scene::TableReader top(document, "./", "");
                return readEdits(top);
            },
            keepWaiting);
    });
}

}  // namespace

void bindSession(py::module_& module) {
    py::class_<Session>(module, "Session")
        .def(py::init(&openSession), py::arg("scene"), py::arg("base"), py::arg("technique"),
             py::arg("size"), py::arg("settings"), py::arg("disabled"), py::arg("time"),
             py::arg("seed"), py::arg("precise"), py::arg("debug"), py::arg("device"),
             py::arg("as_published"))
        .def("close",
             [](Session& session) {
                 const py::gil_scoped_release noGil;
                 session.close();
             })
        .def_property_readonly("is_closed", &Session::isClosed)
        .def(
            "set",
            [](Session& session, const py::dict& settings) {
                const auto texts = settingTexts(settings);
                waitFor([&](const KeepWaiting& keepWaiting) { session.set(texts, keepWaiting); });
            },
            py::arg("settings"))
        .def(
            "param",
            [](Session& session, const std::string& name) {
                return toPython(waitFor([&](const KeepWaiting& keepWaiting) {
                    return session.param(name, keepWaiting);
                }));
            },
            py::arg("name"))
        .def("params", asPython(&Session::params))
        .def(
            "disable",
            [](Session& session, const std::vector<std::string>& passes) {
                waitFor(
                    [&](const KeepWaiting& keepWaiting) { session.disable(passes, keepWaiting); });
            },
            py::arg("passes"))
        .def(
            "resize",
            [](Session& session, const py::object& size) {
                const std::string text = settingText("size", size);
                waitFor([&](const KeepWaiting& keepWaiting) { session.resize(text, keepWaiting); });
            },
            py::arg("size"))
        .def(
            "set_seed",
            [](Session& session, long long seed) {
                waitFor([&](const KeepWaiting& keepWaiting) {
                    session.setSeed(seedOf(seed), keepWaiting);
                });
            },
            py::arg("seed"))
        .def("edit", &edit, py::arg("changes"))
        .def("step", &step, py::arg("n"), py::arg("time"), py::arg("time_step"), py::arg("warmup"))
        .def("read", &read, py::arg("name"), py::arg("layer"))
        .def(
            "report",
            [](Session& session, const std::string& reference, long long photons) {
                const Judgement judgement = judgementOf(reference, photons);
                return toPython(waitFor([&](const KeepWaiting& keepWaiting) {
                    return session.report(judgement, keepWaiting);
                }));
            },
            py::arg("reference"), py::arg("reference_photons"))
        .def(
            "save",
            [](Session& session, const fs::path& folder, const std::vector<std::string>& resources,
               const std::string& reference, long long photons) {
                const Judgement judgement = judgementOf(reference, photons);
                return waitFor([&](const KeepWaiting& keepWaiting) {
                    return session.save(folder, resources, judgement, keepWaiting);
                });
            },
            py::arg("folder"), py::arg("resources"), py::arg("reference"),
            py::arg("reference_photons"))
        .def("passes", asPython(&Session::passes))
        .def("resources", asPython(&Session::resources))
        .def("needs", asPython(&Session::needs))
        .def("times", asPython(&Session::times))
        .def("state", asPython(&Session::state))
        .def("explain", [](Session& session) {
            return waitFor(
                [&](const KeepWaiting& keepWaiting) { return session.explain(keepWaiting); });
        });
}

}  // namespace kaustik::python
