// SPDX-License-Identifier: MIT
// kaustik judge: what is wrong with someone else's picture of a scene.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/params/assignment.h"
#include "framework/run/judge_work.h"
#include "framework/run/output.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;

judge::JudgeOptions optionsOf(const JudgeOptions& options) {
    judge::JudgeOptions result;
    if (options.causticOnly && options.withDirect)
        throw ConfigError("judge: --caustic-only and --with-direct exclude each other.");
    if (options.causticOnly) result.direct = judge::DirectLight::without;
    if (options.withDirect) result.direct = judge::DirectLight::with;
    if (options.glass == "seen") {
        result.glass = judge::Glass::seen;
    } else if (options.glass == "hidden") {
        result.glass = judge::Glass::hidden;
    } else if (options.glass != "auto") {
        throw ConfigError(
            fmt::format("--glass: '{}' is neither auto, seen nor hidden.", options.glass));
    }
    if (options.encoding == "linear") {
        result.encoding = judge::Encoding::linear;
    } else if (options.encoding == "srgb") {
        result.encoding = judge::Encoding::srgb;
    } else if (options.encoding == "gamma2.2") {
        result.encoding = judge::Encoding::gamma22;
    } else if (options.encoding != "auto") {
        throw ConfigError(fmt::format(
            "--encoding: '{}' is neither auto, linear, srgb nor gamma2.2.", options.encoding));
    }
    if (options.exposure && !(*options.exposure > 0.0))
        throw ConfigError(fmt::format("--exposure: {} is not above 0.", *options.exposure));
    result.exposure = options.exposure;
    return result;
}

}  // namespace

void judgeCommand(const JudgeOptions& options) {
    run::JudgedScene request;
    if (!options.size.empty()) {
        const params::Extent size = params::parsePictureSize(options.size, "--size");
        request.width = size.width;
        request.height = size.height;
    }
    if (options.classes < 1 || options.classes > 32)
        throw ConfigError(fmt::format("--classes: {} is not from 1 to 32.", options.classes));
    request.photons = options.photons;
    request.seed = options.seed;
    request.classes = options.classes;
    request.causes = !options.noCauses;
    const judge::JudgeOptions how = optionsOf(options);
    if (!options.out.empty()) run::requireWritable(options.out, "--out");
    const scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const judge::Verdict verdict = run::judgeFile(scene, options.theirs, options.theirsErrorFile,
                                                  request, !options.size.empty(), how);
    const std::string json = jsonText(judge::toJson(verdict), 2) + "\n";
    const std::string text = judge::toText(verdict);
    if (!options.out.empty()) {
        FilesTogether files(options.out);
        writeImage(files.workFolder() / ("where" + displayImageExtension()),
                   judge::whereOf(verdict));
        writeImage(files.workFolder() / ("residual" + floatImageExtension()), verdict.residual);
        writeFileWhole(files.workFolder() / "judge.txt", text);
        writeFileWhole(files.workFolder() / "judge.json", json);
        files.publish("judge.json");
    }
    fmt::print("{}", options.json ? json : text);
}

}  // namespace kaustik::app
