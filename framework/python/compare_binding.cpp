// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "framework/core/error.h"
#include "framework/measure/heat_map.h"
#include "framework/measure/image_errors.h"
#include "framework/measure/image_file.h"
#include "framework/python/array.h"
#include "framework/python/bindings.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;

// An image, and what messages call it: its file or what the argument is called.
struct Input {
    Input(py::handle value, const std::string& argument)
        : name(PyUnicode_Check(value.ptr()) || py::hasattr(value, "__fspath__")
                   ? settingText(argument, value)
                   : "The " + argument),
          isFile(name != "The " + argument),
          image(imageFrom(value, argument)) {}

    static std::optional<Input> optional(py::handle value, const std::string& argument) {
        if (value.is_none()) return std::nullopt;
        return Input(value, argument);
    }

    [[nodiscard]] bool isPicture() const { return isFile && measure::isDisplayPicture(name); }

    std::string name;
    bool isFile;
    Image image;
};

struct Comparison {
    nlohmann::json errors;
    std::shared_ptr<Array> heatMap;
};

Comparison compareInputs(const Input& image, const Input& reference,
                         const std::optional<Input>& mask,
                         const std::optional<Input>& standardError,
                         const std::optional<Input>& area, double pixelsPerDegree) {
    const auto imageOf = [](const std::optional<Input>& input) {
        return input ? &input->image : nullptr;
    };
    const auto nameOf = [](const std::optional<Input>& input) { return input ? input->name : ""; };
    const measure::ImagePair pair({.image = image.image,
                                   .reference = reference.image,
                                   .mask = imageOf(mask),
                                   .standardError = imageOf(standardError),
                                   .area = imageOf(area),
                                   .imageName = image.name,
                                   .referenceName = reference.name,
                                   .maskName = nameOf(mask),
                                   .standardErrorName = nameOf(standardError),
                                   .areaName = nameOf(area)});
    measure::MeasureParams params;
    params.pixelsPerDegree = pixelsPerDegree;
    if (reference.isPicture()) params.displayWhite = 1.0;
    const measure::ImageErrors errors = measure::measureErrors(pair, params);
    const measure::Plane<float> differences = measure::absoluteErrorPlane(pair);
    auto heatMap = std::make_shared<Array>(
        measure::heatMap(pair, differences, measure::heatMapScale(errors, differences)));
    heatMap->isForDisplay = true;
    return {measure::toJson(errors), std::move(heatMap)};
}

py::tuple compare(const py::object& image, const py::object& reference, const py::object& mask,
                  const py::object& standardError, const py::object& area,
                  std::optional<double> pixelsPerDegree) {
    if (pixelsPerDegree && !(*pixelsPerDegree > 0.0 && *pixelsPerDegree <= 1e4)) {
        throw ConfigError(fmt::format("pixels_per_degree: {} is not above 0 and at most 10000.",
                                      *pixelsPerDegree));
    }
    const Input imageInput(image, "image");
    const Input referenceInput(reference, "reference");
    if (imageInput.isFile && referenceInput.isFile &&
        imageInput.isPicture() != referenceInput.isPicture()) {
        throw ConfigError(fmt::format(
            "{} and {} cannot be compared: one was made for a display and the other holds linear "
            "light.",
            imageInput.name, referenceInput.name));
    }
    const auto maskInput = Input::optional(mask, "mask");
    const auto errorInput = Input::optional(standardError, "standard error");
    const auto areaInput = Input::optional(area, "area");
    const Comparison found = waitFor([&](const WorkThread::ShouldContinue&) {
        return compareInputs(imageInput, referenceInput, maskInput, errorInput, areaInput,
                             pixelsPerDegree.value_or(measure::kFlipPixelsPerDegree));
    });
    return py::make_tuple(toPython(found.errors), found.heatMap);
}

}  // namespace

void bindCompare(py::module_& module) {
    module.def("compare", &compare, py::arg("image"), py::arg("reference"), py::arg("mask"),
               py::arg("standard_error"), py::arg("area"), py::arg("pixels_per_degree"));
}

}  // namespace kaustik::python
