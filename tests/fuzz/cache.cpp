// SPDX-License-Identifier: MIT
// The sums of a reference in the cache. They end in a checksum, which no mutation would hit: the
// fuzzer's bytes are what comes before it, and what is made of them must be usable.
#include "framework/core/content_hash.h"
#include "framework/reference/pixel_sums.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    using reference::PixelSums;
    const std::string content(fuzz::text(bytes, size));
    const std::string whole = content + ContentHash().addBytes(content).hex();
    return fuzz::tryToRead([&] {
        PixelSums sums = PixelSums::fromBytes(whole, fuzz::kSumsKey, "input");
        for (int layer = 0; layer < sums.layers(); ++layer) {
            static_cast<void>(sums.standardErrorImage(layer));
            static_cast<void>(sums.relativeStandardError(layer));
        }
        static_cast<void>(sums.energy());
        if (PixelSums::fromBytes(sums.toBytes(fuzz::kSumsKey), fuzz::kSumsKey, "again") != sums)
            std::abort();
        sums.merge(fuzz::smallSums());
    });
}
