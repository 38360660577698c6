// SPDX-License-Identifier: MIT
// OpenEXR and PNG files as the module that is not OpenImageIO's reads them, in this process.
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
    std::string problem;
};

// As the program's, no more than its bytes can hold.
constexpr std::int64_t kMaxValues = std::int64_t{1} << 24;

float* allocate(void* context, int width, int height, int channels) {
    const std::int64_t values = std::int64_t{width} * height * channels;
    if (values > kMaxValues) return nullptr;
    auto& received = *static_cast<Received*>(context);
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
    const bool isRead = kaustikImageFunctions()->readMemory(bytes, size, &sink);
    if (isRead != received.problem.empty()) std::abort();  // an error says what is wrong
    return 0;
}
