// SPDX-License-Identifier: MIT
// The parts of the module kaustik._kaustik, one file each.
#pragma once

#include <pybind11/pybind11.h>

namespace kaustik::python {

void bindErrors(pybind11::module_& module);
void bindArray(pybind11::module_& module);
void bindSession(pybind11::module_& module);
void bindLists(pybind11::module_& module);
void bindReference(pybind11::module_& module);
void bindCompare(pybind11::module_& module);
void bindCertify(pybind11::module_& module);
void bindJudge(pybind11::module_& module);

}  // namespace kaustik::python
