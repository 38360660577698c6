// SPDX-License-Identifier: MIT
// References that several processes or machines compute apart: each some of the batches, as a part
// in a file. Sums are integers, so the merged reference is to the bit the one that a single process
// computes, whichever way the parts came and however often.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/reference/part_file.h"

namespace kaustik::reference {

struct ShardRequest {
    Shard shard;
    std::uint64_t photons = 0;   // of the whole reference
    std::filesystem::path file;  // of the part
};

struct ShardResult {
    PartHead head;
    bool wasComplete = false;  // nothing was left to compute
};

// The file in which a shard that is not finished keeps what it has: a part of its own, with fewer
// batches.
[[nodiscard]] std::filesystem::path unfinishedPart(const std::filesystem::path& file);

// Computes a shard and writes its part. What an earlier process of the same shard has left in
// unfinishedPart() it goes on with; a part that is there whole is left alone. What it finds damaged
// it tells `report` in one sentence, and makes again. Ended by `options`, it leaves the unfinished
// part, and its head says so. Throws ConfigError where the file holds a part of something else.
[[nodiscard]] ShardResult computeShard(const EmbreeScene& scene, const ReferenceRequest& request,
                                       const ShardRequest& requested, const RunOptions& options,
                                       const std::function<void(const std::string&)>& report);

struct MergeOptions {
    bool incomplete = false;  // batches may be missing
    std::function<void(int done, int total)> progress;
    std::function<void(const std::string&)> report;  // one sentence each
};

// The reference of all parts. Of several parts of one shard the one with the most batches counts.
// Throws ConfigError where parts do not belong together, or some are missing and may not; IoError
// where one cannot be read.
[[nodiscard]] Reference mergeParts(const std::vector<std::filesystem::path>& files,
                                   const MergeOptions& options);

}  // namespace kaustik::reference
