// SPDX-License-Identifier: MIT
// kaustik judge: what is wrong with someone else's picture of a scene.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/core/shard.h"
#include "framework/params/assignment.h"
#include "framework/run/judge_work.h"
#include "framework/run/output.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;

judge::JudgeOptions optionsOf(const JudgeOptions& options) {
    if (options.causticOnly && options.withDirect)
        throw ConfigError("judge: --caustic-only and --with-direct exclude each other.");
    judge::NamedOptions names;
    if (options.causticOnly) names.direct = "without";
    if (options.withDirect) names.direct = "with";
    names.glass = options.glass;
    names.encoding = options.encoding;
    names.primaries = options.primaries;
    names.exposure = options.exposure;
    return judge::optionsOf(names, [](const std::string& name) { return "--" + name; });
}

void prepare(const JudgeOptions& options, const scene::Scene& scene,
             const run::JudgedScene& request) {
    const Shard shard = parseShard(options.shard, "--shard");
    const run::PreparedReferences made = run::prepareReferences(scene, request, shard);
    fmt::print("{}, {}x{}, shard {}/{}: {} of {} references are in the cache\n", scene.name,
               request.width, request.height, shard.number, shard.count, made.own, made.all);
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
    const bool prepares = !options.shard.empty();
    if (!prepares && options.theirs.empty()) throw ConfigError("judge: name the picture.");
    if (prepares &&
        (!options.theirs.empty() || options.size.empty() || options.json || !options.out.empty())) {
        throw ConfigError(
            "--shard: it makes references for pictures of a size, and judges none: give --size, "
            "and no picture, --json or --out.");
    }
    const judge::JudgeOptions how = optionsOf(options);
    if (!options.out.empty()) run::requireWritable(options.out, "--out");
    const scene::Scene scene = loadRequestedScene(options.scene, options.time);
    if (prepares) return prepare(options, scene, request);
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
