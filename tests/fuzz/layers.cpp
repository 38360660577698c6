// SPDX-License-Identifier: MIT
// OpenEXR files with all their layers and texts, as the module that is not OpenImageIO's reads
// them, in this process.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "framework/image/module_interface.h"
#include "tests/fuzz/received_image.h"
#include "tests/fuzz/target.h"

extern "C" const KaustikImageFunctions* kaustikImageFunctions();

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    kaustik::fuzz::ReceivedImage received;
    KaustikImageSink sink = kaustik::fuzz::sinkInto(received);
    const std::string file = kaustik::fuzz::inputFile("input.exr", bytes, size).string();
    const bool isRead = kaustikImageFunctions()->readLayers(file.c_str(), &sink);
    if (isRead != received.problem.empty()) std::abort();             // an error says what is wrong
    if (isRead && received.names != received.channels) std::abort();  // each channel has a name
    return 0;
}
