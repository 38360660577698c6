// SPDX-License-Identifier: MIT
// Arrays without NumPy: the buffer protocol, __array_interface__ and DLPack hand the memory on
// without a copy to whoever has it.
#include <dlpack/dlpack.h>
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>

#include "framework/core/error.h"
#include "framework/image/eight_bits.h"
#include "framework/measure/image_file.h"
#include "framework/python/array.h"
#include "framework/python/bindings.h"
#include "framework/python/waiting.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;
using Holder = std::shared_ptr<Array>;

py::tuple shapeOf(const Array& array) {
    py::tuple shape(array.shape.size());
    for (std::size_t i = 0; i < array.shape.size(); ++i)
        shape[i] = array.shape[i];
    return shape;
}

py::buffer_info bufferOf(Array& array) {
    std::vector<py::ssize_t> shape(array.shape.begin(), array.shape.end());
    std::vector<py::ssize_t> strides(shape.size(), sizeof(float));
    for (std::size_t i = shape.size() - 1; i > 0; --i)
        strides[i - 1] = strides[i] * shape[i];
    return {array.values.data(),
            sizeof(float),
            py::format_descriptor<float>::format(),
            static_cast<py::ssize_t>(shape.size()),
            std::move(shape),
            std::move(strides)};
}

py::dict arrayInterface(Array& array) {
    py::dict interface;
    interface["version"] = 3;
    interface["typestr"] = "<f4";
    interface["shape"] = shapeOf(array);
    interface["data"] =
        py::make_tuple(reinterpret_cast<std::uintptr_t>(array.values.data()), false);
    return interface;
}

// Keeps the array for as long as its memory is used.
struct Tensor {
    DLManagedTensor managed{};
    Holder array;
    std::vector<std::int64_t> shape;
};

constexpr const char* kFreshTensor = "dltensor";  // "used_dltensor" once somebody has taken it

py::object toDlpack(const Holder& array, const py::object& stream, const py::object& device,
                    bool copies) {
    const auto refuse = [](const char* message) {
        PyErr_SetString(PyExc_BufferError, message);
        throw py::error_already_set();
    };
    if (!stream.is_none()) refuse("This array is in the memory of the CPU, which has no streams.");
    if (!device.is_none() && !device.equal(py::make_tuple(int(kDLCPU), 0)))
        refuse("This array is in the memory of the CPU, and is handed on there only.");
    auto tensor = std::make_unique<Tensor>();
    tensor->array = copies ? std::make_shared<Array>(*array) : array;
    tensor->shape.assign(array->shape.begin(), array->shape.end());
    DLTensor& described = tensor->managed.dl_tensor;
    described.data = tensor->array->values.data();
    described.device = {kDLCPU, 0};
    described.ndim = static_cast<int>(tensor->shape.size());
    described.dtype = {kDLFloat, 32, 1};
    described.shape = tensor->shape.data();
    tensor->managed.manager_ctx = tensor.get();
    tensor->managed.deleter = [](DLManagedTensor* self) {
        delete static_cast<Tensor*>(self->manager_ctx);
    };
    PyObject* capsule = PyCapsule_New(&tensor->managed, kFreshTensor, [](PyObject* self) {
        if (!PyCapsule_IsValid(self, kFreshTensor)) return;
        auto* managed = static_cast<DLManagedTensor*>(PyCapsule_GetPointer(self, kFreshTensor));
        managed->deleter(managed);
    });
    if (capsule == nullptr) throw py::error_already_set();
    static_cast<void>(tensor.release());
    return py::reinterpret_steal<py::object>(capsule);
}

// One value by all of its indices; negative ones count from the end.
float valueAt(const Array& array, const py::tuple& indices) {
    if (indices.size() != array.shape.size()) {
        throw py::index_error(fmt::format(
            "an index of this array is {}; NumPy slices it: numpy.asarray(array)",
            array.shape.size() == 4 ? "[layer, row, column, channel]" : "[row, column, channel]"));
    }
    std::size_t place = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto size = static_cast<py::ssize_t>(array.shape[i]);
        const auto index = indices[i].cast<py::ssize_t>();
        const py::ssize_t fromStart = index < 0 ? index + size : index;
        if (fromStart < 0 || fromStart >= size)
            throw py::index_error(fmt::format("index {} is not from 0 to {}", index, size - 1));
        place = place * array.shape[i] + static_cast<std::size_t>(fromStart);
    }
    return array.values[place];
}

void save(const Array& array, const std::filesystem::path& file) {
    const std::string extension = measure::lowerExtension(file);
    const bool isPicture = extension == ".png" || extension == ".ppm";
    if (!isPicture && extension != ".exr" && extension != ".pfm") {
        throw ConfigError(
            fmt::format("save: {} must end in .exr, .pfm, .png or .ppm.", file.string()));
    }
    if (array.layers() > 1) {
        throw ConfigError(fmt::format(
            "save: this array has {} layers, and a file has one; read(name, layer=0) gives one.",
            array.layers()));
    }
    waitFor([&](const WorkThread::ShouldContinue&) {
        writeImage(file, isPicture ? previewOf(array, 0).image : array.layer(0));
    });
}

}  // namespace

void bindArray(py::module_& module) {
    py::class_<Array, Holder> type(module, "Array", py::buffer_protocol(), R"(
Values of a picture or a texture: 32-bit floats, height x width x channels, rows from the top.

A texture of several layers has them first: layers x height x width x channels. NumPy takes the
memory as it is with numpy.asarray(array), others with from_dlpack(array) or memoryview(array).
array[row, column, channel] is one value.
)");
    type.attr("__module__") = "kaustik";
    type.def_buffer(&bufferOf)
        .def_property_readonly("shape", &shapeOf, "(height, width, channels), layers first if any.")
        .def_property_readonly(
            "ndim", [](const Array& array) { return array.shape.size(); }, "3, with layers 4.")
        .def_property_readonly(
            "dtype", [](const Array&) { return "float32"; }, "\"float32\".")
        .def_property_readonly(
            "nbytes", [](const Array& array) { return array.values.size() * sizeof(float); },
            "Bytes of all values.")
        .def_property_readonly("__array_interface__", &arrayInterface)
        .def("__dlpack_device__", [](const Array&) { return py::make_tuple(int(kDLCPU), 0); })
        .def(
            "__dlpack__",
            [](const Holder& array, const py::object& stream, const py::object&,
               const py::object& device,
               std::optional<bool> copy) { return toDlpack(array, stream, device, copy == true); },
            py::kw_only(), py::arg("stream") = py::none(), py::arg("max_version") = py::none(),
            py::arg("dl_device") = py::none(), py::arg("copy") = py::none())
        .def("__len__", [](const Array& array) { return array.shape.front(); })
        .def("__getitem__", &valueAt, py::arg("index"))
        .def("save", &save, py::arg("file"),
             "Writes a file, whole or not at all: .exr or .pfm as it is, .png or .ppm as a picture "
             "for people.")
        .def("__repr__",
             [](const Array& array) {
                 return fmt::format("kaustik.Array(shape={}, dtype=float32)",
                                    std::string(py::str(shapeOf(array))));
             })
        .def(
            "_preview",
            [](const Array& array) {
                const Preview preview = previewOf(array, 0);
                const std::vector<unsigned char> bytes = toEightBits(preview.image);
                return py::make_tuple(
                    preview.image.width, preview.image.height,
                    py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                    preview.white);
            },
            "(width, height, RGB bytes, the value that became white) of the first layer.");
}

}  // namespace kaustik::python
