// SPDX-License-Identifier: MIT
#include "framework/reference/class_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/image/layered_image.h"

namespace kaustik::reference {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKey = "kaustik.key";
constexpr const char* kScene = "kaustik.scene";
constexpr const char* kPhotons = "kaustik.photons";
constexpr const char* kClasses = "kaustik.classes";
constexpr const char* kClassPrefix = "kaustik.class.";
constexpr const char* kErrorLayer = "error";

std::string errorLayer(const std::string& name) {
    return name + "." + kErrorLayer;
}

bool isFinite(const Image& image) {
    return std::all_of(image.values.begin(), image.values.end(),
                       [](float value) { return std::isfinite(value); });
}

}  // namespace

std::vector<ClassImages> classImages(const std::vector<PathClass>& classes, const PixelSums& sums,
                                     int firstLayer) {
    const std::size_t count = classes.size() + 1;
    std::vector<ClassImages> images(count);
    for (std::size_t k = 0; k < count; ++k) {
        const bool isOther = k == classes.size();
        images[k].name = isOther ? kOtherClass : classes[k].name;
        if (!isOther) images[k].pattern = classes[k].pattern;
        images[k].irradiance = Image(sums.width(), sums.height(), 3);
        images[k].irradianceError = sums.standardErrorImage(firstLayer + static_cast<int>(k));
    }
    const std::size_t layerSize = images.front().irradiance.values.size();
    std::vector<double> exact(count);
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < layerSize; ++i) {
        for (std::size_t k = 0; k < count; ++k)
            exact[k] = sums.mean((static_cast<std::size_t>(firstLayer) + k) * layerSize + i);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(exact[a], a) < std::pair(exact[b], b);
        });
        double carried = 0.0;
        for (const std::size_t k : order) {
            const auto written = static_cast<float>(exact[k] + carried);
            carried += exact[k] - static_cast<double>(written);
            images[k].irradiance.values[i] = written;
        }
    }
    return images;
}

fs::path classFile(const fs::path& reference) {
    return reference.parent_path() / (reference.stem().string() + ".classes.exr");
}

void writeClasses(const fs::path& file, const Reference& reference) {
    LayeredImage image;
    std::string names;
    image.addLayer("", reference.irradiance);
    image.addLayer(kErrorLayer, reference.irradianceError);
    for (const ClassImages& one : reference.classes) {
        for (const Image* part : {&one.irradiance, &one.irradianceError}) {
            if (!isFinite(*part)) {
                throw IoError(
                    fmt::format("{} would hold values that are no numbers.", file.string()));
            }
        }
        image.addLayer(one.name, one.irradiance);
        image.addLayer(errorLayer(one.name), one.irradianceError);
        names += (names.empty() ? "" : " ") + one.name;
        if (!one.pattern.empty())
            image.attributes.push_back({kClassPrefix + one.name, one.pattern});
    }
    image.attributes.push_back({kKey, reference.key});
    image.attributes.push_back({kScene, reference.scene});
    image.attributes.push_back({kPhotons, std::to_string(reference.photons)});
    image.attributes.push_back({kClasses, names});
    writeLayers(file, image);
}

ClassLayers readClasses(const fs::path& file) {
    const LayeredImage image = readLayers(file);
    const std::string name = file.string();
    ClassLayers result;
    result.key = image.attribute(kKey);
    result.scene = image.attribute(kScene);
    const std::string photons = image.attribute(kPhotons);
    const auto end =
        std::from_chars(photons.data(), photons.data() + photons.size(), result.photons);
    std::istringstream names(image.attribute(kClasses));
    std::vector<std::string> classes;
    for (std::string one; names >> one;)
        classes.push_back(one);
    if (classes.empty() || result.key.empty() || end.ec != std::errc{}) {
        throw IoError(fmt::format(
            "{} is no file of classes; 'kaustik reference SCENE --classes N' makes one.", name));
    }
    if (classes.back() != kOtherClass)
        throw IoError(fmt::format("{} has no class '{}' at its end.", name, kOtherClass));
    result.irradiance = image.layer("", name);
    result.irradianceError = image.layer(kErrorLayer, name);
    for (const std::string& one : classes) {
        result.classes.push_back({one, image.attribute(kClassPrefix + one), image.layer(one, name),
                                  image.layer(errorLayer(one), name)});
    }
    for (const float value : image.values) {
        if (!std::isfinite(value))
            throw IoError(fmt::format("{} holds values that are no numbers.", name));
    }
    return result;
}

std::string fingerprintOf(const std::vector<ClassImages>& classes) {
    ContentHash hash;
    for (const ClassImages& one : classes) {
        hash.addBytes(one.name);
        for (const Image* image : {&one.irradiance, &one.irradianceError})
            hash.add(image->width).add(image->height).addAll(image->values);
    }
    return hash.hex();
}

}  // namespace kaustik::reference
