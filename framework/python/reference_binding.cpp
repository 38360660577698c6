// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "framework/core/error.h"
#include "framework/python/bindings.h"

#ifdef KAUSTIK_HAS_EMBREE

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/measure/image_file.h"
#include "framework/params/field.h"
#include "framework/python/array.h"
#include "framework/python/progress.h"
#include "framework/python/scene_source.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"
#include "framework/reference/order.h"
#include "framework/run/reference_work.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;
using namespace reference;

params::Extent pixels(const std::string& text) {
    params::Extent size;
    params::Field{"size", "", "px", &size, 1.0, 16384.0, {}}.set(text, "size", "reference");
    return size;
}

// The name of an argument: caustic_view for caustic-view.
std::string asArgument(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::shared_ptr<Reference> compute(const py::object& scene, const std::string& base,
                                   const py::object& size, std::optional<double> time,
                                   const std::string& estimator, std::optional<long long> photons,
                                   std::optional<double> seconds,
                                   std::optional<double> standardError, long long seed, int threads,
                                   bool transmissionOnly, int interactions, bool causticView,
                                   const std::vector<std::string>& classPatterns, int classes,
                                   bool byObject, const py::object& progress) {
    const SceneSource source(scene, base);
    const params::Extent targetPixels = pixels(settingText("size", size));
    const Order order{.estimator = estimator,
                      .width = targetPixels.width,
                      .height = targetPixels.height,
                      .photons = photons,
                      .seconds = seconds,
                      .relativeError = standardError,
                      .seed = seed,
                      .threads = threads,
                      .transmissionOnly = transmissionOnly,
                      .interactions = interactions,
                      .causticView = causticView,
                      .classes = {classPatterns, classes, byObject}};
    const ReferenceRequest request = requestOf(order, asArgument);
    const RunOptions options = optionsOf(order, asArgument);
    Progress told(progress);
    try {
        return waitFor([&](const WorkThread::ShouldContinue& keepWaiting) {
            std::shared_ptr<Reference> found;
            WorkThread thread;
            thread.run(
                [&](const WorkThread::ShouldContinue& shouldContinue) {
                    scene::Scene loaded = source.load();
                    if (time) scene::setTime(loaded, *time);
                    const run::Watch watch{
                        [&] { return shouldContinue() && !told.hasFailed(); },
                        [&](double share, const std::string& text) { told.tell(share, text); }};
                    const EmbreeScene embree(loaded);
                    ReferenceRequest whole = request;
                    addClasses(
                        embree, order, asArgument,
                        [&](const std::string& text) { told.tell(0.0, text); }, whole);
                    found = std::make_shared<Reference>(
                        run::obtainReference(embree, whole, options, watch));
                },
                keepWaiting);
            return found;
        });
    } catch (const Error&) {
        told.throwIfFailed();
        throw;
    }
}

// None for what the reference does not have.
py::object arrayOf(const Image& image) {
    if (image.values.empty()) return py::none();
    return py::cast(std::make_shared<Array>(image));
}

// The images of classes by their names, in their order.
auto classesOf(Image ClassImages::*image) {
    return [image](const Reference& reference) {
        py::dict images;
        for (const ClassImages& one : reference.classes)
            images[py::str(one.name)] = arrayOf(one.*image);
        return images;
    };
}

// A property that hands out a copy of an image.
auto asArray(Image Reference::*image) {
    return [image](const Reference& reference) { return arrayOf(reference.*image); };
}

py::dict energyOf(const Reference& reference) {
    const auto& watts = reference.energy.watts;
    py::dict energy;
    energy["emitted_w"] = watts[transport::kAccountEmitted];
    energy["deposited_w"] = watts[transport::kAccountDeposited];
    energy["visible_w"] = reference.energy.visibleWatts;
    energy["balance"] = reference.energy.balance();
    return energy;
}

void save(const Reference& reference, const std::filesystem::path& file) {
    const std::string extension = measure::lowerExtension(file);
    if (extension != ".exr" && extension != ".pfm")
        throw ConfigError(fmt::format("save: {} must end in .exr or .pfm.", file.string()));
    waitFor([&](const WorkThread::ShouldContinue&) { writeReference(file, reference); });
}

}  // namespace

void bindReference(py::module_& module) {
    py::class_<Reference, std::shared_ptr<Reference>> type(module, "Reference", R"(
A ray-traced reference: images with the standard error of every pixel, height x width x channels.

Irradiance in W/m2, radiance in W/m2/sr, linear Rec.709.
)");
    type.attr("__module__") = "kaustik";
    type.def_property_readonly("irradiance", asArray(&Reference::irradiance),
                               "Caustic irradiance at the first receiver, H x W x 3, W/m2.")
        .def_property_readonly("standard_error", asArray(&Reference::irradianceError),
                               "Of the irradiance, one standard deviation, H x W x 3, W/m2.")
        .def_property_readonly("caustic_radiance", asArray(&Reference::causticRadiance),
                               "H x W x 3, W/m2/sr; None where no receiver is glossy.")
        .def_property_readonly("caustic_view", asArray(&Reference::causticView),
                               "As seen through specular surfaces, H x W x 3; None unless asked "
                               "for.")
        .def_property_readonly("in_scattered", asArray(&Reference::inScattered),
                               "H x W x 3, W/m2/sr; None without a medium that scatters.")
        .def_property_readonly("classes", classesOf(&ClassImages::irradiance),
                               "Irradiance of the classes of paths that were kept apart, by name, "
                               "and of `other`: H x W x 3, W/m2 each; together the irradiance.")
        .def_property_readonly("class_errors", classesOf(&ClassImages::irradianceError),
                               "Their standard errors.")
        .def_property_readonly(
            "photons", [](const Reference& reference) { return reference.photons; },
            "How many photons were traced.")
        .def_property_readonly(
            "relative_error",
            [](const Reference& reference) -> std::optional<double> {
                if (!std::isfinite(reference.relativeError)) return std::nullopt;
                return reference.relativeError;
            },
            "Standard error over the mean of a lit pixel; None where no pixel is lit.")
        .def_property_readonly(
            "seconds", [](const Reference& reference) { return reference.seconds; },
            "How long it was computed, s.")
        .def_property_readonly("energy", &energyOf,
                               "Watts: emitted_w, deposited_w, visible_w; and their balance.")
        .def_property_readonly(
            "scene", [](const Reference& reference) { return reference.scene; },
            "The scene's name.")
        .def("save", &save, py::arg("file"),
             "Writes FILE (.exr or .pfm), its standard error and a .json beside it, as `kaustik "
             "reference` does.")
        .def("__repr__", [](const Reference& reference) {
            return fmt::format("kaustik.Reference({}, {}x{}, {} photons)", reference.scene,
                               reference.request.width, reference.request.height,
                               reference.photons);
        });
    module.def("reference", &compute, py::arg("scene"), py::arg("base"), py::arg("size"),
               py::arg("time"), py::arg("estimator"), py::arg("photons"), py::arg("seconds"),
               py::arg("error"), py::arg("seed"), py::arg("threads"), py::arg("transmission_only"),
               py::arg("interactions"), py::arg("caustic_view"), py::arg("class_patterns"),
               py::arg("classes"), py::arg("by_object"), py::arg("progress"));
    module.def(
        "read_reference",
        [](const std::filesystem::path& file) {
            return std::make_shared<Reference>(readReference(file));
        },
        py::arg("file"));
}

}  // namespace kaustik::python

#else

namespace kaustik::python {

namespace {
struct Reference {};
}  // namespace

void bindReference(pybind11::module_& module) {
    pybind11::class_<Reference>(module, "Reference", "Not in this build, which has no Embree.");
    for (const char* name : {"reference", "read_reference"}) {
        module.def(name, [](const pybind11::args&, const pybind11::kwargs&) {
            throw ConfigError("This module was built without Embree and has no references.");
        });
    }
}

}  // namespace kaustik::python

#endif
