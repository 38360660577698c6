// SPDX-License-Identifier: MIT
#include "framework/app/certified_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/app/certify.h"
#include "framework/certify/verdict.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/image.h"
#include "framework/run/cache_folder.h"

namespace kaustik::app {

namespace fs = std::filesystem;
using namespace certify;

Certificate certificateFor(const scene::Scene& scene, int width, int height) {
    CertificateRequest request;
    request.width = width;
    request.height = height;
    request.beams.interactions = 2;
    const std::string key = certificateKey(scene, request);
    const fs::path file = run::cacheFolder() / "certificates" / (key + floatImageExtension());
    std::error_code error;
    if (fs::exists(fs::path(file).replace_extension(".json"), error)) {
        try {
            return readCertificate(file, key);
        } catch (const Error& damage) {
            fmt::print(stderr, "A cached certificate is damaged and is made again: {}\n",
                       damage.what());
        }
    }
    const Certificate made = makeCertificate(
        scene, {certifyWithProgress(scene, request, {}, 0, file.string() + ".unfinished")});
    writeCertificate(file, made);
    fs::remove(file.string() + ".unfinished", error);
    return made;
}

void judgeByCertificate(const Certificate& certificate, const fs::path& folder) {
    const Image caustic = readImage(folder / ("caustic" + floatImageExtension()));
    const Verdict verdict = judge(caustic, certificate);
    nlohmann::json found = toJson(verdict);
    found["certificate"] = toJson(certificate);
    const fs::path picture = folder / ("certified" + displayImageExtension());
    writeImage(picture, verdictPicture(caustic, certificate));
    const fs::path record = folder / "certified.json";
    writeFileWhole(record, found.dump(2) + "\n");
    fmt::print("certified: of {} pixels {} are proved too dark and {} too bright", verdict.pixels,
               verdict.below, verdict.above);
    if (verdict.aboveCertifiedPaths > 0) {
        fmt::print("; {} are too bright for paths of 1 to {} interactions",
                   verdict.aboveCertifiedPaths, certificate.request.beams.interactions);
    }
    fmt::print("; {} are undecided\nwrote {}\nwrote {}\n", verdict.undecided, picture.string(),
               record.string());
}

}  // namespace kaustik::app
