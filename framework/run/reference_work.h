// SPDX-License-Identifier: MIT
// References as the commands make them: cached, with progress, stopped by Ctrl-C without loss.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/pipeline/photons.h"
#include "framework/reference/reference.h"
#include "framework/reference/shards.h"
#include "framework/reference/view_reference.h"
#include "framework/run/cache_folder.h"
#include "framework/run/progress.h"

namespace kaustik::run {

// The filter of `all` narrowed to the paths that a technique models.
[[nodiscard]] reference::PathFilter modelledFilter(reference::PathFilter all,
                                                   const ModelledPaths& paths);

// Takes the reference from the cache, or computes it with its progress on standard error and caches
// it. Throws Error when interrupted; the next call goes on from there.
[[nodiscard]] reference::Reference obtainReference(const reference::EmbreeScene& scene,
                                                   const reference::ReferenceRequest& request,
                                                   reference::RunOptions options);
// Does the same for a caller that shows the progress in a way of its own.
[[nodiscard]] reference::Reference obtainReference(const reference::EmbreeScene& scene,
                                                   const reference::ReferenceRequest& request,
                                                   reference::RunOptions options,
                                                   const Watch& watch);

// What the eye sees, from the cache or traced and cached.
[[nodiscard]] reference::ViewReference obtainView(const reference::EmbreeScene& scene,
                                                  const reference::ViewReferenceRequest& request);

// A shard of one, with its progress on standard error. Throws Error when interrupted; the next call
// goes on from there.
[[nodiscard]] reference::ShardResult obtainShard(const reference::EmbreeScene& scene,
                                                 const reference::ReferenceRequest& request,
                                                 const reference::ShardRequest& requested,
                                                 reference::RunOptions options);
// The reference of all parts, with the progress of reading them.
[[nodiscard]] reference::Reference mergeShards(const std::vector<std::filesystem::path>& files,
                                               bool incomplete);

}  // namespace kaustik::run
