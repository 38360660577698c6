// SPDX-License-Identifier: MIT
// kaustik._kaustik: what the Python package kaustik is made of. Nothing in it is for users; their
// names, docstrings and defaults are the package's.
#include <chrono>
#include <thread>

#include "framework/core/files.h"
#include "framework/python/bindings.h"
#include "framework/python/waiting.h"

namespace kaustik::python {
namespace {

// A thread that came back from its work after Python has gone would be ended in the middle of it.
void endWaits() {
    waits().ending = std::this_thread::get_id();
    waits().isEndRequested = true;
    const pybind11::gil_scoped_release noGil;
    while (waits().count > 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace
}  // namespace kaustik::python

PYBIND11_MODULE(_kaustik, module) {
    using namespace kaustik::python;
    module.attr("__version__") = kaustik::versionString();
    module.def("program", [] { return (kaustik::programFolder() / "kaustik").string(); });
    module.def("end_waits", &endWaits);
    bindErrors(module);
    bindArray(module);
    bindLists(module);
    bindSession(module);
    bindReference(module);
    bindCompare(module);
    bindCertify(module);
    bindJudge(module);
}
