// SPDX-License-Identifier: MIT
// kaustik certify: an interval for each pixel's caustic irradiance, with a proof; a shard of it, or
// the merged shards.
#include "framework/app/certify.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/shard.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using namespace certify;

CertificateRequest requestOf(const CertifyCommandOptions& options) {
    const params::Extent size = params::parsePictureSize(options.size, "--size");
    CertificateRequest request;
    request.width = size.width;
    request.height = size.height;
    request.beams.interactions = options.interactions;
    request.beams.transmissionOnly = options.transmissionOnly;
    request.beams.bandPixels = options.band;
    request.beams.maxDepth = options.depth;
    return request;
}

void print(const Certificate& certificate, const fs::path& file) {
    const Tightness tightness = tightnessOf(certificate);
    const Totals& totals = certificate.totals;
    const int interactions = certificate.request.beams.interactions;
    fmt::print("{}, {}x{}, {} cells, {:.1f} s\n", certificate.scene, certificate.request.width,
               certificate.request.height, certificate.cells, certificate.seconds);
    fmt::print(
        "paths of 1 to {} interactions bring from {:.7g} to {:.7g} W to receivers ({:.2g} %), "
        "of {:.7g} to {:.7g} W emitted\n",
        interactions, totals.deposited.lo, totals.deposited.hi, 100.0 * tightness.totalWidth,
        totals.emitted.lo, totals.emitted.hi);
    fmt::print("beyond {} interactions {:.4g} to {:.4g} W; undecided at most {:.3g} W\n",
               interactions, totals.limited.lo, totals.limited.hi, totals.undecided);
    if (tightness.lit == 0) {
        fmt::print("no pixel is lit\n");
    } else {
        fmt::print(
            "{} of {} pixels are lit; intervals are {:.3g} % wide in the median, {:.3g} % at "
            "the 95th percentile; {} are undecided ({:.2g} %)\n",
            tightness.lit, tightness.pixels, 100.0 * tightness.medianWidth,
            100.0 * tightness.p95Width, tightness.undecided,
            100.0 * static_cast<double>(tightness.undecided) / static_cast<double>(tightness.lit));
    }
    fmt::print("wrote {}\n", fs::path(file).replace_extension(".json").string());
}

fs::path outputFile(const std::string& out, const std::string& fallback, bool isPart) {
    const fs::path file = out.empty() ? fs::path("results/references") / fallback : fs::path(out);
    const std::string ending = file.extension().string();
    if (isPart ? ending != ".shard" : ending != ".exr" && ending != ".pfm") {
        throw ConfigError(fmt::format("--out: {} must end in {}.", file.string(),
                                      isPart ? ".shard" : ".exr or .pfm"));
    }
    run::requireWritable(file.parent_path().empty() ? fs::path(".") : file.parent_path(), "--out");
    return file;
}

}  // namespace

CertificatePart certifyWithProgress(const scene::Scene& scene, const CertificateRequest& request,
                                    const Shard& shard, int threads, const fs::path& keep) {
    run::catchInterrupts();
    CertifyOptions how;
    how.threads = threads;
    how.shard = shard;
    how.keep = keep;
    run::Progress progress("certificate:");
    how.progress = [&](double share, std::uint64_t cells) {
        progress.updateShare(share, fmt::format("{} cells", cells));
        return !run::isInterrupted();
    };
    CertificatePart part = certifyPart(scene, request, how);
    if (!part.isWhole()) {
        throw Error(
            fmt::format("Interrupted after {} of {} blocks; the same command goes on from there.",
                        part.blocksDone, part.blocks),
            kExitFailed);
    }
    return part;
}

void certifyCommand(const CertifyCommandOptions& options) {
    if (options.scene.empty())
        throw ConfigError("certify: name a scene, and with --merge the parts of its certificate.");
    const scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const CertificateRequest request = requestOf(options);
    std::optional<Shard> shard;
    if (!options.shard.empty()) shard = parseShard(options.shard, "--shard");
    const std::string name =
        fmt::format("{}-certified-{}x{}", scene.name, request.width, request.height);
    const fs::path file =
        outputFile(options.out,
                   shard ? fmt::format("{}-{}-of-{}.shard", name, shard->number, shard->count)
                         : name + floatImageExtension(),
                   shard.has_value());
    std::vector<CertificatePart> parts;
    if (!options.merged.empty()) {
        for (const std::string& part : options.merged)
            parts.push_back(readPart(part));
    } else {
        if (options.threads < 0 || options.threads > 1024)
            throw ConfigError(fmt::format("--threads: {} is not from 0 to 1024.", options.threads));
        const fs::path unfinished = shard ? file : fs::path(file.string() + ".unfinished");
        parts.push_back(certifyWithProgress(scene, request, shard.value_or(Shard{}),
                                            options.threads, unfinished));
        const CertificatePart& part = parts.front();
        if (shard) {
            fmt::print("{}, {}x{}, shard {}/{}: {} cells, {:.1f} s\nwrote {}\n", scene.name,
                       request.width, request.height, shard->number, shard->count,
                       part.sums.cells(), part.seconds, file.string());
            return;
        }
        std::error_code ignored;
        fs::remove(unfinished, ignored);
    }
    const Certificate certificate = makeCertificate(scene, parts);
    writeCertificate(file, certificate);
    print(certificate, file);
}

}  // namespace kaustik::app
