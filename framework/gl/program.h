// SPDX-License-Identifier: MIT
// Shader programs from files with includes. A file is looked up in shaders/, then from the
// project's root (for the headers that C++ and GLSL share), then in the folders of techniques that
// live elsewhere, and in that which KAUSTIK_SHADERS names. A compile error names the file and line
// as written.
// Programs are cached by their files and declarations.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "framework/gl/objects.h"

namespace kaustik::gl {

// One stage is one file; the kind follows the extension: .vert .geom .frag .comp.
struct ProgramKey {
    std::vector<std::string> files;  // relative to shaders/
    std::string declarations;        // GLSL text put after #version: constants and parameters
    friend auto operator<=>(const ProgramKey&, const ProgramKey&) = default;
};

// The place where a line of an expanded text was written.
struct SourceLine {
    std::string file;
    int number = 0;
};

// A shader file with its includes expanded. #line is not used: Mesa forgets its file for errors
// of meaning, so lines are looked up here instead.
struct ShaderText {
    std::string text;
    std::vector<SourceLine> lines;  // of `text`, from its first
};
// Throws ShaderError when a file is missing or includes itself, naming the file and line.
using ShaderFolders = std::vector<std::filesystem::path>;
[[nodiscard]] ShaderText loadShaderText(const std::string& file, const std::string& declarations,
                                        const ShaderFolders& moreFolders = {});

// "file:line: message" from a driver's log, whatever its format.
[[nodiscard]] std::string readableShaderLog(const std::string& log,
                                            const std::vector<SourceLine>& lines);

// Gives what is compiled instead of the expanded text of a file.
using SourceChange = std::function<std::string(const std::string& file, const std::string& text)>;

class Program {
  public:
    explicit Program(const ProgramKey& key, const ShaderFolders& moreFolders = {},
                     const SourceChange& change = {});
    // Hands the driver the sources and asks for nothing, so that it may compile several programs
    // side by side. finish() must follow before anything else.
    [[nodiscard]] static Program started(const ProgramKey& key,
                                         const ShaderFolders& moreFolders = {},
                                         const SourceChange& change = {});
    // Waits for the driver where that has not been done. Throws ShaderError.
    void finish();
    [[nodiscard]] bool isFinished() const { return unfinished_ == nullptr; }
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;
    ~Program();

    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] const std::string& name() const { return name_; }  // "a.vert + a.frag"
    // The location of a uniform, -1 where the compiler has removed it. A name that the source does
    // not declare throws ShaderError: it is a mistake.
    [[nodiscard]] GLint uniform(const std::string& name);
    // Whether the sources name it, so that the next three do not throw.
    [[nodiscard]] bool declares(const std::string& name) const;
    // The index of a storage block, GL_INVALID_INDEX where removed; unknown names throw.
    [[nodiscard]] GLuint storageBlock(const std::string& name);
    [[nodiscard]] GLuint uniformBlock(const std::string& name);

  private:
    struct Unfinished;
    Program();
    void requireDeclared(const std::string& name, const char* kind) const;

    ProgramObject object_;
    std::unique_ptr<Unfinished> unfinished_;  // until its status was asked for
    std::string name_;
    std::unordered_set<std::string> words_;  // every identifier of the sources
    std::map<std::string, GLint> uniforms_;
    std::map<std::string, GLuint> storageBlocks_;
    std::map<std::string, GLuint> uniformBlocks_;
};

class ProgramCache {
  public:
    // `moreFolders` are searched besides the project's own.
    explicit ProgramCache(ShaderFolders moreFolders = {}) : moreFolders_(std::move(moreFolders)) {}

    // Compiles at first use. Throws ShaderError.
    [[nodiscard]] Program& get(const ProgramKey& key);

    // Hands the driver those that are not there yet, all of them before get() asks how any went.
    // What is wrong with one, get() says.
    void start(const std::vector<ProgramKey>& keys);

    [[nodiscard]] const ShaderFolders& folders() const { return moreFolders_; }

    // Compiles all programs anew from the files as they are now. Those that fail stay as they were;
    // gives their errors, one a program, and nothing where all is well.
    [[nodiscard]] std::vector<std::string> reload();

  private:
    ShaderFolders moreFolders_;
    std::map<ProgramKey, Program> programs_;
};

}  // namespace kaustik::gl
