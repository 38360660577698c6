// SPDX-License-Identifier: MIT
// OpenEXR files with all their layers and texts, as the module that is not OpenImageIO's reads
// them, in this process.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "framework/image/module_interface.h"
#include "tests/fuzz/target.h"

extern "C" const KaustikImageFunctions* kaustikImageFunctions();

namespace {

struct Received {
    std::vector<float> values;
    std::size_t channels = 0;
    std::size_t names = 0;
    std::string problem;
};

// As the program's, no more than its bytes can hold.
constexpr std::int64_t kMaxValues = std::int64_t{1} << 24;

float* allocate(void* context, int width, int height, int channels) {
    const std::int64_t values = std::int64_t{width} * height * channels;
    if (values > kMaxValues) return nullptr;
    auto& received = *static_cast<Received*>(context);
    received.channels = static_cast<std::size_t>(channels);
    received.values.assign(static_cast<std::size_t>(values), 0.0f);
    return received.values.data();
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    Received received;
    KaustikImageSink sink{};
    sink.context = &received;
    sink.allocate = allocate;
    sink.append = [](void*, const unsigned char*, std::size_t) { return false; };
    sink.fail = [](void* context, const char* message) {
        static_cast<Received*>(context)->problem = message;
    };
    sink.channel = [](void* context, const char*) {
        ++static_cast<Received*>(context)->names;
        return true;
    };
    sink.attribute = [](void*, const char*, const char*) { return true; };
    const std::string file = kaustik::fuzz::inputFile("input.exr", bytes, size).string();
    const bool isRead = kaustikImageFunctions()->readLayers(file.c_str(), &sink);
    if (isRead != received.problem.empty()) std::abort();             // an error says what is wrong
    if (isRead && received.names != received.channels) std::abort();  // each channel has a name
    return 0;
}
