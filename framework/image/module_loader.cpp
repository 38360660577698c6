// SPDX-License-Identifier: MIT
#include "framework/image/module_loader.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <system_error>

#include "framework/core/files.h"

namespace kaustik {
namespace {

constexpr const char* kAlternative = "use .pfm for float images and .ppm for pictures instead";

}  // namespace

ImageModule loadImageModule(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        return {nullptr, fmt::format("this build has no OpenImageIO ({} is not there); {}",
                                     file.string(), kAlternative)};
    }
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        const char* const reason = ::dlerror();
        return {nullptr, fmt::format("{} cannot be loaded ({}); {}", file.filename().string(),
                                     reason != nullptr ? reason : file.c_str(), kAlternative)};
    }
    const auto entry =
        reinterpret_cast<KaustikImageEntry>(::dlsym(library, kKaustikImageModuleSymbol));
    const KaustikImageFunctions* const functions = entry != nullptr ? entry() : nullptr;
    if (functions == nullptr || functions->version != kKaustikImageModuleVersion) {
        ::dlclose(library);
        return {nullptr, fmt::format("{} belongs to another version of the program; build the "
                                     "target {} again, or {}",
                                     file.string(), file.stem().string(), kAlternative)};
    }
    return {functions, ""};
}

const ImageModule& imageModule() {
    static const ImageModule module = [] {
        const ImageModule all = loadImageModule(helperFolder() / "kaustik_openimageio.so");
        if (all.functions != nullptr) return all;
        const std::filesystem::path other = helperFolder() / "kaustik_exr_png.so";
        std::error_code error;
        // What is there but cannot be loaded is the cause.
        return std::filesystem::exists(other, error) ? loadImageModule(other) : all;
    }();
    return module;
}

}  // namespace kaustik
