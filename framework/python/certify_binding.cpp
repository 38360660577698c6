// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "framework/certify/certificate.h"
#include "framework/certify/verdict.h"
#include "framework/core/error.h"
#include "framework/core/shard.h"
#include "framework/params/field.h"
#include "framework/python/array.h"
#include "framework/python/bindings.h"
#include "framework/python/progress.h"
#include "framework/python/scene_source.h"
#include "framework/python/values.h"
#include "framework/python/waiting.h"
#include "framework/run/output.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::python {
namespace {

namespace py = pybind11;
using namespace certify;

namespace fs = std::filesystem;

// Where the work is written and which part of it it is, as the command has them.
struct Sharing {
    std::optional<Shard> shard;
    std::vector<fs::path> merged;
    fs::path out;
};

Sharing sharingOf(const std::string& shard, const std::vector<fs::path>& merged,
                  const fs::path& out) {
    Sharing sharing{std::nullopt, merged, out};
    if (!shard.empty()) sharing.shard = parseShard(shard, "shard");
    if (sharing.shard && !merged.empty())
        throw ConfigError("certify: shard makes a part, merge puts parts together; take one.");
    if (sharing.shard && out.empty())
        throw ConfigError("shard: give out, the .shard that is written.");
    if (out.empty()) return sharing;
    const std::string ending = out.extension().string();
    if (sharing.shard ? ending != ".shard" : ending != ".exr" && ending != ".pfm") {
        throw ConfigError("out: " + out.string() + " must end in " +
                          (sharing.shard ? ".shard." : ".exr or .pfm."));
    }
    run::requireWritable(out.parent_path().empty() ? fs::path(".") : out.parent_path(), "out");
    return sharing;
}

// The file of a part on its way: it is gone on with where it was interrupted.
fs::path unfinishedFile(const Sharing& sharing) {
    if (sharing.out.empty() || sharing.shard) return sharing.out;
    return sharing.out.string() + ".unfinished";
}

CertificatePart wholePart(const scene::Scene& scene, const CertificateRequest& request,
                          const CertifyOptions& options) {
    CertificatePart part = certifyPart(scene, request, options);
    if (!part.isWhole()) {
        throw Error(options.keep.empty()
                        ? std::string("Interrupted.")
                        : fmt::format("Interrupted after {} of {} blocks; the same call goes on "
                                      "from there.",
                                      part.blocksDone, part.blocks),
                    kExitFailed);
    }
    return part;
}

py::dict certifyScene(const py::object& scene, const std::string& base, const py::object& size,
                      std::optional<double> time, int interactions, bool transmissionOnly,
                      double band, int depth, int threads, const py::object& image,
                      const py::object& progress, const std::string& shard,
                      const std::vector<fs::path>& merged, const fs::path& out) {
    const Sharing sharing = sharingOf(shard, merged, out);
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
    const auto requireSameSize = [&](const CertificateRequest& of) {
        if (!image.is_none() && (judged.width != of.width || judged.height != of.height))
            throw ConfigError("image is not of the certificate's size.");
    };
    if (!image.is_none()) judged = imageFrom(image, "image");
    if (!image.is_none() && sharing.shard)
        throw ConfigError("image: a part of a certificate judges none; merge all of them.");
    if (merged.empty()) requireSameSize(request);
    Progress told(progress);
    Certificate found;
    CertificatePart own;
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
                    options.shard = sharing.shard.value_or(Shard{});
                    options.keep = unfinishedFile(sharing);
                    options.progress = [&](double share, std::uint64_t cells) {
                        told.tell(share, std::to_string(cells) + " cells");
                        return shouldContinue() && !told.hasFailed();
                    };
                    std::vector<CertificatePart> parts;
                    for (const fs::path& file : sharing.merged)
                        parts.push_back(readPart(file));
                    if (parts.empty()) parts.push_back(wholePart(loaded, request, options));
                    if (sharing.shard) {
                        own = std::move(parts.front());
                        return;
                    }
                    made = makeCertificate(loaded, parts);
                    requireSameSize(made.request);
                    if (sharing.out.empty()) return;
                    writeCertificate(sharing.out, made);
                    std::error_code ignored;
                    fs::remove(options.keep, ignored);
                },
                keepWaiting);
            return made;
        });
    } catch (const Error&) {
        told.throwIfFailed();
        throw;
    }
    if (sharing.shard) {
        py::dict part;
        part["shard"] = shard;
        part["cells"] = own.sums.cells();
        part["seconds"] = own.seconds;
        part["file"] = out.string();
        return part;
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
               py::arg("progress"), py::arg("shard"), py::arg("merge"), py::arg("out"));
}

}  // namespace kaustik::python
