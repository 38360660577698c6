// SPDX-License-Identifier: MIT
#include "framework/core/error.h"

#include "framework/python/bindings.h"
#include "framework/python/work_thread.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;

// Later ones are tried first: what is more special comes after its base.
template <class Cxx>
py::object bindError(py::module_& module, const char* name, py::handle base, const char* doc) {
    py::object type = py::register_exception<Cxx>(module, name, base);
    type.attr("__doc__") = doc;
    type.attr("__module__") = "kaustik";
    return type;
}

}  // namespace

void bindErrors(py::module_& module) {
    const py::object base =
        bindError<Error>(module, "KaustikError", PyExc_Exception,
                         "Whatever goes wrong, in one or two sentences: what, where, what to do.");
    bindError<GraphError>(module, "GraphError", base,
                          "A graph that cannot run: passes and resources do not fit.");
    bindError<ShaderError>(module, "ShaderError", base,
                           "A shader that does not compile; names its file and line.");
    bindError<ConfigError>(module, "ConfigError", base,
                           "A request that makes no sense: an unknown name (the nearest is said), "
                           "a value out of range, a broken scene.");
    bindError<IoError>(module, "IoError", base,
                       "A file that is missing, damaged or cannot be written.");
    bindError<DeviceError>(module, "DeviceError", base,
                           "The device cannot be had, is lost or out of memory.");
    static const py::object stopped = base;
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Stopped&) {
            PyErr_SetString(stopped.ptr(), "The renderer was closed while it was at work.");
        }
    });
}

}  // namespace kaustik::python
