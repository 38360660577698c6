// SPDX-License-Identifier: MIT
// What a module of image readers hands on (framework/image/module_interface.h), for fuzz targets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/image/module_interface.h"

namespace kaustik::fuzz {

struct ReceivedImage {
    std::vector<float> values;
    std::size_t channels = 0;
    std::size_t names = 0;
    std::string problem;
};

// As the program's, no more than its bytes can hold.
inline constexpr std::int64_t kMaxValues = std::int64_t{1} << 24;

// Writes to `received`, which must outlive it; channels' names are counted, texts let be.
inline KaustikImageSink sinkInto(ReceivedImage& received) {
    KaustikImageSink sink{};
    sink.context = &received;
    sink.allocate = [](void* context, int width, int height, int channels) -> float* {
        const std::int64_t values = std::int64_t{width} * height * channels;
        if (values > kMaxValues) return nullptr;
        auto& image = *static_cast<ReceivedImage*>(context);
        image.channels = static_cast<std::size_t>(channels);
        image.values.assign(static_cast<std::size_t>(values), 0.0f);
        return image.values.data();
    };
    sink.append = [](void*, const unsigned char*, std::size_t) { return false; };
    sink.fail = [](void* context, const char* message) {
        static_cast<ReceivedImage*>(context)->problem = message;
    };
    sink.channel = [](void* context, const char*) {
        ++static_cast<ReceivedImage*>(context)->names;
        return true;
    };
    sink.attribute = [](void*, const char*, const char*) { return true; };
    return sink;
}

}  // namespace kaustik::fuzz
