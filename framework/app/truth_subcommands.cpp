// SPDX-License-Identifier: MIT
// Ray-traced truth: references, certificates and the census of paths, how far an image is from
// them, and scenes and pictures of other renderers.
#include <memory>
#include <string>
#include <vector>

#include "framework/app/common_options.h"
#include "framework/app/subcommands.h"

namespace kaustik::app {
namespace {

// Merging knows everything else from the parts.
void addMergeOptions(CLI::App& command, ReferenceOptions& options) {
    const std::vector<CLI::Option*> others = command.get_options();
    CLI::Option* const merge = command.add_option(
        "--merge", options.merged, "Instead of a scene: all parts of a reference, as one");
    command.callback([merge, others] {
        for (const CLI::Option* other : others) {
            if (merge->count() > 0 && other->count() > 0)
                throw CLI::ExcludesError(merge->get_name(), other->get_name());
        }
    });
    command
        .add_flag("--incomplete", options.incomplete,
                  "Merges though parts are missing; the reference has fewer photons")
        ->needs(merge);
}

}  // namespace

Subcommand addReference(CLI::App& app) {
    const auto options = std::make_shared<ReferenceOptions>();
    CLI::App& command =
        *app.add_subcommand("reference", "Computes the ray-traced reference of a scene");
    command.add_option("scene", options->scene, kSceneHelp);
    addOwnMeshOptions(command, options->own);
    command.add_option("--photons", options->photons, "Stops at this number of photons")
        ->check(integerRangeError);
    command.add_option("--seconds", options->seconds, "Stops after this time");
    command.add_option("--error", options->standardError,
                       "Stops at this standard error, as a share of a lit pixel's mean");
    command.add_option("--estimator", options->estimator, "light or sppm")->capture_default_str();
    command.add_option("--size", options->size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    command.add_option("--time", options->time, "Time of the animation in seconds");
    command.add_option("--seed", options->seed, "Seed of everything random")
        ->check(integerRangeError)
        ->capture_default_str();
    command.add_option("--threads", options->threads, "Threads; 0: all; changes no value")
        ->capture_default_str();
    command.add_flag("--transmission-only", options->transmissionOnly,
                     "At dielectrics only the refracted branch, unless all is reflected");
    command
        .add_option("--interactions", options->interactions,
                    "Most specular interactions of a photon")
        ->capture_default_str();
    command.add_flag("--caustic-view", options->causticView,
                     "Also what the eye sees of it through and in specular surfaces (sppm)");
    command.add_option("--classes", options->classes,
                       "Keeps the N brightest classes of paths apart, and all others: layers "
                       "TT, TRT, …, other of NAME.classes.exr");
    command
        .add_option("--class", options->named,
                    "A class to keep apart, as [NAME=]PATTERN: 'L T R+ T D', 'S+ @ring'")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_flag("--by-object", options->byObject,
                     "The classes of --classes are by the first specular object, too");
    command.add_option("--shard", options->shard,
                       "K/N: only the K-th of N equal parts of --photons, as a .shard");
    addMergeOptions(command, *options);
    command.add_option("--out", options->out,
                       "The .exr or .pfm (with --shard: .shard) that is written");
    return {&command, [options] {
                putOwnMesh(options->scene, options->own);
                referenceCommand(*options);
            }};
}

Subcommand addCensus(CLI::App& app, const Registry& registry) {
    const auto options = std::make_shared<CensusOptions>();
    CLI::App& command = *app.add_subcommand(
        "census",
        "Prints the watts of each class of caustic paths, and what of them each technique forms, "
        "cannot form, and loses");
    command.add_option("scene", options->scene, kSceneHelp)->capture_default_str();
    addOwnMeshOptions(command, options->own);
    command.add_option("--photons", options->photons, "Photons of the census of paths")
        ->check(integerRangeError)
        ->capture_default_str();
    command
        .add_option("--technique", options->techniques,
                    "A name from 'list techniques'; without it all, with defaults and as published")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command
        .add_option("--set", options->assignments, "A parameter of the techniques, as name=value")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command
        .add_option("--technique-photons", options->techniquePhotons,
                    "Photons of a technique's frame, WIDTHxHEIGHT")
        ->capture_default_str();
    command.add_option("--size", options->size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    command.add_option("--time", options->time, "Time of the animation in seconds");
    command.add_flag("--json", options->json, "As JSON");
    command.add_option(
        "--out", options->out,
        "Folder for classes.csv, techniques.csv and census.json; what is interrupted "
        "goes on from the techniques that are done");
    command.add_option("--shard", options->shard,
                       "K/N: only the K-th of N parts of the techniques, as census-K-of-N.json");
    command
        .add_option("--merge", options->merged,
                    "Puts the parts of all shards together, which say what they were asked for")
        ->expected(-1);
    addDeviceOption(command);
    return {&command, [options, &registry] {
                putOwnMesh(options->scene, options->own);
                censusCommand(*options, registry);
            }};
}

Subcommand addCertify(CLI::App& app) {
    const auto options = std::make_shared<CertifyCommandOptions>();
    CLI::App& command = *app.add_subcommand(
        "certify", "Encloses each pixel's caustic irradiance in an interval, with a proof");
    command.add_option("scene", options->scene, kSceneHelp);
    addOwnMeshOptions(command, options->own);
    command.add_option("--size", options->size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    command.add_option("--time", options->time, "Time of the animation in seconds");
    command
        .add_option("--interactions", options->interactions,
                    "Most specular interactions of the paths that are certified, 1 to 8")
        ->capture_default_str();
    command.add_flag("--transmission-only", options->transmissionOnly,
                     "At dielectrics only the refracted branch, unless all is reflected");
    command
        .add_option("--band", options->band,
                    "Pixels by which a cell's place on the screen may be unsure before it is split")
        ->capture_default_str();
    command.add_option("--depth", options->depth, "Splits of a triangle at most, each into four")
        ->capture_default_str();
    command.add_option("--threads", options->threads, "Threads; 0: all; changes no value")
        ->capture_default_str();
    command.add_option("--shard", options->shard, "K/N: only the K-th of N parts, as a .shard");
    command.add_option("--merge", options->merged,
                       "All parts of a certificate of this scene, as one");
    command.add_option("--out", options->out,
                       "The .exr or .pfm (with --shard: .shard) that names what is written");
    return {&command, [options] {
                putOwnMesh(options->scene, options->own);
                certifyCommand(*options);
            }};
}

Subcommand addCompare(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App& command =
        *app.add_subcommand("compare", "Prints how wrong an image is against a reference");
    command.add_option("image", options->image, "An .exr, .pfm or .png")->required();
    command.add_option("reference", options->reference, "The reference, of the same size")
        ->required();
    command.add_flag("--json", options->json, "As JSON, with formulas");
    command.add_option("--heatmap", options->heatMapFile, "Writes where it is wrong, as .png");
    command.add_option("--stderr", options->standardErrorFile,
                       "The reference's standard error, an image of the same kind");
    command.add_option("--area", options->areaFile,
                       "An image of the area that a pixel sees, so that sums are flux");
    command.add_option("--ppd", options->pixelsPerDegree,
                       "Pixels in a degree of the viewer's sight, for FLIP");
    command.add_option("--mask", options->maskFile, "An image that is 0 where not to compare");
    return {&command, [options] { compareCommand(*options); }};
}

Subcommand addImport(CLI::App& app) {
    const auto options = std::make_shared<ImportOptions>();
    CLI::App& command =
        *app.add_subcommand("import", "Makes a scene file of another renderer's scene");
    command.add_option("file", options->file, "A scene of Mitsuba, .xml, or Tungsten, .json")
        ->required();
    command.add_option("--out", options->out, "The .toml that is written")->required();
    command
        .add_option("--missing-textures", options->missingTextures,
                    "What a picture that is not there is: error or grey")
        ->capture_default_str();
    return {&command, [options] { importCommand(*options); }};
}

Subcommand addExport(CLI::App& app) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App& command =
        *app.add_subcommand("export", "Writes a scene and its meshes for another renderer");
    command.add_option("scene", options->scene, kSceneHelp)->required();
    addOwnMeshOptions(command, options->own);
    command.add_option("--to", options->to, "povray, mitsuba, gltf or pbrt")->required();
    command.add_option("--out", options->out, "The folder that is written to")->required();
    command.add_option("--size", options->size, "Picture size, WIDTHxHEIGHT")
        ->capture_default_str();
    command.add_option("--time", options->time, "Time of the animation in seconds");
    command.add_option("--photons", options->photons, "That its renderer is asked to shoot, about")
        ->check(integerRangeError)
        ->capture_default_str();
    return {&command, [options] {
                putOwnMesh(options->scene, options->own);
                exportCommand(*options);
            }};
}

Subcommand addJudge(CLI::App& app) {
    const auto options = std::make_shared<JudgeOptions>();
    CLI::App& command = *app.add_subcommand(
        "judge", "Says what is wrong with another renderer's picture of a scene");
    command.add_option("scene", options->scene, kSceneHelp)->required();
    command.add_option("theirs", options->theirs, "The picture, .exr or .pfm in linear light");
    addOwnMeshOptions(command, options->own);
    command.add_flag("--caustic-only", options->causticOnly,
                     "It has no direct light; without either it is found out");
    command.add_flag("--with-direct", options->withDirect, "It has direct light, too");
    command
        .add_option("--glass", options->glass,
                    "Whether its eye sees glass and water, or straight through: auto, seen or "
                    "hidden")
        ->capture_default_str();
    command
        .add_option("--encoding", options->encoding,
                    "What its values are: auto, linear, srgb or gamma2.2")
        ->capture_default_str();
    command
        .add_option("--primaries", options->primaries,
                    "Which primaries its channels are of: auto, rec709, rec2020, p3, acescg or "
                    "aces2065")
        ->capture_default_str();
    command.add_option("--exposure", options->exposure,
                       "Its value for 1 W/m²/sr, where that is known; else it is found");
    command.add_option("--stderr", options->theirsErrorFile,
                       "Its standard error, an image of the same size; else it is estimated");
    command.add_option("--size", options->size,
                       "Picture size of the reference, WIDTHxHEIGHT, where it is another");
    command.add_option("--time", options->time, "Time of the animation in seconds");
    command.add_option("--photons", options->photons, "Photons of the reference")
        ->check(integerRangeError)
        ->capture_default_str();
    command.add_option("--seed", options->seed, "Seed of the reference")
        ->check(integerRangeError)
        ->capture_default_str();
    command.add_option("--classes", options->classes, "Classes of paths at most, the brightest")
        ->capture_default_str();
    command.add_flag("--no-causes", options->noCauses,
                     "Only classes: no references of what else may be wrong");
    command.add_option("--shard", options->shard,
                       "K/N: only makes the K-th of N parts of the references, for the cache that "
                       "judging takes them from; needs --size, and no picture");
    command.add_flag("--json", options->json, "As JSON");
    command.add_option("--out", options->out,
                       "Folder for judge.json, judge.txt, where.png and residual.exr");
    return {&command, [options] {
                putOwnMesh(options->scene, options->own);
                judgeCommand(*options);
            }};
}

}  // namespace kaustik::app
