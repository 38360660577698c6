// SPDX-License-Identifier: MIT
// Linked programs on disk, so that a driver compiles each once and not at every start
// (glGetProgramBinary). A file is named by the fingerprint of everything that decides what is in
// it: the driver's vendor, renderer and version, this program's version, and the stages' texts.
// Whatever is wrong with a file (cut short, changed, of another driver), the program is compiled as
// if it were not there. The oldest files go where all together grow too large.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace kaustik::gl {

class ProgramStore {
  public:
    static constexpr std::uint64_t kCapacityBytes = 256ULL << 20U;

    // `folder`: made when the first program is saved.
    explicit ProgramStore(std::filesystem::path folder,
                          std::uint64_t capacityBytes = kCapacityBytes);

    // $KAUSTIK_CACHE, $XDG_CACHE_HOME/kaustik or ~/.cache/kaustik, and "programs" there; "" where
    // there is none, or where the environment's KAUSTIK_PROGRAM_CACHE is 0 or off.
    [[nodiscard]] static std::filesystem::path usersFolder();

    // Of the current context's driver and the texts of all stages.
    [[nodiscard]] static std::string keyOf(const std::string& texts);

    // Whether `program` is linked from the file of that key.
    bool load(GLuint program, const std::string& key) const;
    // Writes what is linked. That a file cannot be written is no error: the next start compiles.
    void save(GLuint program, const std::string& key) const;

  private:
    [[nodiscard]] std::filesystem::path fileOf(const std::string& key) const;
    // Removes the oldest files where the capacity leaves no room for so many bytes more.
    void makeRoom(std::uint64_t bytes) const;

    std::filesystem::path folder_;
    std::uint64_t capacityBytes_;
};

// What making programs has taken in this process so far.
struct ProgramStatistics {
    int compiled = 0;
    int loaded = 0;  // from the store
    // Most that the driver was handed before the status of any of them was asked for.
    int together = 0;
    double milliseconds = 0.0;
};
[[nodiscard]] ProgramStatistics programStatistics();
// Adds to them.
void notePrograms(const ProgramStatistics& made);

}  // namespace kaustik::gl
