// SPDX-License-Identifier: MIT
#include "framework/gl/program_store.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <system_error>
#include <vector>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"

namespace kaustik::gl {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kMagic = "kaustik program 1\n";
constexpr std::size_t kHashLength = 32;
constexpr std::size_t kHeaderBytes = kMagic.size() + 2 * kHashLength + sizeof(GLenum);

std::string environmentText(const char* name) {
    const char* text = std::getenv(name);
    return text != nullptr ? text : "";
}

std::string driverText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

// Bytes of the programs in each folder: counted once, and what this process has written since. What
// others write meanwhile is not in it, so that theirs may lie beyond the capacity until the next
// process counts.
struct FolderSizes {
    std::mutex mutex;
    std::map<fs::path, std::uint64_t> bytes;
};
FolderSizes& folderSizes() {
    static FolderSizes all;
    return all;
}

std::mutex& statisticsMutex() {
    static std::mutex mutex;
    return mutex;
}
ProgramStatistics& statistics() {
    static ProgramStatistics all;
    return all;
}

}  // namespace

ProgramStore::ProgramStore(fs::path folder, std::uint64_t capacityBytes)
    : folder_(std::move(folder)), capacityBytes_(capacityBytes) {}

fs::path ProgramStore::usersFolder() {
    const std::string wanted = environmentText("KAUSTIK_PROGRAM_CACHE");
    if (wanted == "0" || wanted == "off") return {};
    if (const fs::path own = environmentText("KAUSTIK_CACHE"); !own.empty())
        return own / "programs";
    if (const fs::path xdg = environmentText("XDG_CACHE_HOME"); !xdg.empty())
        return xdg / "kaustik/programs";
    if (const fs::path home = environmentText("HOME"); !home.empty())
        return home / ".cache/kaustik/programs";
    return {};
}

std::string ProgramStore::keyOf(const std::string& texts) {
    ContentHash hash;
    hash.addBytes(versionString());
    for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION})
        hash.addBytes(driverText(name));
    return hash.addBytes(texts).hex();
}

fs::path ProgramStore::fileOf(const std::string& key) const {
    return folder_ / (key + ".program");
}

// A file is the magic, its key, the fingerprint of what follows, the driver's format, and the
// driver's bytes.
bool ProgramStore::load(GLuint program, const std::string& key) const {
    if (folder_.empty()) return false;
    const fs::path file = fileOf(key);
    std::error_code ignored;
    const std::uintmax_t size = fs::file_size(file, ignored);
    if (ignored || size <= kHeaderBytes || size > capacityBytes_) return false;
    std::string bytes;
    try {
        bytes = readFile(file);
    } catch (const IoError&) {
        return false;
    }
    const auto part = [&](std::size_t first, std::size_t length) {
        return std::string_view(bytes).substr(std::min(first, bytes.size()), length);
    };
    const std::size_t content = kMagic.size() + 2 * kHashLength;
    const bool isWhole = bytes.size() > kHeaderBytes && part(0, kMagic.size()) == kMagic &&
                         part(kMagic.size(), kHashLength) == key &&
                         part(kMagic.size() + kHashLength, kHashLength) ==
                             ContentHash().addBytes(part(content, bytes.size())).hex();
    GLint linked = GL_FALSE;
    if (isWhole) {
        GLenum format = 0;
        std::memcpy(&format, bytes.data() + content, sizeof(format));
        // A driver that has been changed under the same name may refuse it, which is no mistake.
        const GLboolean isWatched = glIsEnabled(GL_DEBUG_OUTPUT);
        glDisable(GL_DEBUG_OUTPUT);
        glProgramBinary(program, format, bytes.data() + kHeaderBytes,
                        static_cast<GLsizei>(bytes.size() - kHeaderBytes));
        static_cast<void>(glGetError());
        if (isWatched == GL_TRUE) glEnable(GL_DEBUG_OUTPUT);
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
    }
    if (linked == GL_TRUE) {
        // The oldest go first.
        fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
        return true;
    }
    fs::remove(file, ignored);
    return false;
}

void ProgramStore::save(GLuint program, const std::string& key) const {
    if (folder_.empty()) return;
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    GLint length = 0;
    if (formats > 0) glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return;
    std::vector<char> binary(static_cast<std::size_t>(length));
    GLenum format = 0;
    GLsizei written = 0;
    glGetProgramBinary(program, length, &written, &format, binary.data());
    if (written <= 0) return;
    std::string content(reinterpret_cast<const char*>(&format), sizeof(format));
    content.append(binary.data(), static_cast<std::size_t>(written));
    const std::string bytes =
        std::string(kMagic) + key + ContentHash().addBytes(content).hex() + content;
    if (bytes.size() > capacityBytes_) return;
    try {
        makeRoom(bytes.size());
        writeFileWhole(fileOf(key), bytes);
    } catch (const std::exception&) {
        // No room, no permission: there is no cache then.
    }
}

void ProgramStore::makeRoom(std::uint64_t bytes) const {
    FolderSizes& sizes = folderSizes();
    const std::lock_guard lock(sizes.mutex);
    const auto known = sizes.bytes.find(folder_);
    if (known != sizes.bytes.end() && known->second + bytes <= capacityBytes_) {
        known->second += bytes;
        return;
    }
    struct Entry {
        fs::file_time_type time;
        std::uint64_t bytes;
        fs::path path;
    };
    std::vector<Entry> entries;
    std::uint64_t sum = bytes;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
        if (entry.path().extension() != ".program" || !entry.is_regular_file(ignored)) continue;
        const std::uintmax_t size = entry.file_size(ignored);
        if (ignored) continue;  // another process has removed it
        entries.push_back({entry.last_write_time(ignored), size, entry.path()});
        sum += size;
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (const Entry& oldest : entries) {
        if (sum <= capacityBytes_) break;
        fs::remove(oldest.path, ignored);
        sum -= oldest.bytes;
    }
    sizes.bytes[folder_] = sum;
}

ProgramStatistics programStatistics() {
    const std::lock_guard lock(statisticsMutex());
    return statistics();
}

void notePrograms(const ProgramStatistics& made) {
    const std::lock_guard lock(statisticsMutex());
    ProgramStatistics& all = statistics();
    all.compiled += made.compiled;
    all.loaded += made.loaded;
    all.together = std::max(all.together, made.together);
    all.milliseconds += made.milliseconds;
}

}  // namespace kaustik::gl
