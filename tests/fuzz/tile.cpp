// SPDX-License-Identifier: MIT
// Hits on tiles of the screen. Head and hits have checksums, which no mutation would hit: the
// fuzzer's first line is the head, what follows are the hits, and both checksums are put in.
#include <nlohmann/json.hpp>

#include "framework/core/content_hash.h"
#include "framework/run/tile_file.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    const std::string_view input = fuzz::text(bytes, size);
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string_view body = input.substr(std::min(end + 1, input.size()));
    std::string head(input.substr(0, end));
    const nlohmann::json parsed = nlohmann::json::parse(head, nullptr, false);
    if (parsed.is_object()) {
        nlohmann::json summed = parsed;
        summed["checksum"] = ContentHash().addBytes(body).hex();
        head = summed.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
    const std::string content = "kaustik.tile/1\n" + head + "\n" +
                                ContentHash().addBytes(head).hex() + "\n" + std::string(body);
    return fuzz::tryToRead([&] {
        static_cast<void>(run::readTileFile(fuzz::inputFile(
            "input.hits", reinterpret_cast<const std::uint8_t*>(content.data()), content.size())));
    });
}
