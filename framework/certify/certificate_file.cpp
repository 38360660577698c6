// SPDX-License-Identifier: MIT
// Certificates and their parts in files. A part is two lines of text (the format,
// kaustik.certificate-part/1, and a JSON object) and then the sums.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "framework/certify/certificate.h"
#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"

namespace kaustik::certify {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSchema = "kaustik.certificate/1";
constexpr const char* kPartFormat = "kaustik.certificate-part/1";

struct Layer {
    const char* name;
    Image Certificate::*image;
};
constexpr std::array<Layer, 3> kLayers = {{{"lower", &Certificate::lower},
                                           {"upper", &Certificate::upper},
                                           {"undecided", &Certificate::undecided}}};

fs::path layerPath(const fs::path& path, const Layer& layer) {
    return path.parent_path() /
           fmt::format("{}.{}{}", path.stem().string(), layer.name, path.extension().string());
}

std::string fingerprint(const Image& image) {
    return ContentHash()
        .add(image.width)
        .add(image.height)
        .add(image.channels)
        .addAll(image.values)
        .hex();
}

json requestJson(const CertificateRequest& request) {
    return {{"size", {request.width, request.height}},
            {"interactions", request.beams.interactions},
            {"transmission_only", request.beams.transmissionOnly},
            {"band_px", request.beams.bandPixels},
            {"depth", request.beams.maxDepth}};
}

CertificateRequest requestOf(const json& object) {
    CertificateRequest request;
    request.width = object.at("size").at(0).get<int>();
    request.height = object.at("size").at(1).get<int>();
    request.beams.interactions = object.at("interactions").get<int>();
    request.beams.transmissionOnly = object.at("transmission_only").get<bool>();
    request.beams.bandPixels = object.at("band_px").get<double>();
    request.beams.maxDepth = object.at("depth").get<int>();
    if (request.width < 1 || request.height < 1 || request.width > 16384 || request.height > 16384)
        throw IoError("its size is out of range");
    return request;
}

json intervalJson(const Interval& interval) {
    return {interval.lo, interval.hi};
}

Interval intervalOf(const json& array) {
    return {array.at(0).get<double>(), array.at(1).get<double>()};
}

}  // namespace

void writePart(const fs::path& file, const CertificatePart& part) {
    const std::string bytes = part.sums.toBytes();
    const json head = {{"key", part.key},
                       {"version", versionString()},
                       {"scene", part.scene},
                       {"request", requestJson(part.request)},
                       {"shard", {part.shard.number, part.shard.count}},
                       {"blocks", part.blocks},
                       {"blocks_done", part.blocksDone},
                       {"facets", part.facets},
                       {"irradiance_scale", part.irradianceScale},
                       {"watt_scale", part.wattScale},
                       {"seconds", part.seconds},
                       {"fingerprint", ContentHash().addBytes(bytes).hex()}};
    writeFileWhole(file, fmt::format("{}\n{}\n", kPartFormat, head.dump()) + bytes);
}

CertificatePart readPart(const fs::path& file) {
    const std::string all = readFile(file);
    const std::string name = file.string();
    const std::size_t first = all.find('\n');
    if (first == std::string::npos || all.substr(0, first) != kPartFormat)
        throw IoError(fmt::format("{} is no part of a certificate.", name));
    const std::size_t second = all.find('\n', first + 1);
    const auto damaged = [&](const std::string& what) {
        return IoError(fmt::format("{} is damaged: {}.", name, what));
    };
    if (second == std::string::npos) throw damaged("it is cut off");
    CertificatePart part;
    try {
        const json head = json::parse(all.substr(first + 1, second - first - 1));
        part.key = head.at("key").get<std::string>();
        part.scene = head.at("scene").get<std::string>();
        part.request = requestOf(head.at("request"));
        part.shard = {head.at("shard").at(0).get<std::uint64_t>(),
                      head.at("shard").at(1).get<std::uint64_t>()};
        part.blocks = head.at("blocks").get<std::uint64_t>();
        part.blocksDone = head.at("blocks_done").get<std::uint64_t>();
        part.facets = head.at("facets").get<std::size_t>();
        part.irradianceScale = head.at("irradiance_scale").get<double>();
        part.wattScale = head.at("watt_scale").get<double>();
        part.seconds = head.at("seconds").get<double>();
        const std::string_view bytes = std::string_view(all).substr(second + 1);
        if (ContentHash().addBytes(bytes).hex() != head.at("fingerprint").get<std::string>())
            throw damaged("its sums are not those that it was written with");
        if (part.facets > bytes.size()) throw damaged("its facets are more than its bytes");
        part.sums = BoundSums(static_cast<std::size_t>(part.request.width) *
                                  static_cast<std::size_t>(part.request.height),
                              part.facets, part.irradianceScale, part.wattScale);
        part.sums.readBytes(bytes, name);
    } catch (const json::exception& problem) {
        throw damaged(problem.what());
    }
    return part;
}

json toJson(const Certificate& certificate) {
    const Tightness tightness = tightnessOf(certificate);
    const Totals& totals = certificate.totals;
    return {{"schema", kSchema},
            {"version", versionString()},
            {"key", certificate.key},
            {"scene", certificate.scene},
            {"request", requestJson(certificate.request)},
            {"cells", certificate.cells},
            {"seconds", certificate.seconds},
            {"energy",
             {{"emitted_w", intervalJson(totals.emitted)},
              {"deposited_w", intervalJson(totals.deposited)},
              {"beyond_interactions_w", intervalJson(totals.limited)},
              {"undecided_w", totals.undecided}}},
            {"pixels",
             {{"all", tightness.pixels},
              {"lit", tightness.lit},
              {"undecided", tightness.undecided},
              {"median_width", tightness.medianWidth},
              {"p95_width", tightness.p95Width}}},
            {"deposited_width", tightness.totalWidth}};
}

void writeCertificate(const fs::path& path, const Certificate& certificate) {
    const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
    FilesTogether files(folder);
    const fs::path work = files.workFolder() / path.filename();
    json sidecar = toJson(certificate);
    for (const Layer& layer : kLayers) {
        const Image& image = certificate.*layer.image;
        writeImage(layerPath(work, layer), image);
        sidecar["files"][layer.name] = {{"file", layerPath(path, layer).filename().string()},
                                        {"fingerprint", fingerprint(image)}};
    }
    const fs::path name = fs::path(path.filename()).replace_extension(".json");
    writeFileWhole(files.workFolder() / name, sidecar.dump(2) + "\n");
    files.publish(name.string());
}

Certificate readCertificate(const fs::path& path, const std::string& expectedKey) {
    const fs::path sidecar = fs::path(path).replace_extension(".json");
    const auto damaged = [&](const std::string& what) {
        return IoError(fmt::format("{} is no whole certificate: {}.", path.string(), what));
    };
    Certificate result;
    try {
        const json object = json::parse(readFile(sidecar));
        if (object.at("schema").get<std::string>() != kSchema)
            throw damaged("it is of another kind");
        result.key = object.at("key").get<std::string>();
        if (!expectedKey.empty() && result.key != expectedKey) {
            throw ConfigError(
                fmt::format("{} is of another scene, size or time, or of this one before a change.",
                            path.string()));
        }
        result.scene = object.at("scene").get<std::string>();
        result.request = requestOf(object.at("request"));
        result.cells = object.at("cells").get<std::uint64_t>();
        result.seconds = object.at("seconds").get<double>();
        const json& energy = object.at("energy");
        result.totals = {intervalOf(energy.at("emitted_w")), intervalOf(energy.at("deposited_w")),
                         intervalOf(energy.at("beyond_interactions_w")),
                         energy.at("undecided_w").get<double>()};
        for (const Layer& layer : kLayers) {
            const Image image = readImage(layerPath(path, layer));
            if (fingerprint(image) !=
                object.at("files").at(layer.name).at("fingerprint").get<std::string>())
                throw damaged(fmt::format("{} is another's", layerPath(path, layer).string()));
            result.*layer.image = image;
        }
    } catch (const json::exception& problem) {
        throw damaged(problem.what());
    }
    return result;
}

}  // namespace kaustik::certify
