// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "framework/certify/certificate.h"
#include "framework/certify/verdict.h"
#include "framework/core/error.h"
#include "framework/params/field.h"
#include "framework/python/array.h"
#include "framework/python/bindings.h"
#include "framework/python/progress.h"
#include "framework/python/scene_source.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;
using namespace certify;

py::dict certifyScene(const py::object& scene, const std::string& base, const py::object& size,
                      std::optional<double> time, int interactions, bool transmissionOnly,
                      double band, int depth, int threads, const py::object& image,
                      const py::object& progress) {
    const SceneSource source(scene, base);
    params::Extent pixels;
    params::Field{"size", "", "px", &pixels, 1.0, 16384.0, {}}.set(settingText("size", size),
                                                                   "size", "size");
    if (threads < 0 || threads > 1024)
        throw ConfigError("threads: " + std::to_string(threads) + " is not from 0 to 1024.");
    CertificateRequest request;
    request.width = pixels.width;
    request.height = pixels.height;
    request.beams.interactions = interactions;
    request.beams.transmissionOnly = transmissionOnly;
    request.beams.bandPixels = band;
    request.beams.maxDepth = depth;
    Image judged;
    if (!image.is_none()) {
        judged = imageFrom(image, "image");
        if (judged.width != request.width || judged.height != request.height)
            throw ConfigError("image is not of the certificate's size.");
    }
    Progress told(progress);
    Certificate found;
    try {
        found = waitFor([&](const WorkThread::ShouldContinue& keepWaiting) {
            Certificate made;
            WorkThread thread;
            thread.run(
                [&](const WorkThread::ShouldContinue& shouldContinue) {
                    scene::Scene loaded = source.load();
                    if (time) scene::setTime(loaded, *time);
                    CertifyOptions options;
                    options.threads = threads;
                    options.progress = [&](double share, std::uint64_t cells) {
                        told.tell(share, std::to_string(cells) + " cells");
                        return shouldContinue() && !told.hasFailed();
                    };
                    const CertificatePart part = certifyPart(loaded, request, options);
                    if (!part.isWhole()) throw Error("Interrupted.", kExitFailed);
                    made = makeCertificate(loaded, {part});
                },
                keepWaiting);
            return made;
        });
    } catch (const Error&) {
        told.throwIfFailed();
        throw;
    }
    py::dict result = toPython(toJson(found)).cast<py::dict>();
    result["lower"] = std::make_shared<Array>(found.lower);
    result["upper"] = std::make_shared<Array>(found.upper);
    result["undecided"] = std::make_shared<Array>(found.undecided);
    if (!image.is_none()) {
        result["verdict"] = toPython(toJson(judge(judged, found)));
        auto where = std::make_shared<Array>(verdictPicture(judged, found));
        where->isForDisplay = true;
        result["where"] = where;
    }
    return result;
}

}  // namespace

void bindCertify(py::module_& module) {
    module.def("certify", &certifyScene, py::arg("scene"), py::arg("base"), py::arg("size"),
               py::arg("time"), py::arg("interactions"), py::arg("transmission_only"),
               py::arg("band"), py::arg("depth"), py::arg("threads"), py::arg("image"),
               py::arg("progress"));
}

}  // namespace kaustik::python
