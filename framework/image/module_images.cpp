// SPDX-License-Identifier: MIT
#include "framework/image/module_images.h"

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <functional>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/image/image_limits.h"
#include "framework/image/module_loader.h"

namespace kaustik {
namespace {

// Receives what the module makes; see KaustikImageSink.
struct Received {
    std::uintmax_t sourceBytes = 0;  // of the file that is read
    Image image;
    std::vector<std::string> channels;
    std::vector<LayeredImage::Attribute> attributes;
    std::string bytes;
    std::string problem;
};

// No exception may cross the module's C frames, so that running out of memory is a return value
// here.
KaustikImageSink sinkFor(Received& received) {
    KaustikImageSink sink{};
    sink.context = &received;
    sink.allocate = [](void* context, int width, int height, int channels) -> float* {
        try {
            auto& target = *static_cast<Received*>(context);
            const std::int64_t values = std::int64_t{width} * height * channels;
            if (values > kUnaskedValues &&
                static_cast<std::uintmax_t>(values / kMaxValuesPerByte) > target.sourceBytes) {
                target.problem = fmt::format(
                    "it is damaged or cut off ({} bytes cannot hold the {}x{} pixels that its "
                    "header claims)",
                    target.sourceBytes, width, height);
                return nullptr;
            }
            target.image = Image(width, height, channels);
            return target.image.values.data();
        } catch (const std::exception&) {
            return nullptr;
        }
    };
    sink.append = [](void* context, const unsigned char* bytes, std::size_t count) {
        try {
            static_cast<Received*>(context)->bytes.append(reinterpret_cast<const char*>(bytes),
                                                          count);
            return true;
        } catch (const std::exception&) {
            return false;
        }
    };
    sink.fail = [](void* context, const char* message) {
        try {
            auto& target = *static_cast<Received*>(context);
            if (target.problem.empty()) target.problem = message;
        } catch (const std::exception&) {
            // The caller still learns that it failed.
        }
    };
    sink.channel = [](void* context, const char* name) {
        try {
            static_cast<Received*>(context)->channels.emplace_back(name);
            return true;
        } catch (const std::exception&) {
            return false;
        }
    };
    sink.attribute = [](void* context, const char* name, const char* value) {
        try {
            static_cast<Received*>(context)->attributes.push_back({name, value});
            return true;
        } catch (const std::exception&) {
            return false;
        }
    };
    return sink;
}

using ModuleCall = std::function<bool(const KaustikImageFunctions&, const KaustikImageSink&)>;

// Calls the module; an IoError that names the file where it is missing or fails.
Received callModule(const std::string& name, const char* verb, std::uintmax_t sourceBytes,
                    const ModuleCall& call) {
    const ImageModule& module = imageModule();
    if (module.functions == nullptr) {
        throw IoError(fmt::format("{} cannot be {}: {}.", name, verb, module.problem));
    }
    Received received;
    received.sourceBytes = sourceBytes;
    const KaustikImageSink sink = sinkFor(received);
    if (!call(*module.functions, sink)) {
        throw IoError(fmt::format("{} cannot be {}: {}.", name, verb,
                                  received.problem.empty() ? "out of memory" : received.problem));
    }
    return received;
}

}  // namespace

Image readByModule(const std::filesystem::path& path, const std::string& name) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    return callModule(name, "read", error ? 0 : size,
                      [&](const auto& functions, const auto& sink) {
                          return functions.readFile(path.c_str(), &sink);
                      })
        .image;
}

Image decodeByModule(std::string_view bytes, const std::string& name) {
    return callModule(name, "read", bytes.size(),
                      [&](const auto& functions, const auto& sink) {
                          return functions.readMemory(
                              reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                              &sink);
                      })
        .image;
}

std::string encodeExr(const Image& image, const std::string& name) {
    return callModule(name, "written", 0,
                      [&](const auto& functions, const auto& sink) {
                          return functions.encodeExr(image.values.data(), image.width, image.height,
                                                     image.channels, &sink);
                      })
        .bytes;
}

std::string encodePng(const Image& image, const std::vector<unsigned char>& values,
                      const std::string& name) {
    return callModule(name, "written", 0,
                      [&](const auto& functions, const auto& sink) {
                          return functions.encodePng(values.data(), image.width, image.height,
                                                     image.channels, &sink);
                      })
        .bytes;
}

LayeredImage readLayersByModule(const std::filesystem::path& path, const std::string& name) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    Received received =
        callModule(name, "read", error ? 0 : size, [&](const auto& functions, const auto& sink) {
            return functions.readLayers(path.c_str(), &sink);
        });
    return {received.image.width, received.image.height, std::move(received.channels),
            std::move(received.image.values), std::move(received.attributes)};
}

std::string encodeLayersByModule(const LayeredImage& image, const std::string& name) {
    std::vector<const char*> channels;
    for (const std::string& channel : image.channels)
        channels.push_back(channel.c_str());
    std::vector<const char*> attributeNames;
    std::vector<const char*> attributeValues;
    for (const LayeredImage::Attribute& attribute : image.attributes) {
        attributeNames.push_back(attribute.name.c_str());
        attributeValues.push_back(attribute.value.c_str());
    }
    const KaustikImageLayers layers{channels.data(), attributeNames.size(), attributeNames.data(),
                                    attributeValues.data()};
    return callModule(name, "written", 0,
                      [&](const auto& functions, const auto& sink) {
                          return functions.encodeLayers(
                              image.values.data(), image.width, image.height,
                              static_cast<int>(channels.size()), &layers, &sink);
                      })
        .bytes;
}

}  // namespace kaustik
