// SPDX-License-Identifier: MIT
// Variants that were kept to be looked at and compared again: settings, pictures, times and errors
// together, so that nothing is rendered for it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/gui/frame_result.h"
#include "framework/gui/reference_worker.h"
#include "framework/gui/table.h"

namespace kaustik::gui {

struct KeptVariant {
    std::uint64_t number = 0;                                    // no other of this program has it
    std::string name;                                            // "exact_rays, emit.photons=64x64"
    Document document;                                           // its own settings as A
    std::vector<std::shared_ptr<const ViewedTexture>> textures;  // that it was kept with
    double frameMs = 0.0;                                        // median
    Table passes;
    std::vector<std::string> reservations;
    ReferenceState::Judgement judgement;  // order 0: by no reference
    std::string reference;                // that it was judged by: noteOf()
    std::size_t bytes = 0;                // of its textures

    // Null where it was not kept.
    [[nodiscard]] std::shared_ptr<const ViewedTexture> texture(const std::string& resource) const;
};

// "exact_rays, emit.photons=64x64, without shadow.bvh".
[[nodiscard]] std::string settingsText(const Variant& variant);

// In memory; a key each.
inline constexpr std::size_t kMaxKept = 9;
inline constexpr std::size_t kMaxKeptBytes = std::size_t{1} << 30;

// What there is of a variant of the frame, or why there is nothing to keep in `problem`: only what
// is settled stands for its settings.
[[nodiscard]] std::optional<KeptVariant> keep(const FrameResult& result, std::size_t variant,
                                              const ReferenceState& reference,
                                              std::string& problem);
// Why one more has no room; "" where it has.
[[nodiscard]] std::string whyNoRoom(const std::vector<KeptVariant>& kept, const KeptVariant& more);

// The channels of colour of an image: alpha is none.
[[nodiscard]] Image colorsOf(const Image& image);

// How two images of the same kind differ.
struct ImageDifference {
    double rmse = 0.0;  // of all channels, in their unit
    std::optional<double> flip;
    std::shared_ptr<const Image> signedMean;  // A - B, the mean of the channels of colour
    Histogram histogram;
    std::string problem;             // why there is none
    std::uint64_t firstVersion = 0;  // of the values that it is of
    std::uint64_t secondVersion = 0;
    [[nodiscard]] bool isOf(std::uint64_t first, std::uint64_t second) const {
        return firstVersion == first && secondVersion == second;
    }
};
[[nodiscard]] ImageDifference differenceBetween(const Image& a, const Image& b);

}  // namespace kaustik::gui
