// SPDX-License-Identifier: MIT
// Images that Python hands in, wherever their memory is from.
#include <dlpack/dlpack.h>
#include <fmt/format.h>

#include <cstring>
#include <vector>

#include "framework/core/error.h"
#include "framework/measure/image_file.h"
#include "framework/python/array.h"
#include "framework/python/values.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;

enum class Number { float32, float64, other };

// Memory of somebody else's, as it lies there.
struct Memory {
    const char* data = nullptr;
    Number number = Number::other;
    std::vector<std::int64_t> shape;
    std::vector<std::int64_t> strides;  // bytes
};

Memory memoryOf(const py::buffer_info& buffer) {
    const char kind = buffer.format.empty() ? '?' : buffer.format.back();
    return {static_cast<const char*>(buffer.ptr),
            kind == 'f'   ? Number::float32
            : kind == 'd' ? Number::float64
                          : Number::other,
            {buffer.shape.begin(), buffer.shape.end()},
            {buffer.strides.begin(), buffer.strides.end()}};
}

Memory memoryOf(const DLTensor& tensor) {
    Memory memory;
    memory.data = static_cast<const char*>(tensor.data) + tensor.byte_offset;
    const bool isFloat = tensor.dtype.code == kDLFloat && tensor.dtype.lanes == 1;
    if (isFloat && tensor.dtype.bits == 32) memory.number = Number::float32;
    if (isFloat && tensor.dtype.bits == 64) memory.number = Number::float64;
    memory.shape.assign(tensor.shape, tensor.shape + tensor.ndim);
    memory.strides.assign(memory.shape.size(), tensor.dtype.bits / 8);
    for (std::size_t i = memory.shape.size(); i-- > 0;) {
        if (tensor.strides != nullptr) {
            memory.strides[i] = tensor.strides[i] * (tensor.dtype.bits / 8);
        } else if (i + 1 < memory.shape.size()) {
            memory.strides[i] = memory.strides[i + 1] * memory.shape[i + 1];
        }
    }
    return memory;
}

Image copyOf(const Memory& memory, const std::string& name) {
    if (memory.number == Number::other) {
        throw ConfigError(
            fmt::format("{}: an image is of 32-bit or 64-bit floats; convert it first.", name));
    }
    const bool isGrey = memory.shape.size() == 2;
    const bool fits = (isGrey || memory.shape.size() == 3) && memory.shape[0] > 0 &&
                      memory.shape[1] > 0 && memory.shape[0] <= 65536 && memory.shape[1] <= 65536 &&
                      (isGrey || (memory.shape[2] >= 1 && memory.shape[2] <= 4));
    if (!fits) {
        throw ConfigError(fmt::format(
            "{}: an image is height x width or height x width x 1 to 4 channels, not {}.", name,
            fmt::join(memory.shape, " x ")));
    }
    Image image(static_cast<int>(memory.shape[1]), static_cast<int>(memory.shape[0]),
                isGrey ? 1 : static_cast<int>(memory.shape[2]));
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                const char* const place = memory.data + y * memory.strides[0] +
                                          x * memory.strides[1] +
                                          (isGrey ? 0 : c * memory.strides[2]);
                if (memory.number == Number::float32) {
                    std::memcpy(&image.at(x, y, c), place, sizeof(float));
                } else {
                    double value = 0.0;
                    std::memcpy(&value, place, sizeof(double));
                    image.at(x, y, c) = static_cast<float>(value);
                }
            }
        }
    }
    return image;
}

Image takeDlpack(py::handle value, const std::string& name) {
    if (py::hasattr(value, "__dlpack_device__") &&
        value.attr("__dlpack_device__")().cast<py::tuple>()[0].cast<int>() != kDLCPU) {
        throw ConfigError(
            fmt::format("{}: this array is in a GPU's memory; copy it to the CPU's first.", name));
    }
    const auto capsule = value.attr("__dlpack__")().cast<py::capsule>();
    auto* const managed =
        static_cast<DLManagedTensor*>(PyCapsule_GetPointer(capsule.ptr(), "dltensor"));
    if (managed == nullptr) throw py::error_already_set();
    return copyOf(memoryOf(managed->dl_tensor), name);  // the capsule frees what it was not rid of
}

}  // namespace

Image imageFrom(py::handle value, const std::string& name) {
    if (PyUnicode_Check(value.ptr()) || py::hasattr(value, "__fspath__"))
        return measure::readLinear(settingText(name, value));
    if (PyObject_CheckBuffer(value.ptr()) != 0)
        return copyOf(memoryOf(py::reinterpret_borrow<py::buffer>(value).request()), name);
    if (py::hasattr(value, "__dlpack__")) return takeDlpack(value, name);
    throw ConfigError(
        fmt::format("{}: an image is an array or a file, not a {}.", name,
                    std::string(py::str(py::type::handle_of(value).attr("__name__")))));
}

}  // namespace kaustik::python
