// SPDX-License-Identifier: MIT
#include "framework/run/tile_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_number.h"
#include "framework/core/json_text.h"

namespace kaustik::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFormat = "kaustik.tile/1";
constexpr const char* kSceneContent = "scene_content";  // of a subject, a fingerprint
static_assert(std::endian::native == std::endian::little);

[[noreturn]] void failDamaged(const fs::path& file, const std::string& what) {
    throw IoError(fmt::format("{} is no usable file of tiles: {}. Delete it and make it again.",
                              file.string(), what));
}

bool hasShapes(const FirstHits& list) {
    for (const FirstHitTexels& hit : list.hits) {
        if (hit.shape != glm::vec4(0.0f)) return true;
    }
    return false;
}

std::size_t bytesOfHit(bool hasShape) {
    return 3 * sizeof(std::uint32_t) + (hasShape ? 4 : 3) * sizeof(glm::vec4);
}

std::string bodyOf(const RoundOfHits& hits) {
    std::string body;
    const auto add = [&](const auto& value) {
        body.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (const auto& [suffix, list] : hits) {
        const bool hasShape = hasShapes(list);
        for (const FirstHitTexels& hit : list.hits) {
            add(hit.photon);
            add(hit.order);
            add(hit.step);
            add(hit.position);
            add(hit.surface);
            add(hit.flux);
            if (hasShape) add(hit.shape);
        }
    }
    return body;
}

json toJson(const TileCost& cost) {
    return {{"own_pixels", cost.ownPixels}, {"shown_pixels", cost.shownPixels},
            {"fragments", cost.fragments},  {"photons", cost.photons},
            {"steps", cost.steps},          {"squares", cost.squares}};
}

TileCost costFromJson(const json& from) {
    const auto number = [&](const char* name) { return wholeNumber<std::uint64_t>(from.at(name)); };
    return {number("own_pixels"), number("shown_pixels"), number("fragments"),
            number("photons"),    number("steps"),        number("squares")};
}

json toJson(const TileFile& content, const std::string& body) {
    const TileHead& head = content.head;
    json lists = json::array();
    for (const auto& [suffix, list] : content.hits) {
        lists.push_back({{"list", suffix},
                         {"photons", list.photons},
                         {"rays", list.rays},
                         {"hits", list.hits.size()},
                         {"shapes", hasShapes(list)}});
    }
    return {{"subject", head.subject},
            {"tile", head.tile ? head.tile->number : 0},
            {"tiles", head.count},
            {"round", head.round},
            {"max_rounds", head.maxRounds},
            {"complete", head.isComplete},
            {"cost", toJson(head.cost)},
            {"lists", lists},
            {"checksum", ContentHash().addBytes(body).hex()}};
}

TileHead headFromJson(const json& from) {
    TileHead head;
    head.subject = from.at("subject");
    head.count = wholeNumber<std::uint64_t>(from.at("tiles"));
    if (const auto number = wholeNumber<std::uint64_t>(from.at("tile")); number > 0)
        head.tile = Shard{number, head.count};
    head.round = wholeNumber<int>(from.at("round"));
    head.maxRounds = wholeNumber<int>(from.at("max_rounds"));
    head.isComplete = from.at("complete");
    head.cost = costFromJson(from.at("cost"));
    return head;
}

// Takes values off the front of bytes.
class Bytes {
  public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }
    template <class T>
    void take(T& value) {
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
    }

  private:
    std::string_view bytes_;
};

FirstHits listFromBytes(const json& from, Bytes& bytes, const fs::path& file) {
    FirstHits list;
    list.photons = wholeNumber<std::uint32_t>(from.at("photons"));
    list.rays = from.at("rays");
    const auto count = wholeNumber<std::uint32_t>(from.at("hits"));
    const bool hasShape = from.at("shapes");
    if (count > list.photons || bytes.left() < count * bytesOfHit(hasShape))
        failDamaged(file, "it is shorter than its head says");
    list.hits.resize(count);
    std::uint32_t next = 0;
    for (FirstHitTexels& hit : list.hits) {
        bytes.take(hit.photon);
        bytes.take(hit.order);
        bytes.take(hit.step);
        bytes.take(hit.position);
        bytes.take(hit.surface);
        bytes.take(hit.flux);
        if (hasShape) bytes.take(hit.shape);
        if (hit.photon < next || hit.photon >= list.photons)
            failDamaged(file, "its photons are not in order");
        next = hit.photon + 1;
    }
    return list;
}

std::string takeLine(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

void flatten(const json& from, const std::string& name, json& into) {
    if (!from.is_object()) {
        into[name] = from;
        return;
    }
    for (const auto& [key, value] : from.items()) {
        const bool isGroup = name.empty() || name == "parameters";
        flatten(value, isGroup ? key : name + "." + key, into);
    }
}

std::string inWords(const json& flat, const std::string& key) {
    if (!flat.contains(key)) return "missing";
    const json& value = flat.at(key);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

fs::path tilePath(const fs::path& folder, int round, const Shard& tile) {
    return folder / fmt::format("round-{}-tile-{}-of-{}.hits", round, tile.number, tile.count);
}

fs::path roundPath(const fs::path& folder, int round) {
    return folder / fmt::format("round-{}.hits", round);
}

std::uint64_t writeTileFile(const fs::path& file, const TileFile& content) {
    const std::string body = bodyOf(content.hits);
    const std::string head = jsonText(toJson(content, body));
    const std::string bytes =
        fmt::format("{}\n{}\n{}\n", kFormat, head, ContentHash().addBytes(head).hex()) + body;
    writeFileWhole(file, bytes);
    return bytes.size();
}

TileFile readTileFile(const fs::path& file) {
    const std::string bytes = readFile(file);
    std::string_view rest = bytes;
    if (takeLine(rest) != kFormat) failDamaged(file, "it does not begin like one of this version");
    const std::string head = takeLine(rest);
    if (ContentHash().addBytes(head).hex() != takeLine(rest))
        failDamaged(file, "the checksum of its head is wrong");
    try {
        const json from = parseJson(head, file.string());
        TileFile content{headFromJson(from), {}};
        if (ContentHash().addBytes(rest).hex() != from.at("checksum").get<std::string>())
            failDamaged(file, "the checksum of its hits is wrong");
        Bytes body(rest);
        for (const json& list : from.at("lists"))
            content.hits[list.at("list")] = listFromBytes(list, body, file);
        if (body.left() > 0) failDamaged(file, "it is longer than its head says");
        return content;
    } catch (const json::exception& error) {
        failDamaged(file, error.what());
    }
}

std::string differenceOf(const json& there, const json& here) {
    json thereFlat = json::object();
    json hereFlat = json::object();
    flatten(there, "", thereFlat);
    flatten(here, "", hereFlat);
    json names = thereFlat;
    names.update(hereFlat);
    for (const auto& [name, value] : names.items()) {
        const std::string before = inWords(thereFlat, name);
        const std::string now = inWords(hereFlat, name);
        // It says nothing to people; what has changed may have a name.
        if (name == kSceneContent || before == now) continue;
        return fmt::format("{} is {} there and {} here", name, before, now);
    }
    if (inWords(thereFlat, kSceneContent) == inWords(hereFlat, kSceneContent)) return "";
    return "what is in the scene is not the same there and here";
}

}  // namespace kaustik::run
