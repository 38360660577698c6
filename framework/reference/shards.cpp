// SPDX-License-Identifier: MIT
#include "framework/reference/shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <system_error>
#include <tuple>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

struct PartFile {
    fs::path file;
    PartHead head;
};

// How `other` differs from `one` in what the merged reference is; "" where it does not.
std::string differenceBetween(const PartHead& one, const PartHead& other) {
    const auto differ = [](const auto& what, const auto& is, const auto& was) {
        return fmt::format("{} {} instead of {}", what, is, was);
    };
    const ReferenceRequest& requested = one.subject.request;
    const ReferenceRequest& found = other.subject.request;
    if (other.version != one.version) return differ("version", other.version, one.version);
    if (other.subject.scene != one.subject.scene)
        return differ("scene", other.subject.scene, one.subject.scene);
    if (found.width != requested.width || found.height != requested.height) {
        return fmt::format("size {}x{} instead of {}x{}", found.width, found.height,
                           requested.width, requested.height);
    }
    if (found.seed != requested.seed) return differ("seed", found.seed, requested.seed);
    if (found.estimator != requested.estimator) return "another estimator";
    if (other.subject.key != one.subject.key)
        return "other contents of the scene, another time or other settings";
    if (other.batchesOfAll != one.batchesOfAll)
        return differ("batches in all", other.batchesOfAll, one.batchesOfAll);
    if (other.shard.count != one.shard.count)
        return differ("number of shards", other.shard.count, one.shard.count);
    return "";
}

struct FoundPart {
    PartHead head;
    PixelSums sums;
};

// Nothing where there is no such file, or no use of it.
std::optional<FoundPart> findPart(const fs::path& file,
                                  const std::function<void(const std::string&)>& report) {
    std::error_code error;
    if (!fs::exists(file, error)) return {};
    try {
        PartHead head = readPartHead(file);
        PixelSums sums = readPartSums(file, head);
        return FoundPart{std::move(head), std::move(sums)};
    } catch (const IoError& damage) {
        report(damage.what());
        return {};
    }
}

// How what is in a file differs from the shard that is to be in it.
std::string differenceOfShards(const PartHead& wanted, const PartHead& found) {
    const std::string difference = differenceBetween(wanted, found);
    if (!difference.empty() || found.shard == wanted.shard) return difference;
    return fmt::format("shard {} instead of {}", found.shard.number, wanted.shard.number);
}

}  // namespace

fs::path unfinishedPart(const fs::path& file) {
    return file.string() + ".unfinished";
}

ShardResult computeShard(const EmbreeScene& scene, const ReferenceRequest& request,
                         const ShardRequest& requested, const RunOptions& options,
                         const std::function<void(const std::string&)>& report) {
    PartHead head;
    head.subject = subjectOf(scene.scene(), request);
    head.version = versionString();
    head.shard = requested.shard;
    head.batchesOfAll = batchesFor(scene, request, requested.photons);
    if (std::optional<FoundPart> there = findPart(requested.file, report)) {
        const std::string difference = differenceOfShards(head, there->head);
        if (!difference.empty()) {
            throw ConfigError(fmt::format(
                "--out: {} is a part of something else: it has {}; delete it or name another file.",
                requested.file.string(), difference));
        }
        if (there->head.isWhole()) return {std::move(there->head), true};
    }
    PixelSums sums = makeSums(scene, request);
    const fs::path unfinished = unfinishedPart(requested.file);
    double secondsBefore = 0.0;
    std::optional<FoundPart> there = findPart(unfinished, report);
    if (there && differenceOfShards(head, there->head).empty()) {
        sums = std::move(there->sums);
        secondsBefore = there->head.seconds;
    }
    const auto start = std::chrono::steady_clock::now();
    const auto headOf = [&](const PixelSums& state) {
        const auto past = std::chrono::steady_clock::now() - start;
        head.seconds = secondsBefore + std::chrono::duration<double>(past).count();
        head.batches = state.batches();
        return head;
    };
    RunOptions saving = options;
    saving.shard = head.own();
    saving.save = [&](const PixelSums& state) {
        if (!headOf(state).isWhole()) writePart(unfinished, headOf(state), state);
        if (options.save) options.save(state);
    };
    addBatches(scene, request, saving, sums);
    if (headOf(sums).isWhole()) {
        writePart(requested.file, head, sums);
        std::error_code ignored;
        fs::remove(unfinished, ignored);
    }
    return {head, false};
}

namespace {

// The part that counts for each shard; a choice that does not depend on the order of the files.
std::map<std::uint64_t, PartFile> chosenParts(std::vector<PartFile> parts,
                                              const MergeOptions& options) {
    std::sort(parts.begin(), parts.end(), [](const PartFile& a, const PartFile& b) {
        const auto rank = [](const PartFile& part) {
            return std::tuple(part.head.shard.number, UINT64_MAX - part.head.batchCount(),
                              part.head.fingerprint, part.file);
        };
        return rank(a) < rank(b);
    });
    std::map<std::uint64_t, PartFile> chosen;
    for (const PartFile& part : parts) {
        const PartFile& best = chosen.emplace(part.head.shard.number, part).first->second;
        if (best.head.batches == part.head.batches &&
            best.head.fingerprint != part.head.fingerprint && options.report) {
            options.report(fmt::format(
                "warning: {} and {} hold the same batches and are not equal, so the machines that "
                "made them compute differently; the first counts.",
                best.file.string(), part.file.string()));
        }
    }
    return chosen;
}

void requireWhole(const std::map<std::uint64_t, PartFile>& chosen, const PartHead& of) {
    std::vector<std::uint64_t> missing;
    std::vector<std::uint64_t> unfinished;
    for (std::uint64_t number = 1; number <= of.shard.count; ++number) {
        const auto found = chosen.find(number);
        if (found == chosen.end()) {
            missing.push_back(number);
        } else if (!found->second.head.isWhole()) {
            unfinished.push_back(number);
        }
    }
    const auto listed = [](const std::vector<std::uint64_t>& numbers, const char* what) {
        if (numbers.empty()) return std::string();
        return fmt::format("shard{} {} {} {}", numbers.size() == 1 ? "" : "s",
                           listOfNumbers(numbers), numbers.size() == 1 ? "is" : "are", what);
    };
    if (missing.empty() && unfinished.empty()) return;
    throw ConfigError(fmt::format(
        "Of {} shards, {}{}{}. Compute and name them too, or take what there is with --incomplete.",
        of.shard.count, listed(missing, "missing"),
        missing.empty() || unfinished.empty() ? "" : ", and ", listed(unfinished, "not finished")));
}

}  // namespace

Reference mergeParts(const std::vector<fs::path>& files, const MergeOptions& options) {
    if (files.empty()) throw ConfigError("--merge: name the parts of a reference.");
    std::vector<PartFile> parts;
    for (const fs::path& file : files) {
        parts.push_back({file, readPartHead(file)});
        const std::string difference = differenceBetween(parts.front().head, parts.back().head);
        if (!difference.empty()) {
            throw ConfigError(fmt::format("{} and {} are not of one reference: the latter has {}.",
                                          files.front().string(), file.string(), difference));
        }
    }
    const PartHead first = parts.front().head;
    const std::map<std::uint64_t, PartFile> chosen = chosenParts(std::move(parts), options);
    if (!options.incomplete) requireWhole(chosen, first);
    PixelSums sums;
    double seconds = 0.0;
    int done = 0;
    for (const auto& [number, part] : chosen) {
        PixelSums more = readPartSums(part.file, part.head);
        if (done++ == 0) {
            sums = std::move(more);
        } else {
            sums.merge(more);
        }
        seconds += part.head.seconds;
        if (options.progress) options.progress(done, static_cast<int>(chosen.size()));
    }
    return makeReference(first.subject, sums, seconds);
}

}  // namespace kaustik::reference
