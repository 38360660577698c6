// SPDX-License-Identifier: MIT
// What the eye sees, kept by key in a folder: KEY.view holds the images' values and a checksum.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <system_error>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/reference/view_reference.h"
#include "framework/scene/scene_hash.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

// Raised by what changes the picture.
constexpr int kTracerVersion = 1;
constexpr std::string_view kMagic = "kaustik.view/1\n";
constexpr std::size_t kHashDigits = 32;

std::string keyOf(const scene::Scene& scene, const ViewReferenceRequest& request) {
    ContentHash hash;
    hash.addBytes(kMagic).add(kTracerVersion);
    scene::addTo(hash, scene);
    hash.add(request.width).add(request.height).add(request.samplesPerSide);
    hash.add(request.splitInteractions).add(request.maximumInteractions).add(request.seed);
    return hash.hex();
}

// What is known of a pixel that sees a specular surface; nothing is of the others.
template <class Reference>
auto imagesOf(Reference& reference) {
    return std::array{&reference.exitPosition, &reference.exitDirection, &reference.radiance,
                      &reference.radianceError};
}

// Calls `take` with each run of values of a pixel that is known.
template <class Reference, class Take>
void forEachKnown(Reference& reference, Take&& take) {
    for (std::size_t pixel = 0; pixel < reference.mask.values.size(); ++pixel) {
        if (reference.mask.values[pixel] == 0.0f) continue;
        for (auto* image : imagesOf(reference)) {
            const auto channels = static_cast<std::size_t>(image->channels);
            take(image->values.data() + pixel * channels, channels * sizeof(float));
        }
    }
}

std::string toBytes(const ViewReference& reference, const std::string& key) {
    std::string content = std::string(kMagic) + key;
    const auto append = [&](const float* values, std::size_t size) {
        content.append(reinterpret_cast<const char*>(values), size);
    };
    append(reference.mask.values.data(), reference.mask.values.size() * sizeof(float));
    forEachKnown(reference, append);
    return content + ContentHash().addBytes(content).hex();
}

// `reference` is empty, of its images' sizes; false: the bytes are of no such picture.
bool readBytes(std::string_view bytes, const std::string& key, ViewReference& reference) {
    const std::string head = std::string(kMagic) + key;
    if (bytes.size() < head.size() + kHashDigits || !bytes.starts_with(head)) return false;
    std::string_view content = bytes.substr(0, bytes.size() - kHashDigits);
    if (ContentHash().addBytes(content).hex() != bytes.substr(content.size())) return false;
    content.remove_prefix(head.size());
    const auto take = [&](float* values, std::size_t size) {
        const std::size_t there = std::min(size, content.size());
        std::memcpy(values, content.data(), there);
        content.remove_prefix(there);
    };
    take(reference.mask.values.data(), reference.mask.values.size() * sizeof(float));
    forEachKnown(reference, take);
    reference.countPixels();
    return content.empty();
}

}  // namespace

ViewReference loadOrTraceView(const EmbreeScene& scene, const ViewReferenceRequest& request,
                              const fs::path& cacheFolder,
                              const std::function<void(const std::string&)>& report) {
    const std::string key = keyOf(scene.scene(), request);
    const fs::path path = cacheFolder / (key + ".view");
    std::error_code error;
    if (fs::exists(path, error)) {
        ViewReference kept = emptyView(request);
        try {
            if (readBytes(readFile(path), key, kept)) return kept;
            report(fmt::format("{} is damaged and is made again.", path.string()));
        } catch (const Error& problem) {
            report(problem.what());
        }
    }
    ViewReference traced = traceView(scene, request);
    try {
        writeFileWhole(path, toBytes(traced, key));
    } catch (const IoError& problem) {
        report(problem.what());  // it is there, and made again the next time
    }
    return traced;
}

}  // namespace kaustik::reference
