// SPDX-License-Identifier: MIT
// The part of a reference that one shard has computed, as a file that says all about itself. Three
// lines of text (the format, kaustik.part/1; a JSON object; its fingerprint), which `head -n 2`
// shows, and then the sums (pixel_sums_file.cpp), compressed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/core/shard.h"
#include "framework/reference/pixel_sums.h"
#include "framework/reference/reference.h"

namespace kaustik::reference {

struct PartHead {
    Subject subject;
    std::string version;  // of the program
    Shard shard;
    std::uint64_t batchesOfAll = 0;   // that the whole reference has
    std::vector<BatchRange> batches;  // that this part holds by now
    double seconds = 0.0;             // of computing
    std::string fingerprint;          // of the sums: the checksum that they end with
    std::uint64_t sumsBytes = 0;      // before compression
    std::uint64_t compressedBytes = 0;

    // The batches that are this shard's to compute.
    [[nodiscard]] BatchRange own() const;
    [[nodiscard]] std::uint64_t batchCount() const;
    [[nodiscard]] bool isWhole() const { return batchCount() == own().end - own().first; }
};

// Writes the part whole or not at all; what `head` says of the sums is taken from them.
void writePart(const std::filesystem::path& file, PartHead head, const PixelSums& sums);

// Throw IoError, naming the file, where it cannot be read, is damaged or no part at all.
[[nodiscard]] PartHead readPartHead(const std::filesystem::path& file);
[[nodiscard]] PixelSums readPartSums(const std::filesystem::path& file, const PartHead& head);

}  // namespace kaustik::reference
