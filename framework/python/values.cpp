// SPDX-License-Identifier: MIT
#include "framework/python/values.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;
using nlohmann::json;
using scene::TomlNode;

// As deep as scene files may be.
constexpr int kMaxDepth = 64;

std::string typeName(py::handle value) {
    return py::str(py::type::handle_of(value).attr("__name__"));
}

bool isText(py::handle value) {
    return PyUnicode_Check(value.ptr()) || py::hasattr(value, "__fspath__");
}

std::string textOf(py::handle value) {
    return py::str(py::reinterpret_steal<py::object>(PyOS_FSPath(value.ptr())));
}

// Python's own and NumPy's.
bool isWholeNumber(py::handle value) {
    return PyIndex_Check(value.ptr()) != 0 && !py::hasattr(value, "__len__");
}

bool isNumber(py::handle value) {
    return !isText(value) && !py::hasattr(value, "__len__") && py::hasattr(value, "__float__");
}

bool isTruth(py::handle value) {
    return PyBool_Check(value.ptr()) || typeName(value) == "bool_";
}

// Lists, tuples, arrays; not text.
bool isList(py::handle value) {
    return !isText(value) && !PyBytes_Check(value.ptr()) && !py::isinstance<py::dict>(value) &&
           PySequence_Check(value.ptr()) != 0;
}

std::int64_t wholeNumber(const std::string& name, py::handle value) {
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!index) throw py::error_already_set();
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
    if (overflow != 0)
        throw ConfigError(fmt::format("{}: {} is too large.", name, std::string(py::str(index))));
    return number;
}

double realNumber(py::handle value) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (number == -1.0 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    return number;
}

TomlNode nodeFrom(const std::string& key, py::handle value, int depth);

TomlNode tableFrom(const py::dict& table, const std::string& where, int depth) {
    scene::TomlTable entries;
    for (const auto& [key, value] : table) {
        if (!PyUnicode_Check(key.ptr())) {
            throw ConfigError(fmt::format("the scene: the key {} is a {}; keys are text.",
                                          std::string(py::repr(key)), typeName(key)));
        }
        const std::string name = py::str(key);
        entries.entries.push_back(
            {name, nodeFrom(where.empty() ? name : where + "." + name, value, depth + 1)});
    }
    return {std::move(entries)};
}

TomlNode nodeFrom(const std::string& key, py::handle value, int depth) {
    if (depth > kMaxDepth)
        throw ConfigError(
            fmt::format("the scene: '{}' is nested more than {} deep.", key, kMaxDepth));
    if (isTruth(value)) return {PyObject_IsTrue(value.ptr()) == 1};
    if (isText(value)) return {textOf(value)};
    if (py::isinstance<py::dict>(value))
        return tableFrom(py::reinterpret_borrow<py::dict>(value), key, depth);
    if (isWholeNumber(value)) return {wholeNumber("the scene: '" + key + "'", value)};
    if (isNumber(value)) return {realNumber(value)};
    if (isList(value)) {
        scene::TomlList list;
        for (const py::handle element : value)
            list.elements.push_back(nodeFrom(key, element, depth + 1));
        return {std::move(list)};
    }
    throw ConfigError(fmt::format(
        "the scene: '{}' cannot be a {}; give numbers, text, True or False, lists or dicts{}", key,
        typeName(value), value.is_none() ? ", or leave the key out." : "."));
}

}  // namespace

py::object toPython(const json& value) {
    switch (value.type()) {
        case json::value_t::null:
        case json::value_t::discarded:
            return py::none();
        case json::value_t::boolean:
            return py::bool_(value.get<bool>());
        case json::value_t::number_integer:
            return py::int_(value.get<std::int64_t>());
        case json::value_t::number_unsigned:
            return py::int_(value.get<std::uint64_t>());
        case json::value_t::number_float:
            // As report.json has it: what is no number is null.
            return std::isfinite(value.get<double>()) ? py::object(py::float_(value.get<double>()))
                                                      : py::object(py::none());
        case json::value_t::string: {
            const auto& text = value.get_ref<const std::string&>();
            return py::reinterpret_steal<py::object>(
                PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
        }
        case json::value_t::array: {
            py::list list;
            for (const json& element : value)
                list.append(toPython(element));
            return list;
        }
        case json::value_t::object: {
            py::dict table;
            for (const auto& [key, element] : value.items())
                table[py::str(key)] = toPython(element);
            return table;
        }
        case json::value_t::binary:
            break;
    }
    throw Error("Bytes are no value for Python.", kExitFailed);
}

std::string settingText(const std::string& name, py::handle value) {
    if (isTruth(value)) return PyObject_IsTrue(value.ptr()) == 1 ? "true" : "false";
    if (isText(value)) return textOf(value);
    if (isWholeNumber(value)) return std::to_string(wholeNumber(name, value));
    if (isNumber(value)) return fmt::format("{}", realNumber(value));
    if (isList(value) && py::len(value) == 2) {
        const py::object first = value[py::int_(0)];
        const py::object second = value[py::int_(1)];
        return settingText(name, first) + "x" + settingText(name, second);
    }
    throw ConfigError(
        fmt::format("set: {} cannot be {}; give a number, True or False, text or (width, height).",
                    name, std::string(py::repr(value)).substr(0, 60)));
}

std::map<std::string, std::string> settingTexts(const py::dict& settings) {
    std::map<std::string, std::string> texts;
    for (const auto& [key, value] : settings) {
        if (!PyUnicode_Check(key.ptr())) {
            throw ConfigError(fmt::format("set: the name {} is a {}; names are text.",
                                          std::string(py::repr(key)), typeName(key)));
        }
        const std::string name = py::str(key);
        texts[name] = settingText(name, value);
    }
    return texts;
}

TomlNode tomlFrom(const py::dict& table) {
    return tableFrom(table, "", 0);
}

}  // namespace kaustik::python
