// SPDX-License-Identifier: MIT
// OpenEXR and PNG files as the module that is not OpenImageIO's reads them, in this process.
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
    const bool isRead = kaustikImageFunctions()->readMemory(bytes, size, &sink);
    if (isRead != received.problem.empty()) std::abort();  // an error says what is wrong
    return 0;
}
