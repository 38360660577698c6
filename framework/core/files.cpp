// SPDX-License-Identifier: MIT
#include "framework/core/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

#include "framework/core/error.h"

namespace kaustik {
namespace fs = std::filesystem;

std::string versionString() {
    return KAUSTIK_VERSION;
}

fs::path executableFolder() {
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::current_path() : self.parent_path();
}

const fs::path& projectRoot() {
    static const fs::path root = [] {
        if (const char* fromEnvironment = std::getenv("KAUSTIK_ROOT")) {
            if (*fromEnvironment != '\0') return fs::path(fromEnvironment);
        }
        for (fs::path folder = executableFolder(); folder.has_relative_path();
             folder = folder.parent_path()) {
            if (fs::exists(folder / "shaders/common")) return folder;
        }
        return fs::path(KAUSTIK_SOURCE_DIR);
    }();
    return root;
}

std::string readFile(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        throw IoError(fmt::format("{} is a directory, not a file.", path.string()));
    }
    const auto fail = [&] {
        throw IoError(fmt::format("{} cannot be read: {}.", path.string(), std::strerror(errno)));
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (file == nullptr) fail();
    std::string bytes;
    std::array<char, 65536> block{};
    // A stream would take an error at the first byte for an empty file.
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
        bytes.append(block.data(), count);
    }
    if (std::ferror(file.get()) != 0) fail();
    return bytes;
}

void writeFileWhole(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    fs::create_directories(folder, error);
    if (error) {
        throw IoError(
            fmt::format("The folder {} cannot be made: {}.", folder.string(), error.message()));
    }
    const fs::path temporary = folder / fmt::format(".{}.{}.part{}", path.stem().string(),
                                                    ::getpid(), path.extension().string());
    struct Cleanup {
        const fs::path& file;
        ~Cleanup() {
            std::error_code ignored;
            fs::remove(file, ignored);
        }
    } cleanup{temporary};
    write(temporary);
    fs::rename(temporary, path, error);
    if (error) {
        throw IoError(fmt::format("{} cannot be written: {}.", path.string(), error.message()));
    }
}

void writeFileWhole(const fs::path& path, std::string_view bytes) {
    writeFileWhole(path, [&](const fs::path& temporary) {
        errno = 0;
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        stream.flush();
        if (!stream) {
            throw IoError(
                fmt::format("{} cannot be written: {}.", path.string(), std::strerror(errno)));
        }
    });
}

}  // namespace kaustik
