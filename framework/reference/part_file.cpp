// SPDX-License-Identifier: MIT
#include "framework/reference/part_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_number.h"
#include "framework/core/json_text.h"
#include "framework/reference/request_json.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFormat = "kaustik.part/1";
constexpr std::size_t kMaxHeadBytes = 1u << 20;
constexpr int kFastest = 1;                           // for zlib
constexpr std::uint64_t kMaxCompressionRatio = 1100;  // that zlib can reach

[[noreturn]] void failDamaged(const fs::path& file, const std::string& what) {
    throw IoError(fmt::format(
        "{} is no usable part of a reference: {}. Delete it and compute its shard again.",
        file.string(), what));
}

// Byte i of every value, then byte i + 1 …: those that are noise, and those that are zero.
std::string byPlace(std::string_view bytes) {
    std::string planes(bytes.size(), '\0');
    std::size_t next = 0;
    for (std::size_t place = 0; place < sizeof(Int128); ++place) {
        for (std::size_t i = place; i < bytes.size(); i += sizeof(Int128))
            planes[next++] = bytes[i];
    }
    return planes;
}

std::string inOrder(std::string_view planes) {
    std::string bytes(planes.size(), '\0');
    std::size_t next = 0;
    for (std::size_t place = 0; place < sizeof(Int128); ++place) {
        for (std::size_t i = place; i < bytes.size(); i += sizeof(Int128))
            bytes[i] = planes[next++];
    }
    return bytes;
}

std::string compressed(const std::string& bytes) {
    const std::string planes = byPlace(bytes);
    uLongf size = ::compressBound(planes.size());
    std::string result(size, '\0');
    const int status =
        ::compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                    reinterpret_cast<const Bytef*>(planes.data()), planes.size(), kFastest);
    if (status != Z_OK) throw std::bad_alloc();  // the room is enough, so it can be nothing else
    result.resize(size);
    return result;
}

// The one that sums end with, and are checked by.
std::string checksumOf(const std::string& sums) {
    return sums.substr(sums.size() - std::min<std::size_t>(sums.size(), 32));
}

json rangesToJson(const std::vector<BatchRange>& ranges) {
    json result = json::array();
    for (const BatchRange& range : ranges)
        result.push_back({range.first, range.end});
    return result;
}

json toJson(const PartHead& head) {
    json layers = {{"in_scattered", head.subject.inScatteredLayer},
                   {"caustic_radiance", head.subject.causticRadianceLayer},
                   {"caustic_view", head.subject.causticViewLayer}};
    if (head.subject.firstClassLayer >= 0) layers["classes"] = head.subject.firstClassLayer;
    return {{"version", head.version},
            {"key", head.subject.key},
            {"scene", head.subject.scene},
            {"request", requestToJson(head.subject.request)},
            {"layers", std::move(layers)},
            {"shard", {head.shard.number, head.shard.count}},
            {"batches_of_all", head.batchesOfAll},
            {"batches", rangesToJson(head.batches)},
            {"compute_s", head.seconds},
            {"fingerprint", head.fingerprint},
            {"sums_bytes", head.sumsBytes},
            {"compressed_bytes", head.compressedBytes}};
}

PartHead headFromJson(const json& from) {
    PartHead head;
    head.version = from.at("version");
    head.subject.key = from.at("key");
    head.subject.scene = from.at("scene");
    head.subject.request = requestFromJson(from.at("request"));
    const json& layers = from.at("layers");
    head.subject.inScatteredLayer = wholeNumber<int>(layers.at("in_scattered"));
    head.subject.causticRadianceLayer = wholeNumber<int>(layers.at("caustic_radiance"));
    head.subject.causticViewLayer = wholeNumber<int>(layers.at("caustic_view"));
    if (layers.contains("classes"))
        head.subject.firstClassLayer = wholeNumber<int>(layers.at("classes"));
    head.shard = {wholeNumber<std::uint64_t>(from.at("shard").at(0)),
                  wholeNumber<std::uint64_t>(from.at("shard").at(1))};
    head.batchesOfAll = wholeNumber<std::uint64_t>(from.at("batches_of_all"));
    for (const json& range : from.at("batches"))
        head.batches.push_back(
            {wholeNumber<std::uint64_t>(range.at(0)), wholeNumber<std::uint64_t>(range.at(1))});
    head.seconds = from.at("compute_s");
    head.fingerprint = from.at("fingerprint");
    head.sumsBytes = wholeNumber<std::uint64_t>(from.at("sums_bytes"));
    head.compressedBytes = wholeNumber<std::uint64_t>(from.at("compressed_bytes"));
    return head;
}

void requireConsistent(const PartHead& head, const fs::path& file) {
    const Shard& shard = head.shard;
    if (shard.count < 1 || shard.count > kMaxShards || shard.number < 1 ||
        shard.number > shard.count ||
        head.sumsBytes > kMaxCompressionRatio * (head.compressedBytes + 1)) {
        failDamaged(file, "its numbers make no sense");
    }
    const int classLayer = head.subject.firstClassLayer;
    if (head.subject.request.classes.empty() ? classLayer != -1
                                             : classLayer < 1 || classLayer > kMaximumClasses)
        failDamaged(file, "its classes make no sense");
    const BatchRange own = head.own();
    std::uint64_t end = own.first;
    for (const BatchRange& range : head.batches) {
        if (range.first < end || range.end <= range.first || range.end > own.end)
            failDamaged(file, "it holds batches of other shards");
        end = range.end;
    }
}

// A line without its end; leaves the stream behind it.
std::string readLine(std::istream& stream, std::size_t maximum) {
    std::string line;
    for (int c = stream.get(); c != EOF && c != '\n' && line.size() < maximum; c = stream.get())
        line += static_cast<char>(c);
    return line;
}

std::ifstream opened(const fs::path& file) {
    std::error_code error;
    if (fs::is_directory(file, error))
        throw IoError(fmt::format("{} is a directory, not a file.", file.string()));
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw IoError(fmt::format("{} cannot be read: {}.", file.string(), std::strerror(errno)));
    return stream;
}

PartHead readHead(std::istream& stream, const fs::path& file) {
    if (readLine(stream, std::strlen(kFormat) + 1) != kFormat)
        failDamaged(file, "it does not begin like one of this version");
    const std::string text = readLine(stream, kMaxHeadBytes);
    if (ContentHash().addBytes(text).hex() != readLine(stream, 64))
        failDamaged(file, "the checksum of its head is wrong");
    try {
        PartHead head = headFromJson(parseJson(text, file.string()));
        requireConsistent(head, file);
        return head;
    } catch (const json::exception& error) {
        failDamaged(file, error.what());
    }
}

}  // namespace

BatchRange PartHead::own() const {
    const auto [first, end] = rangeOf(shard, batchesOfAll);
    return {first, end};
}

std::uint64_t PartHead::batchCount() const {
    std::uint64_t count = 0;
    for (const BatchRange& range : batches)
        count += range.end - range.first;
    return count;
}

void writePart(const fs::path& file, PartHead head, const PixelSums& sums) {
    const std::string bytes = sums.toBytes(head.subject.key);
    const std::string body = compressed(bytes);
    head.batches = sums.batches();
    head.fingerprint = checksumOf(bytes);
    head.sumsBytes = bytes.size();
    head.compressedBytes = body.size();
    const std::string text = jsonText(toJson(head));
    writeFileWhole(
        file,
        fmt::format("{}\n{}\n{}\n", kFormat, text, ContentHash().addBytes(text).hex()) + body);
}

PartHead readPartHead(const fs::path& file) {
    std::ifstream stream = opened(file);
    return readHead(stream, file);
}

PixelSums readPartSums(const fs::path& file, const PartHead& head) {
    std::ifstream stream = opened(file);
    if (readHead(stream, file).fingerprint != head.fingerprint)
        throw IoError(fmt::format("{} has changed while it was read.", file.string()));
    std::error_code error;
    if (fs::file_size(file, error) !=
        static_cast<std::uint64_t>(stream.tellg()) + head.compressedBytes)
        failDamaged(file, "it is shorter or longer than its head says");
    std::string body(head.compressedBytes, '\0');
    stream.read(body.data(), static_cast<std::streamsize>(body.size()));
    std::string planes(head.sumsBytes, '\0');
    uLongf size = planes.size();
    const int status = ::uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                                    reinterpret_cast<const Bytef*>(body.data()), body.size());
    if (!stream || status != Z_OK || size != planes.size())
        failDamaged(file, "what is compressed in it cannot be read");
    const std::string bytes = inOrder(planes);
    if (checksumOf(bytes) != head.fingerprint) failDamaged(file, "its checksum is wrong");
    PixelSums sums = PixelSums::fromBytes(bytes, head.subject.key, file.string());
    const ReferenceRequest& request = head.subject.request;
    const int layers =
        head.subject.firstClassLayer < 0
            ? sums.layers()
            : head.subject.firstClassLayer + static_cast<int>(request.classes.size()) + 1;
    if (sums.batches() != head.batches || sums.width() != request.width ||
        sums.height() != request.height || sums.layers() != layers)
        failDamaged(file, "its head is not that of its sums");
    return sums;
}

}  // namespace kaustik::reference
