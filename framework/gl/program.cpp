// SPDX-License-Identifier: MIT
#include "framework/gl/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "framework/core/elapsed.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/gl/program_store.h"

namespace kaustik::gl {
namespace {
namespace fs = std::filesystem;

ShaderFolders searchedFolders(const ShaderFolders& moreFolders) {
    ShaderFolders folders{projectRoot() / "shaders", projectRoot()};
    folders.insert(folders.end(), moreFolders.begin(), moreFolders.end());
    if (const char* fromEnvironment = std::getenv("KAUSTIK_SHADERS")) {
        if (*fromEnvironment != '\0') folders.emplace_back(fromEnvironment);
    }
    return folders;
}

// As messages name it: what is not the project's with its whole path.
std::string shownName(const fs::path& file) {
    const fs::path relative = file.lexically_relative(projectRoot());
    const bool isOwn = !relative.empty() && *relative.begin() != "..";
    return isOwn ? relative.string() : file.string();
}

class Expander {
  public:
    explicit Expander(const ShaderFolders& moreFolders) : folders_(searchedFolders(moreFolders)) {}

    ShaderText run(const std::string& file, const std::string& declarations) {
        append("#version 450 core", {"(start of " + file + ")", 1});
        std::istringstream lines(declarations);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            append(line, {"(parameters of " + file + ")", number});
        }
        expand(file, "");
        return std::move(result_);
    }

  private:
    [[nodiscard]] fs::path find(const std::string& file) const {
        for (const fs::path& folder : folders_) {
            const fs::path path = folder / file;
            if (fs::is_regular_file(path)) return path;
        }
        return {};
    }

    void append(const std::string& line, SourceLine where) {
        result_.text += line + "\n";
        result_.lines.push_back(std::move(where));
    }

    void expand(const std::string& file, const std::string& includedFrom) {
        if (std::find(stack_.begin(), stack_.end(), file) != stack_.end()) {
            throw ShaderError(fmt::format("{} includes itself by way of {}.", file, includedFrom));
        }
        if (std::find(done_.begin(), done_.end(), file) != done_.end()) return;
        const fs::path path = find(file);
        if (path.empty()) {
            std::vector<std::string> searched;
            for (const fs::path& folder : folders_)
                searched.push_back(folder.string());
            throw ShaderError(
                fmt::format("The shader file '{}'{} does not exist below {}.", file,
                            includedFrom.empty() ? "" : " included at " + includedFrom,
                            fmt::join(searched, ", ")));
        }
        stack_.push_back(file);
        const std::string name = shownName(path);
        std::istringstream lines(readFile(path));
        static const std::regex include(R"rx(^\s*#\s*include\s+"([^"]+)"\s*(//.*)?$)rx");
        static const std::regex skipped(R"rx(^\s*#\s*(version|pragma\s+once).*)rx");
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            std::smatch match;
            const bool isDirective = line.find('#') != std::string::npos;
            if (isDirective && std::regex_match(line, match, include)) {
                expand(match[1].str(), fmt::format("{}:{}", name, number));
            } else if (!isDirective || !std::regex_match(line, skipped)) {
                append(line, {name, number});
            }
        }
        stack_.pop_back();
        done_.push_back(file);
    }

    ShaderFolders folders_;
    ShaderText result_;
    std::vector<std::string> stack_;
    std::vector<std::string> done_;  // each file is included once
};

GLenum stageOf(const std::string& file) {
    const std::string extension = fs::path(file).extension().string();
    if (extension == ".vert") return GL_VERTEX_SHADER;
    if (extension == ".geom") return GL_GEOMETRY_SHADER;
    if (extension == ".frag") return GL_FRAGMENT_SHADER;
    if (extension == ".comp") return GL_COMPUTE_SHADER;
    throw ShaderError(fmt::format(
        "'{}' is no shader file: its name ends in none of .vert .geom .frag .comp.", file));
}

template <class Get>
std::string infoLog(GLuint id, GLint length, Get get) {
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    get(id, length, nullptr, log.data());
    log.resize(std::min(log.size(), log.find('\0')));
    return log;
}

// How that went is asked later, so that a driver may compile several side by side.
ShaderObject startCompiling(const std::string& file, const ShaderText& source) {
    ShaderObject shader(glCreateShader(stageOf(file)));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    return shader;
}

void requireCompiled(const ShaderObject& shader, const std::string& file,
                     const ShaderText& source) {
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    GLint length = 0;
    glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
    throw ShaderError(fmt::format(
        "{} does not compile:\n{}", file,
        readableShaderLog(infoLog(shader.id(), length, glGetShaderInfoLog), source.lines)));
}

// What OpenGL leaves to a driver's discretion: as many threads as it likes.
void allowCompilerThreads() {
    constexpr GLuint kAsManyAsTheDriverLikes = ~0U;
    if (epoxy_has_gl_extension("GL_KHR_parallel_shader_compile")) {
        glMaxShaderCompilerThreadsKHR(kAsManyAsTheDriverLikes);
    } else if (epoxy_has_gl_extension("GL_ARB_parallel_shader_compile")) {
        glMaxShaderCompilerThreadsARB(kAsManyAsTheDriverLikes);
    }
}

using Clock = std::chrono::steady_clock;

// Every identifier of `text`, to tell a misspelt uniform from one that was optimised away.
void insertWords(const std::string& text, std::unordered_set<std::string>& words) {
    const auto isWord = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    for (auto at = text.begin(); at != text.end();) {
        const auto begin = std::find_if(at, text.end(), isWord);
        at = std::find_if_not(begin, text.end(), isWord);
        if (begin != at) words.emplace(begin, at);
    }
}

}  // namespace

ShaderText loadShaderText(const std::string& file, const std::string& declarations,
                          const ShaderFolders& moreFolders) {
    return Expander(moreFolders).run(file, declarations);
}

std::string readableShaderLog(const std::string& log, const std::vector<SourceLine>& sourceLines) {
    // Mesa: "0:17(5): error: …"; NVIDIA: "0(17) : error …"; AMD and Intel: "ERROR: 0:17: …".
    static const std::regex place(
        R"rx(^(?:(?:ERROR|WARNING):\s*)?\d+(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*(.*)$)rx");
    std::istringstream lines(log);
    std::string readable;
    std::string line;
    while (std::getline(lines, line)) {
        if (line.empty()) continue;
        std::smatch match;
        if (std::regex_match(line, match, place)) {
            const std::size_t number =
                std::stoul(match[1].matched ? match[1].str() : match[2].str());
            if (number >= 1 && number <= sourceLines.size()) {
                const SourceLine& source = sourceLines[number - 1];
                line = fmt::format("{}:{}: {}", source.file, source.number, match[3].str());
            }
        }
        readable += (readable.empty() ? "  " : "\n  ") + line;
    }
    return readable;
}

struct Program::Unfinished {
    std::vector<std::string> files;
    std::vector<ShaderText> sources;
    std::vector<ShaderObject> shaders;
    std::string stored;  // its key in the store
    double milliseconds = 0.0;
};

Program::Program() : object_(glCreateProgram()) {}
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;
Program::~Program() = default;

Program::Program(const ProgramKey& key, const ShaderFolders& moreFolders,
                 const SourceChange& change)
    : Program(started(key, moreFolders, change)) {
    finish();
}

Program Program::started(const ProgramKey& key, const ShaderFolders& moreFolders,
                         const SourceChange& change) {
    const Clock::time_point begin = Clock::now();
    Program program;
    auto unfinished = std::make_unique<Unfinished>();
    unfinished->files = key.files;
    std::string texts;
    for (const std::string& file : key.files) {
        program.name_ += (program.name_.empty() ? "" : " + ") + file;
        ShaderText& source =
            unfinished->sources.emplace_back(loadShaderText(file, key.declarations, moreFolders));
        if (change) source.text = change(file, source.text);
        insertWords(source.text, program.words_);
        texts += file + '\n' + source.text;
    }
    unfinished->stored = ProgramStore::keyOf(texts);
    const bool isLoaded =
        ProgramStore(ProgramStore::usersFolder()).load(program.id(), unfinished->stored);
    if (!isLoaded) {
        for (std::size_t i = 0; i < key.files.size(); ++i) {
            unfinished->shaders.push_back(startCompiling(key.files[i], unfinished->sources[i]));
            glAttachShader(program.id(), unfinished->shaders.back().id());
        }
        glProgramParameteri(program.id(), GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
        glLinkProgram(program.id());
    }
    const std::string& name = program.name_;
    glObjectLabel(GL_PROGRAM, program.id(), static_cast<GLsizei>(name.size()), name.c_str());
    unfinished->milliseconds = millisecondsSince(begin);
    if (isLoaded) {
        notePrograms({.loaded = 1, .milliseconds = unfinished->milliseconds});
    } else {
        program.unfinished_ = std::move(unfinished);
    }
    return program;
}

void Program::finish() {
    if (isFinished()) return;
    const Clock::time_point begin = Clock::now();
    const Unfinished& made = *unfinished_;
    GLint linked = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        // One that does not compile says more.
        for (std::size_t i = 0; i < made.files.size(); ++i)
            requireCompiled(made.shaders[i], made.files[i], made.sources[i]);
        GLint length = 0;
        glGetProgramiv(id(), GL_INFO_LOG_LENGTH, &length);
        throw ShaderError(fmt::format("{} does not link:\n  {}", name_,
                                      infoLog(id(), length, glGetProgramInfoLog)));
    }
    for (const ShaderObject& shader : made.shaders)
        glDetachShader(id(), shader.id());
    ProgramStore(ProgramStore::usersFolder()).save(id(), made.stored);
    notePrograms({.compiled = 1, .milliseconds = made.milliseconds + millisecondsSince(begin)});
    unfinished_.reset();
}

bool Program::declares(const std::string& name) const {
    const std::size_t end = name.find_first_of("[.");  // of few names: most are not copied
    return words_.contains(end == std::string::npos ? name : name.substr(0, end));
}

void Program::requireDeclared(const std::string& name, const char* kind) const {
    if (!declares(name)) {
        throw ShaderError(fmt::format("{} has no {} '{}'.", name_, kind, name));
    }
}

GLint Program::uniform(const std::string& name) {
    const auto known = uniforms_.find(name);
    if (known != uniforms_.end()) return known->second;
    requireDeclared(name, "uniform");
    return uniforms_[name] = glGetUniformLocation(id(), name.c_str());
}

GLuint Program::storageBlock(const std::string& name) {
    const auto known = storageBlocks_.find(name);
    if (known != storageBlocks_.end()) return known->second;
    requireDeclared(name, "storage block");
    return storageBlocks_[name] =
               glGetProgramResourceIndex(id(), GL_SHADER_STORAGE_BLOCK, name.c_str());
}

GLuint Program::uniformBlock(const std::string& name) {
    const auto known = uniformBlocks_.find(name);
    if (known != uniformBlocks_.end()) return known->second;
    requireDeclared(name, "uniform block");
    return uniformBlocks_[name] = glGetUniformBlockIndex(id(), name.c_str());
}

Program& ProgramCache::get(const ProgramKey& key) {
    const auto known = programs_.find(key);
    if (known == programs_.end())
        return programs_.emplace(key, Program(key, moreFolders_)).first->second;
    try {
        known->second.finish();
    } catch (const ShaderError&) {
        programs_.erase(known);  // it is compiled anew for whoever asks again
        throw;
    }
    return known->second;
}

void ProgramCache::start(const std::vector<ProgramKey>& keys) {
    allowCompilerThreads();
    int unfinished = 0;
    for (const ProgramKey& key : keys) {
        if (programs_.contains(key)) continue;
        try {
            const Program& program =
                programs_.emplace(key, Program::started(key, moreFolders_)).first->second;
            unfinished += program.isFinished() ? 0 : 1;
        } catch (const ShaderError&) {  // of a file; get() meets it again
        }
    }
    notePrograms({.together = unfinished});
}

std::vector<std::string> ProgramCache::reload() {
    std::vector<std::string> errors;
    for (auto& [key, program] : programs_) {
        try {
            program = Program(key, moreFolders_);
        } catch (const Error& error) {
            errors.emplace_back(error.what());
        }
    }
    return errors;
}

}  // namespace kaustik::gl
