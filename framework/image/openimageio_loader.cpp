// SPDX-License-Identifier: MIT
#include "framework/image/openimageio_loader.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <system_error>

#include "framework/core/files.h"

namespace kaustik {
namespace {

constexpr const char* kAlternative = "use .pfm for float images and .ppm for pictures instead";

}  // namespace

OpenImageIoModule loadOpenImageIoModule(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        return {nullptr, fmt::format("this build has no OpenImageIO ({} is not there); {}",
                                     file.string(), kAlternative)};
    }
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        const char* const reason = ::dlerror();
        return {nullptr, fmt::format("OpenImageIO cannot be loaded ({}); {}",
                                     reason != nullptr ? reason : file.c_str(), kAlternative)};
    }
    const auto entry =
        reinterpret_cast<KaustikOpenImageIoEntry>(::dlsym(library, kKaustikOpenImageIoSymbol));
    const KaustikOpenImageIoFunctions* const functions = entry != nullptr ? entry() : nullptr;
    if (functions == nullptr || functions->version != kKaustikOpenImageIoVersion) {
        ::dlclose(library);
        return {nullptr, fmt::format("{} belongs to another version of the program; build the "
                                     "target kaustik_openimageio again, or {}",
                                     file.string(), kAlternative)};
    }
    return {functions, ""};
}

const OpenImageIoModule& openImageIo() {
    static const OpenImageIoModule module =
        loadOpenImageIoModule(helperFolder() / "kaustik_openimageio.so");
    return module;
}

}  // namespace kaustik
