// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/exporters/export.h"
#include "framework/measure/image_file.h"
#include "framework/params/field.h"
#include "framework/python/array.h"
#include "framework/python/bindings.h"
#include "framework/python/scene_source.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"
#include "framework/run/judge_work.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;

params::Extent pixels(const py::object& size) {
    params::Extent extent;
    params::Field{"size", "", "px", &extent, 1.0, 16384.0, {}}.set(settingText("size", size),
                                                                   "size", "size");
    return extent;
}

bool isFile(const py::object& value) {
    return PyUnicode_Check(value.ptr()) || py::hasattr(value, "__fspath__");
}

py::tuple judgeTheirs(const py::object& scene, const std::string& base, const py::object& theirs,
                      const py::object& size, const std::string& direct, const std::string& glass,
                      const std::string& encoding, const std::string& primaries,
                      std::optional<double> exposure, const py::object& standardError,
                      long long photons, long long seed, int classes, bool causes) {
    const SceneSource source(scene, base);
    const std::string name = isFile(theirs) ? settingText("theirs", theirs) : "The picture";
    if (isFile(theirs) && measure::isDisplayPicture(name)) {
        throw ConfigError(
            fmt::format("{} was made for a display; save linear light as .exr or .pfm.", name));
    }
    const judge::JudgeOptions options =
        judge::optionsOf({direct, glass, encoding, primaries, exposure},
                         [](const std::string& word) { return word; });
    if (classes < 1 || classes > 32)
        throw ConfigError(fmt::format("classes: {} is not from 1 to 32.", classes));
    const Image picture = imageFrom(theirs, "theirs");
    run::requireNumbers(picture, name);
    Image error;
    if (!standardError.is_none()) error = imageFrom(standardError, "standard_error");
    if (!standardError.is_none() &&
        (error.width != picture.width || error.height != picture.height))
        throw ConfigError("standard_error and theirs are not of the same size.");
    run::JudgedScene request;
    request.width = picture.width;
    request.height = picture.height;
    if (!size.is_none()) {
        const params::Extent extent = pixels(size);
        request.width = extent.width;
        request.height = extent.height;
    }
    request.photons = photons;
    request.seed = seed;
    request.classes = classes;
    request.causes = causes;
    const judge::Verdict verdict = waitFor([&](const WorkThread::ShouldContinue& keepWaiting) {
        judge::Verdict found;
        WorkThread thread;
        thread.run(
            [&](const WorkThread::ShouldContinue& shouldContinue) {
                const run::Watch watch{shouldContinue, [](double, const std::string&) {}};
                judge::Subject subject = run::subjectOf(source.load(), request, &watch);
                subject.theirsName = name;
                subject.theirs = picture;
                subject.theirsError = error;
                found = judge::judge(subject, options);
            },
            keepWaiting);
        return found;
    });
    auto where = std::make_shared<Array>(judge::whereOf(verdict));
    where->isForDisplay = true;
    return py::make_tuple(toPython(judge::toJson(verdict)), judge::toText(verdict),
                          std::make_shared<Array>(verdict.residual), where);
}

py::dict exportTo(const py::object& scene, const std::string& base, const std::string& format,
                  const std::filesystem::path& out, const py::object& size, long long photons) {
    const SceneSource source(scene, base);
    const params::Extent extent = pixels(size);
    const exporters::ExportRequest request{exporters::formatOf(format), out, extent.width,
                                           extent.height, photons};
    const exporters::ExportedScene written = waitFor([&](const WorkThread::ShouldContinue&) {
        return exporters::exportScene(source.load(), request);
    });
    py::list notes;
    for (const exporters::ExportNote& note : written.notes)
        notes.append(exporters::sentenceOf(note));
    py::dict result;
    result["scene_file"] = written.sceneFile.string();
    result["render_command"] = written.renderCommand;
    result["notes"] = notes;
    return result;
}

}  // namespace

void bindJudge(py::module_& module) {
    module.def("judge", &judgeTheirs, py::arg("scene"), py::arg("base"), py::arg("theirs"),
               py::arg("size"), py::arg("direct"), py::arg("glass"), py::arg("encoding"),
               py::arg("primaries"), py::arg("exposure"), py::arg("standard_error"),
               py::arg("photons"), py::arg("seed"), py::arg("classes"), py::arg("causes"));
    module.def("export", &exportTo, py::arg("scene"), py::arg("base"), py::arg("to"),
               py::arg("out"), py::arg("size"), py::arg("photons"));
}

}  // namespace kaustik::python
