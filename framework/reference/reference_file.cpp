// SPDX-License-Identifier: MIT
// References in files: float images and a JSON sidecar (schema kaustik.reference/2).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_number.h"
#include "framework/core/json_text.h"
#include "framework/reference/class_file.h"
#include "framework/reference/reference.h"
#include "framework/reference/request_json.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSchema = "kaustik.reference/2";

struct Part {
    const char* name;    // in the sidecar
    const char* suffix;  // of the file
    Image Reference::*image;
};
constexpr std::array<Part, 8> kParts = {{
    {"irradiance", "", &Reference::irradiance},
    {"irradiance_stderr", ".stderr", &Reference::irradianceError},
    {"caustic_radiance", ".caustic_radiance", &Reference::causticRadiance},
    {"caustic_radiance_stderr", ".caustic_radiance.stderr", &Reference::causticRadianceError},
    {"caustic_view", ".caustic_view", &Reference::causticView},
    {"caustic_view_stderr", ".caustic_view.stderr", &Reference::causticViewError},
    {"in_scattered", ".in_scattered", &Reference::inScattered},
    {"in_scattered_stderr", ".in_scattered.stderr", &Reference::inScatteredError},
}};

fs::path partPath(const fs::path& path, const Part& part) {
    return path.parent_path() / (path.stem().string() + part.suffix + path.extension().string());
}

fs::path sidecarPath(const fs::path& path) {
    return fs::path(path).replace_extension(".json");
}

std::string fingerprint(const Image& image) {
    return ContentHash()
        .add(image.width)
        .add(image.height)
        .add(image.channels)
        .addAll(image.values)
        .hex();
}

bool isFinite(const Image& image) {
    for (const float value : image.values) {
        if (!std::isfinite(value)) return false;
    }
    return true;
}

// JSON has no infinity.
json number(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

Energy energyFromJson(const json& from) {
    using namespace transport;
    Energy energy;
    energy.watts[kAccountEmitted] = from.at("emitted_w");
    energy.watts[kAccountDeposited] = from.at("deposited_w");
    energy.watts[kAccountAbsorbed] = from.at("absorbed_w");
    energy.watts[kAccountLeftScene] = from.at("left_scene_w");
    const json& lost = from.at("lost_w");
    energy.watts[kAccountUntracedBranch] = lost.at("untraced_branch");
    energy.watts[kAccountInternalReflectionLimit] = lost.at("internal_reflection_limit");
    energy.watts[kAccountBounceLimit] = lost.at("bounce_limit");
    energy.watts[kAccountNotANumber] = lost.at("not_a_number");
    energy.visibleWatts = from.at("visible_w");
    return energy;
}

}  // namespace

void writeReference(const fs::path& path, const Reference& reference) {
    json images = json::object();
    for (const Part& part : kParts) {
        const Image& image = reference.*part.image;
        if (image.values.empty()) continue;
        if (!isFinite(image))
            throw IoError(fmt::format("{} would hold values that are no numbers.",
                                      partPath(path, part).string()));
        writeImage(partPath(path, part), image);
        images[part.name] = {{"file", partPath(path, part).filename().string()},
                             {"fingerprint", fingerprint(image)}};
    }
    if (!reference.classes.empty()) {
        writeClasses(classFile(path), reference);
        images["classes"] = {{"file", classFile(path).filename().string()},
                             {"fingerprint", fingerprintOf(reference.classes)}};
    }
    const json sidecar = {{"schema", kSchema},
                          {"version", versionString()},
                          {"key", reference.key},
                          {"scene", reference.scene},
                          {"request", requestToJson(reference.request)},
                          {"images", images},
                          {"photons", reference.photons},
                          {"batches", reference.batches},
                          {"rejected_values", reference.rejectedValues},
                          {"relative_stderr", number(reference.relativeError)},
                          {"compute_s", reference.seconds},
                          {"energy", toJson(reference.energy)}};
    writeFileWhole(sidecarPath(path), jsonText(sidecar, 2) + "\n");
}

Reference readReference(const fs::path& path, const std::string& expectedKey) {
    const fs::path sidecar = sidecarPath(path);
    Reference reference;
    json images;
    try {
        const json from = parseJson(readFile(sidecar), sidecar.string());
        if (from.at("schema") != kSchema)
            throw IoError(fmt::format("{} is not a reference of this version.", sidecar.string()));
        reference.key = from.at("key");
        reference.scene = from.at("scene");
        reference.request = requestFromJson(from.at("request"));
        reference.photons = wholeNumber<std::uint64_t>(from.at("photons"));
        reference.batches = wholeNumber<std::uint64_t>(from.at("batches"));
        reference.rejectedValues = wholeNumber<std::uint64_t>(from.at("rejected_values"));
        const json& error = from.at("relative_stderr");
        reference.relativeError = error.is_null() ? HUGE_VAL : error.get<double>();
        reference.seconds = from.at("compute_s");
        reference.energy = energyFromJson(from.at("energy"));
        images = from.at("images");
        if (!expectedKey.empty() && reference.key != expectedKey) {
            throw ConfigError(fmt::format(
                "{} is the reference of another scene, view or setting (scene '{}', {}x{}).",
                path.string(), reference.scene, reference.request.width, reference.request.height));
        }
        for (const Part& part : kParts) {
            if (!images.contains(part.name)) continue;
            const fs::path file = partPath(path, part);
            Image& image = reference.*part.image;
            image = readImage(file);
            if (images.at(part.name).at("fingerprint") != fingerprint(image)) {
                throw IoError(fmt::format("{} does not belong to {}, or it is damaged.",
                                          file.string(), sidecar.string()));
            }
            if (!isFinite(image))
                throw IoError(fmt::format("{} holds values that are no numbers.", file.string()));
        }
        if (images.contains("classes")) {
            ClassLayers layers = readClasses(classFile(path));
            if (images.at("classes").at("fingerprint") != fingerprintOf(layers.classes)) {
                throw IoError(fmt::format("{} does not belong to {}, or it is damaged.",
                                          classFile(path).string(), sidecar.string()));
            }
            reference.classes = std::move(layers.classes);
        }
    } catch (const json::exception& error) {
        throw IoError(fmt::format("{} is damaged: {}.", sidecar.string(), error.what()));
    }
    if (reference.irradiance.values.empty() ||
        reference.irradiance.width != reference.request.width ||
        reference.irradiance.height != reference.request.height ||
        reference.irradianceError.values.size() != reference.irradiance.values.size()) {
        throw IoError(fmt::format("{} does not hold the images that it names.", sidecar.string()));
    }
    return reference;
}

}  // namespace kaustik::reference
