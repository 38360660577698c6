// SPDX-License-Identifier: MIT
// This header says where the project's files are, and writes files so that each is there whole or
// not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace kaustik {

[[nodiscard]] std::string versionString();

// The folder that holds shaders/, experiments/ and meshes/: $KAUSTIK_ROOT, else share/kaustik of
// the prefix that this code is installed in or was linked from, else the source tree of the build
// tree that it is in. Throws IoError where it is in none of these.
[[nodiscard]] const std::filesystem::path& projectRoot();

// The folder of the program kaustik: bin of that prefix or build tree, else as the next.
[[nodiscard]] const std::filesystem::path& programFolder();

// The folder of kaustik_reader and of the modules that are loaded at run time: lib/kaustik of that
// prefix, else bin/ of that build tree, else the folder that the program itself is in.
[[nodiscard]] const std::filesystem::path& helperFolder();

// The whole file as bytes. Throws IoError (missing, a directory, no permission) naming the file.
[[nodiscard]] std::string readFile(const std::filesystem::path& path);

// A hidden name next to `path` for what is not finished, of this process alone, also where several
// machines write into the folder. What a process of this machine has left under such a name
// because it was killed, the next writeFileWhole() into the folder removes.
[[nodiscard]] std::filesystem::path unfinishedPath(const std::filesystem::path& path);

// Calls `write` with a temporary path next to `path` (same extension), then renames it over `path`.
// When `write` throws, or the disk is full, nothing is left behind and `path` is untouched. What a
// process of this machine has left in the folder because it was killed is removed first.
// Creates missing parent folders. Throws IoError naming the file.
void writeFileWhole(const std::filesystem::path& path,
                    const std::function<void(const std::filesystem::path& temporary)>& write);

// Writes bytes that are at hand to a file in the same way.
void writeFileWhole(const std::filesystem::path& path, std::string_view bytes);

// Several files that appear together or not at all: they are written into a folder of their own,
// hidden next to their places, and then moved. What a full disk or an error leaves unfinished is
// removed, and the older files stay as they were.
class FilesTogether {
  public:
    // Makes the hidden folder in `folder`, with missing parents. Throws IoError naming the folder.
    explicit FilesTogether(std::filesystem::path folder);
    ~FilesTogether();
    FilesTogether(const FilesTogether&) = delete;
    FilesTogether& operator=(const FilesTogether&) = delete;

    // The folder to write the files to.
    [[nodiscard]] const std::filesystem::path& workFolder() const { return work_; }
    // Their final names, from those in the work folder; in a text, too.
    [[nodiscard]] std::filesystem::path placeOf(const std::filesystem::path& file) const;
    [[nodiscard]] std::string withPlaces(std::string text) const;
    // Moves all that is in the work folder. An older file called `seal` goes before anything else
    // is moved and the new one comes last, so that it never stands next to files of another run.
    void publish(const std::string& seal);

  private:
    std::filesystem::path folder_;
    std::filesystem::path work_;
};

}  // namespace kaustik
