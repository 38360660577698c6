// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "framework/python/bindings.h"
#include "framework/python/session.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"
#include "framework/run/listing.h"

namespace kaustik::python {

namespace py = pybind11;

void bindLists(py::module_& module) {
    module.def("scenes", [] {
        return toPython(
            waitFor([](const WorkThread::ShouldContinue&) { return run::listScenes(); }));
    });
    module.def("techniques", [] { return toPython(run::listTechniques(registry())); });
    module.def(
        "nodes",
        [](const std::string& technique, bool isAsPublished) {
            return toPython(run::listNodes(registry(), technique, isAsPublished));
        },
        py::arg("technique"), py::arg("as_published"));
    module.def(
        "params",
        [](const std::string& technique, bool isAsPublished) {
            return toPython(run::listParams(registry(), technique, isAsPublished));
        },
        py::arg("technique"), py::arg("as_published"));
}

}  // namespace kaustik::python
