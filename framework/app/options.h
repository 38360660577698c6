// SPDX-License-Identifier: MIT
// What the command line asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/params/assignment.h"
#include "framework/pipeline/default_technique.h"

namespace kaustik::app {

// A mesh of the user's own as the scene (scene/files/own_mesh.h); "" as that has it.
struct OwnMeshOptions {
    std::string on;
    std::string material;
    std::string up;
};

// What `run` and `explain` share.
struct SceneOptions {
    std::string scene = "pool";
    OwnMeshOptions own;
    std::string scenePlace;  // of a file that names it; "" for the command line
    std::string technique = kDefaultTechnique;
    bool isAsPublished = false;                  // the technique's row is its paper's
    std::vector<std::string> merged;             // files of settings; mergeSettings() reads them
    std::vector<params::Assignment> parameters;  // what they set, in order; before `assignments`
    std::vector<std::string> assignments;        // --set name=value
    std::vector<std::string> disabled;
    std::string disabledBy = "--disable";  // or the place in a file
    std::string size = "800x600";
    std::string time;  // seconds; "" for the scene's own
    bool glDebug = false;
};

struct RunOptions {
    SceneOptions scene;
    int frames = 8;
    int warmup = 1;
    long long seed = 1;
    double timeStepSeconds = 0.0;  // from frame to frame
    bool precise = false;
    bool hasLedger = true;  // in the frames that are timed
    std::string reference = "none";
    long long referencePhotons = 1LL << 26;  // of auto, at least
    std::vector<std::string> saved;          // resources
    std::string deviceModel;                 // bandwidth of memory; "" for none
    bool captures = false;                   // a frame for RenderDoc
    std::optional<std::string> viewer;       // address of a tev that pictures are sent to
    std::string out;                         // "" for results/runs/<scene>-<technique>
    std::string tile;                        // K/N: traces one tile of the screen alone
    std::string tiles;                       // folder of all tiles' hits
};

struct BenchOptions {
    std::string action;              // save or compare
    std::vector<std::string> files;  // save: the one that is written; compare: before and after
    std::vector<std::string> scenes;
    SceneOptions scene;  // but for its scene
    int rounds = 5;
    int frames = 3;
    bool isPrecise = false;
    std::optional<double> maxSlowerPercent;  // compare: else an error
};

struct TuneOptions {
    std::string scene = "pool";
    std::optional<double> error;         // relMSE of the caustic
    std::optional<double> milliseconds;  // of its passes; one of the two
    std::string size = "400x300";
    long long referencePhotons = 1LL << 24;
    std::string out;  // "" for results/runs/tune/<scene>
};

struct ReferenceOptions {
    std::string scene;
    OwnMeshOptions own;
    std::string time;  // seconds; "" for the scene's own
    std::string size = "800x600";
    std::string estimator = "light";
    std::optional<long long> photons;     // where to stop: what is reached first
    std::optional<double> seconds;        //
    std::optional<double> standardError;  // relative
    long long seed = 1;
    int threads = 0;  // 0: all
    bool transmissionOnly = false;
    int interactions = 64;
    bool causticView = false;
    int classes = 0;                  // of paths, that are kept apart
    std::vector<std::string> named;   // further ones, as patterns
    bool byObject = false;            // `classes` are by the first specular object, too
    std::string out;                  // "" for results/references/<scene>-<estimator>-<size>.exr
    std::string shard;                // K/N; "" for the whole
    std::vector<std::string> merged;  // parts; then nothing else counts but `out` and
    bool incomplete = false;
};

struct CensusOptions {
    std::string scene = "pool";
    OwnMeshOptions own;
    std::string time;  // seconds; "" for the scene's own
    std::string size = "200x150";
    long long photons = 1LL << 22;
    std::string techniquePhotons = "128x128";
    std::vector<std::string> techniques;   // all where it is empty
    std::vector<std::string> assignments;  // --set name=value
    std::string shard;                     // K/N of the techniques
    std::vector<std::string> merged;       // files of all shards
    bool json = false;
    std::string out;  // folder; "": nothing is written
};

struct CertifyCommandOptions {
    std::string scene;
    OwnMeshOptions own;
    std::string time;  // seconds; "" for the scene's own
    std::string size = "800x600";
    int interactions = 1;
    bool transmissionOnly = false;
    double band = 0.01;  // pixels
    int depth = 12;
    int threads = 0;                  // 0: all
    std::string out;                  // "" for results/references/<scene>-certified-<size>.exr
    std::string shard;                // K/N; "" for the whole
    std::vector<std::string> merged;  // parts
};

struct ListOptions {
    std::string what = "scenes";
    std::string technique;
    bool isAsPublished = false;
    bool json = false;
};

struct DocOptions {
    std::string node;  // "" for all
    std::string out;   // "": one node's page is printed, all are written into results/runs/doc
};

struct ExplainOptions {
    SceneOptions scene;
    std::string dotFile;
    std::string deviceModel;  // bandwidth of memory; "" for none
};

struct CompareOptions {
    std::string image;
    std::string reference;
    std::string maskFile;           // "" for none, as are the next two
    std::string standardErrorFile;  // of the reference
    std::string areaFile;           // m² of receiver that a pixel sees
    std::string heatMapFile;
    std::optional<double> pixelsPerDegree;  // of FLIP
    bool json = false;
};

struct ImportOptions {
    std::string file;                       // .xml or .json
    std::string out;                        // the .toml
    std::string missingTextures = "error";  // or grey
};

struct JudgeOptions {
    std::string scene;
    OwnMeshOptions own;
    std::string theirs;           // .exr or .pfm
    std::string theirsErrorFile;  // "": estimated
    bool causticOnly = false;     // neither: it is found out
    bool withDirect = false;
    std::string glass = "auto";      // or seen, hidden
    std::string encoding = "auto";   // or linear, srgb, gamma2.2
    std::string primaries = "auto";  // or rec709, rec2020, p3, acescg, aces2065
    std::optional<double> exposure;
    std::string size;  // of the reference; "": that of the picture
    std::string time;
    long long photons = 1LL << 24;
    long long seed = 1;
    int classes = 6;
    bool noCauses = false;
    std::string shard;  // K/N: only this part of the references is made, and nothing is judged
    bool json = false;
    std::string out;  // folder; "": nothing is written
};

struct ExportOptions {
    std::string scene;
    OwnMeshOptions own;
    std::string to;  // povray, mitsuba, gltf or pbrt
    std::string out;
    std::string size = "800x600";
    std::string time;
    long long photons = 1'000'000;  // that the other renderer is asked for
};

struct ExperimentOptions {
    std::string action;                // run, merge or report
    std::vector<std::string> targets;  // the TOML file, or folders of results
    std::string out;                   // "" for results/runs/experiments/<name>
    std::string shard;                 // of run: K/N; "" for all
    std::vector<std::string> only;     // of run: KEY=VALUE of axes; none for all
    bool resume = false;
    bool incomplete = false;  // merge
};

struct GuiOptions {
    std::string scene;     // "": as it was left, or the default
    std::string describe;  // file that always says what is on the screen (gui/screen_map.h)
    bool unattended = false;
};

}  // namespace kaustik::app
