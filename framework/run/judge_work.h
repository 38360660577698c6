// SPDX-License-Identifier: MIT
// What the judge needs to know of a scene: its light, class of paths by class, and what known
// mistakes would make of it; all from references, which are cached.
#pragma once

#include "framework/core/shard.h"
#include "framework/judge/judge.h"
#include "framework/run/progress.h"
#include "framework/scene/scene.h"

namespace kaustik::run {

struct JudgedScene {
    int width = 800;  // pixels
    int height = 600;
    long long photons = 1LL << 24;  // of the reference; causes have a quarter of them
    long long seed = 1;
    int classes = 6;     // at most, and one more of all other paths
    bool causes = true;  // also references of what may be wrong: an index, a light, normals
};

// All of the subject but for their picture. Throws ConfigError for a scene in a medium, whose light
// on the way to the eye is not in references of irradiance, and for one without anything specular.
[[nodiscard]] judge::Subject subjectOf(const scene::Scene& scene, const JudgedScene& request,
                                       const Watch* watch = nullptr);

// How many references judging a scene takes, and how many of them were a shard's.
struct PreparedReferences {
    int all = 0;
    int own = 0;
};
// Makes a shard's part of the references that subjectOf() asks for and leaves them in the cache,
// where it finds them; those that are there stay. Shards have about as many photons as each other,
// no reference is split. What subjectOf() does not keep, wrong laws of Fresnel's, is left to it.
// Throws as it does.
PreparedReferences prepareReferences(const scene::Scene& scene, const JudgedScene& request,
                                     const Shard& shard, const Watch* watch = nullptr);

// Throws ConfigError for a picture of which no light can be told, before references are made:
// values that are no numbers or negative, black, of 8 bits.
void requireNumbers(const Image& image, const std::string& name);

// The same for a picture of theirs, which says the size unless one is given. Throws ConfigError
// for a picture that was made for a display.
[[nodiscard]] judge::Verdict judgeFile(const scene::Scene& scene, const std::string& file,
                                       const std::string& errorFile, JudgedScene request,
                                       bool hasSize, const judge::JudgeOptions& options);

}  // namespace kaustik::run
