// SPDX-License-Identifier: MIT
// Stands between the framework and the driver: while it lives, OpenGL compiles, draws,
// dispatches and stores nothing, and what it was given to compile is noted. So the programs of
// hundreds of frames are known in seconds, as the very texts that a driver would have been handed.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace kaustik::test {

struct RecordedStage {
    std::string kind;  // comp, vert, geom, frag
    std::string text;
    friend auto operator<=>(const RecordedStage&, const RecordedStage&) = default;
};
using RecordedProgram = std::vector<RecordedStage>;

// One at a time; the context must be current.
class Recording {
  public:
    Recording();
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    // Each program once, with the name of its files ("a.vert + a.frag").
    [[nodiscard]] const std::map<RecordedProgram, std::string>& programs() const {
        return programs_;
    }
    // Workgroups of the largest direct dispatch along each axis, with the name of its program.
    struct Dispatch {
        GLuint groups = 0;
        std::string program;
    };
    [[nodiscard]] const std::array<Dispatch, 3>& largest() const { return largest_; }

  private:
    struct Hooks;
    friend struct Hooks;

    std::map<RecordedProgram, std::string> programs_;
    std::array<Dispatch, 3> largest_;
    std::map<GLuint, RecordedStage> stages_;      // by shader
    std::map<GLuint, RecordedProgram> attached_;  // by program
    std::map<GLuint, std::string> names_;         // by program
    GLuint used_ = 0;
    // The driver's own.
    PFNGLGETSHADERIVPROC getShader_ = nullptr;
    PFNGLTEXTURESTORAGE2DPROC storage2D_ = nullptr;
    PFNGLTEXTURESTORAGE3DPROC storage3D_ = nullptr;
    std::vector<std::function<void()>> restores_;  // of what is replaced
};

}  // namespace kaustik::test
