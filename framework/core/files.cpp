// SPDX-License-Identifier: MIT
#include "framework/core/files.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "framework/core/error.h"

// The prefix, of a program that is linked elsewhere with what was installed: kaustikConfig.cmake
// defines it there, and nothing does here.
extern "C" [[gnu::weak]] const char* kaustikPrefix();

namespace kaustik {
namespace fs = std::filesystem;

std::string versionString() {
    return KAUSTIK_VERSION;
}

namespace {

// Where the program is, or was: it may be built anew while it runs.
fs::path ownProgram(std::error_code& error) {
    constexpr std::string_view kRemoved = " (deleted)";  // which Linux puts behind its name
    std::string name = fs::read_symlink("/proc/self/exe", error).string();
    if (name.ends_with(kRemoved)) name.resize(name.size() - kRemoved.size());
    return name;
}

// The program that this code is linked into, or the shared library: a module of Python, say.
fs::path ownFile() {
    Dl_info info{};
    void* found = nullptr;
    const bool isKnown = ::dladdr1(reinterpret_cast<const void*>(&versionString), &info, &found,
                                   RTLD_DL_LINKMAP) != 0;
    const auto* const library = static_cast<const link_map*>(found);
    std::error_code error;
    // The program itself has no name there, or the one that it was called by.
    const bool isLibrary = isKnown && library != nullptr && library->l_name[0] != '\0';
    const fs::path file = isLibrary ? fs::canonical(library->l_name, error) : ownProgram(error);
    return error ? fs::current_path() / "kaustik" : file;
}

struct Places {
    fs::path root;  // "" where there is none
    fs::path programs;
    fs::path helpers;
};

std::optional<Places> placesInPrefix(const fs::path& prefix) {
    const fs::path root = prefix / "share/kaustik";
    std::error_code error;
    if (!fs::is_directory(root / "shaders", error)) return {};
    return Places{root, prefix / "bin", prefix / "lib/kaustik"};
}

// CMake leaves there where the sources are, so that no program has to know.
std::optional<Places> placesInBuildTree(const fs::path& folder) {
    std::ifstream file(folder / "kaustik_source_tree");
    std::string sources;
    if (!std::getline(file, sources)) return {};
    return Places{sources, folder / "bin", folder / "bin"};
}

const Places& places() {
    static const Places found = [] {
        if (kaustikPrefix != nullptr) {
            if (const std::optional<Places> linked = placesInPrefix(kaustikPrefix())) {
                return *linked;
            }
        }
        const fs::path own = ownFile().parent_path();
        for (fs::path folder = own; folder.has_relative_path(); folder = folder.parent_path()) {
            if (const std::optional<Places> installed = placesInPrefix(folder)) return *installed;
            if (const std::optional<Places> built = placesInBuildTree(folder)) return *built;
        }
        return Places{{}, own, own};
    }();
    return found;
}

}  // namespace

const fs::path& projectRoot() {
    static const fs::path root = [] {
        if (const char* fromEnvironment = std::getenv("KAUSTIK_ROOT")) {
            if (*fromEnvironment != '\0') return fs::path(fromEnvironment);
        }
        if (places().root.empty()) {
            throw IoError(fmt::format(
                "There are no shaders and scenes near {}: it is in neither an installed prefix nor "
                "a build tree. Set KAUSTIK_ROOT to share/kaustik of a prefix, or to a source tree.",
                ownFile().string()));
        }
        return places().root;
    }();
    return root;
}

const fs::path& programFolder() {
    return places().programs;
}

const fs::path& helperFolder() {
    return places().helpers;
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

namespace {

std::string hostName() {
    std::array<char, 65> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
    return name.data();
}

// Beside the file, of this process alone, also where several machines write into a folder.
fs::path temporaryFor(const fs::path& folder, const fs::path& file) {
    return folder / fmt::format(".{}.{}.{}.part{}", file.stem().string(), hostName(), ::getpid(),
                                file.extension().string());
}

// Whether temporaryFor() made that name in a process of this machine that is no more.
bool isLeftover(const std::string& name) {
    const std::string host = fmt::format(".{}.", hostName());
    const std::size_t part = name.rfind(".part");
    if (!name.starts_with('.') || part == std::string::npos) return false;
    const std::size_t number = name.rfind('.', part - 1);
    if (number == std::string::npos || number + 1 == part) return false;
    const std::string digits = name.substr(number + 1, part - number - 1);
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 9)
        return false;
    if (!name.substr(0, number + 1).ends_with(host)) return false;
    return ::kill(std::stoi(digits), 0) != 0 && errno == ESRCH;
}

// Once a folder: afterwards only this process's own files and those of others at work are there.
void removeLeftovers(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> cleaned;
    const std::lock_guard lock(mutex);
    std::error_code error;
    if (!cleaned.insert(fs::absolute(folder, error)).second) return;
    std::vector<fs::path> found;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (isLeftover(entry->path().filename().string())) found.push_back(entry->path());
    }
    for (const fs::path& file : found)
        fs::remove_all(file, error);
}

void makeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw IoError(
            fmt::format("The folder {} cannot be made: {}.", folder.string(), error.message()));
    }
}

[[noreturn]] void failToWrite(const fs::path& path, const std::string& reason) {
    throw IoError(fmt::format("{} cannot be written: {}.", path.string(), reason));
}

}  // namespace

fs::path unfinishedPath(const fs::path& path) {
    return temporaryFor(path.has_parent_path() ? path.parent_path() : fs::path("."), path);
}

void writeFileWhole(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    makeFolder(folder);
    removeLeftovers(folder);
    const fs::path temporary = temporaryFor(folder, path);
    struct Cleanup {
        const fs::path& file;
        ~Cleanup() {
            std::error_code ignored;
            fs::remove(file, ignored);
        }
    } cleanup{temporary};
    write(temporary);
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) failToWrite(path, error.message());
}

void writeFileWhole(const fs::path& path, std::string_view bytes) {
    writeFileWhole(path, [&](const fs::path& temporary) {
        errno = 0;
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        stream.flush();
        if (!stream) failToWrite(path, std::strerror(errno));
    });
}

FilesTogether::FilesTogether(fs::path folder)
    : folder_(std::move(folder)), work_(temporaryFor(folder_, "files")) {
    makeFolder(folder_);
    removeLeftovers(folder_);
    std::error_code error;
    fs::remove_all(work_, error);  // of this process, which has failed to
    makeFolder(work_);
}

FilesTogether::~FilesTogether() {
    std::error_code ignored;
    fs::remove_all(work_, ignored);
}

fs::path FilesTogether::placeOf(const fs::path& file) const {
    return folder_ / file.lexically_relative(work_);
}

std::string FilesTogether::withPlaces(std::string text) const {
    const std::string from = work_.string();
    const std::string to = folder_.string();
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
        text.replace(at, from.size(), to);
        at += to.size();
    }
    return text;
}

void FilesTogether::publish(const std::string& seal) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(work_)) {
        if (entry.path().filename() != seal) files.push_back(entry.path());
    }
    files.push_back(work_ / seal);
    // What could fail must not fail half-way.
    for (const fs::path& file : files) {
        if (fs::is_directory(placeOf(file), error)) {
            failToWrite(placeOf(file), "it is a folder");
        }
    }
    fs::remove(folder_ / seal, error);
    for (const fs::path& file : files) {
        fs::rename(file, placeOf(file), error);
        if (error) failToWrite(placeOf(file), error.message());
    }
}

}  // namespace kaustik
