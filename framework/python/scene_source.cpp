// SPDX-License-Identifier: MIT
#include "framework/python/scene_source.h"

#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/python/values.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::python {

namespace py = pybind11;

SceneSource::SceneSource(py::handle scene, const std::string& base)
    : base_(std::filesystem::path(base.empty() ? "." : base) / "") {
    if (py::isinstance<py::dict>(scene)) {
        table_ = tomlFrom(py::reinterpret_borrow<py::dict>(scene));
    } else if (PyUnicode_Check(scene.ptr()) || py::hasattr(scene, "__fspath__")) {
        nameOrPath_ = settingText("scene", scene);
    } else {
        throw ConfigError(
            fmt::format("A scene is a name, a path or a dict, not a {}.",
                        std::string(py::str(py::type::handle_of(scene).attr("__name__")))));
    }
}

scene::Scene SceneSource::load() const {
    if (!table_) return scene::loadScene(nameOrPath_);
    reading::ReaderProcess process;
    return scene::makeScene(*table_, base_, process);
}

}  // namespace kaustik::python
