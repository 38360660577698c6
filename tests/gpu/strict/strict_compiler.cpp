// SPDX-License-Identifier: MIT
#include "tests/gpu/strict/strict_compiler.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "framework/core/files.h"
#include "framework/core/process.h"
#include "tests/gpu/strict/driver_limits.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;

// What a tool has said, in a file of the folder; its exit code is 0 where all is well.
int run(const std::vector<std::string>& words, const fs::path& folder, const std::string& output) {
    const int file =
        ::open((folder / output).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    Process process;
    const int problem = process.start({.program = words.front(),
                                       .words = words,
                                       .standard = {kNoDescriptor, file, file},
                                       .folder = folder});
    const ProcessEnd end = problem == 0 ? process.wait() : ProcessEnd{127, 0};
    ::close(file);
    return end.signal != 0 ? -end.signal : end.exitCode;
}

// glslang names a line by its number: with it goes what stands there.
std::string withLines(const std::string& log, const RecordedProgram& program) {
    std::string shown;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        const bool isProblem = line.starts_with("ERROR") || line.starts_with("error");
        if (!isProblem) continue;
        shown += "\n    " + line;
        const std::size_t number = line.find(':', line.find(':') + 1);
        if (number == std::string::npos || program.size() != 1) continue;
        const int wanted = std::atoi(line.c_str() + number + 1);
        std::istringstream source(program.front().text);
        std::string text;
        for (int i = 0; i < wanted; ++i)
            std::getline(source, text);
        if (wanted > 0) shown += "\n        " + text;
    }
    return shown.empty() ? "\n    " + log : shown;
}

// Sizes of what a module declares in workgroup memory, as uniforms outside of blocks and as images,
// none of which spirv-cross lists before what is unused is gone. (SPIR-V 1.0, section 3.32.)
class ModuleSizes {
  public:
    explicit ModuleSizes(const fs::path& file) {
        const std::string bytes = readFile(file);
        words_.resize(bytes.size() / sizeof(std::uint32_t));
        std::copy_n(bytes.data(), words_.size() * sizeof(std::uint32_t),
                    reinterpret_cast<char*>(words_.data()));
        constexpr std::size_t kHeader = 5;
        for (std::size_t i = kHeader; i < words_.size(); i += std::max(words_[i] >> 16U, 1U)) {
            const std::uint32_t code = words_[i] & 0xffffU;
            if (code >= kTypeVoid && code <= kTypePointer) types_[words_[i + 1]] = i;
            if (code == kConstant) constants_[words_[i + 2]] = words_[i + 3];
            if (code != kVariable) continue;
            const std::size_t pointer = types_.at(words_[i + 1]);
            const std::uint32_t size = components(words_[pointer + 3]);
            if (words_[i + 3] == kWorkgroup) shared_ += size;
            if (words_[i + 3] != kUniformConstant) continue;
            uniforms_ += size;
            images_ += images(words_[pointer + 3]);
        }
    }
    [[nodiscard]] int sharedBytes() const { return static_cast<int>(4 * shared_); }
    [[nodiscard]] int uniformComponents() const { return static_cast<int>(uniforms_); }
    [[nodiscard]] int imageUniforms() const { return static_cast<int>(images_); }

  private:
    static constexpr std::uint32_t kTypeVoid = 19;
    static constexpr std::uint32_t kTypeBool = 20;
    static constexpr std::uint32_t kTypeInt = 21;
    static constexpr std::uint32_t kTypeFloat = 22;
    static constexpr std::uint32_t kTypeVector = 23;
    static constexpr std::uint32_t kTypeMatrix = 24;
    static constexpr std::uint32_t kTypeImage = 25;
    static constexpr std::uint32_t kTypeArray = 28;
    static constexpr std::uint32_t kTypeStruct = 30;
    static constexpr std::uint32_t kTypePointer = 32;
    static constexpr std::uint32_t kConstant = 43;
    static constexpr std::uint32_t kVariable = 59;
    static constexpr std::uint32_t kUniformConstant = 0;
    static constexpr std::uint32_t kWorkgroup = 4;

    // Those that can be written; a sampler holds one that can't.
    [[nodiscard]] std::uint32_t images(std::uint32_t type) const {
        constexpr std::uint32_t kWithoutSampler = 2;
        const std::size_t at = types_.at(type);
        const std::uint32_t code = words_[at] & 0xffffU;
        if (code == kTypeImage) return words_[at + 7] == kWithoutSampler ? 1 : 0;
        if (code == kTypeArray) return images(words_[at + 2]) * constants_.at(words_[at + 3]);
        return 0;
    }
    // Of 4 bytes each; images and samplers have none.
    [[nodiscard]] std::uint32_t components(std::uint32_t type) const {
        const std::size_t at = types_.at(type);
        switch (words_[at] & 0xffffU) {
            case kTypeBool:
                return 1;
            case kTypeInt:
            case kTypeFloat:
                return words_[at + 2] / 32U;
            case kTypeVector:
            case kTypeMatrix:
                return components(words_[at + 2]) * words_[at + 3];
            case kTypeArray:
                return components(words_[at + 2]) * constants_.at(words_[at + 3]);
            case kTypeStruct: {
                std::uint32_t sum = 0;
                for (std::size_t member = at + 2; member < at + (words_[at] >> 16U); ++member)
                    sum += components(words_[member]);
                return sum;
            }
            default:
                return 0;
        }
    }

    std::vector<std::uint32_t> words_;
    std::map<std::uint32_t, std::size_t> types_;        // where each stands
    std::map<std::uint32_t, std::uint32_t> constants_;  // the first word of each
    std::uint32_t shared_ = 0;
    std::uint32_t uniforms_ = 0;
    std::uint32_t images_ = 0;
};

StageResources resourcesOf(const std::string& kind, const nlohmann::json& reflected,
                           const ModuleSizes& declared, const ModuleSizes& used) {
    // An array takes as many as it has elements.
    const auto count = [&](const char* resource) {
        int sum = 0;
        for (const nlohmann::json& entry : reflected.value(resource, nlohmann::json::array())) {
            int elements = 1;
            for (const nlohmann::json& length : entry.value("array", nlohmann::json::array()))
                elements *= length.get<int>();
            sum += elements;
        }
        return sum;
    };
    StageResources found;
    found.kind = kind;
    found.images = declared.imageUniforms();
    found.storageBlocks = count("ssbos");
    found.uniformBlocks = count("ubos");
    found.samplers = count("textures");
    if (kind == "frag") found.outputs = count("outputs");
    found.uniformComponents = used.uniformComponents();
    found.sharedBytes = used.sharedBytes();
    const nlohmann::json& entry = reflected.at("entryPoints").at(0);
    if (entry.contains("workgroup_size")) {
        for (std::size_t i = 0; i < 3; ++i)
            found.groupThreads[i] = entry.at("workgroup_size").at(i).get<int>();
    }
    return found;
}

// What is run in each program's folder; "failed" names the tool that does not take it, "log" is
// what it says. By a shell, since a process with the memory of many frames takes its time to start
// one.
constexpr const char* kTools = R"(
cd "$1" || exit 1
take() { "$@" > log 2>&1 || { echo "$1" > failed; exit 0; }; }
# All stages together: GLSL's rules, and SPIR-V's. What GLSL lets a program number later gets
# its number here.
take glslangValidator -G --amb --aml shader.*
for module in comp vert geom frag; do
    [ -e "$module.spv" ] || continue
    take spirv-val --target-env opengl4.5 "$module.spv"
    # What is declared and not used takes nothing, images apart.
    take spirv-opt --eliminate-dead-functions --eliminate-dead-variables -o "$module.used" \
        "$module.spv"
    take spirv-cross "$module.used" --output "$module.json" --reflect
done
)";

void write(const RecordedProgram& program, const fs::path& folder) {
    fs::create_directories(folder);
    for (const RecordedStage& stage : program) {
        // A uniform that is a bool is GLSL, but SPIR-V has none.
        static const std::regex flag("uniform bool ([A-Za-z_0-9]+);");
        std::ofstream(folder / ("shader." + stage.kind))
            << std::regex_replace(stage.text, flag, "uniform int $1_;\n#define $1 ($1_ != 0)");
    }
}

CheckedProgram checkedIn(const fs::path& folder, const RecordedProgram& program) {
    CheckedProgram checked;
    if (fs::exists(folder / "failed")) {
        std::string tool = readFile(folder / "failed");
        tool.erase(tool.find_last_not_of('\n') + 1);
        checked.problem = fmt::format("{}: {}", tool, withLines(readFile(folder / "log"), program));
        return checked;
    }
    for (const RecordedStage& stage : program) {
        checked.stages.push_back(resourcesOf(
            stage.kind, nlohmann::json::parse(readFile(folder / (stage.kind + ".json"))),
            ModuleSizes(folder / (stage.kind + ".spv")),
            ModuleSizes(folder / (stage.kind + ".used"))));
    }
    return checked;
}

}  // namespace

std::vector<std::string> missingTools() {
    std::vector<std::string> missing;
    for (const char* tool : {"glslangValidator", "spirv-val", "spirv-opt", "spirv-cross"}) {
        if (run({tool, "--help"}, fs::temp_directory_path(), "kaustik-tool-help") == 127)
            missing.emplace_back(tool);
    }
    return missing;
}

RecordedProgram withoutUnused(RecordedProgram program) {
    for (RecordedStage& stage : program) {
        std::istringstream lines(stage.text);
        std::string kept;
        std::vector<std::pair<std::string, std::string>> declared;  // name and line
        std::string line;
        std::getline(lines, kept);  // #version
        while (std::getline(lines, line)) {
            std::istringstream words(line);
            std::string first;
            std::string name;
            words >> first >> name;
            if (first == "uniform" || first == "const") words >> name;
            if (first != "uniform" && first != "const" && first != "#define") break;
            declared.emplace_back(name.substr(0, name.find(';')), line);
        }
        const std::string rest =
            line + "\n" + std::string(std::istreambuf_iterator<char>(lines), {});
        for (const auto& [name, text] : declared) {
            if (rest.find(name) != std::string::npos) kept += "\n" + text;
        }
        stage.text = kept + "\n" + rest;
    }
    return program;
}

std::vector<CheckedProgram> checkPrograms(const std::vector<RecordedProgram>& programs) {
    const fs::path folder =
        fs::temp_directory_path() / fmt::format("kaustik-programs-{}", ::getpid());
    fs::create_directories(folder);
    std::ofstream(folder / "tools.sh") << kTools;
    std::string names;
    for (std::size_t i = 0; i < programs.size(); ++i) {
        write(programs[i], folder / std::to_string(i));
        names += std::to_string(i) + "\n";
    }
    std::ofstream(folder / "names") << names;
    const std::string workers = std::to_string(std::max(std::thread::hardware_concurrency(), 1U));
    const int code =
        run({"xargs", "-a", "names", "-P", workers, "-n", "1", "sh", "tools.sh"}, folder, "log");
    std::vector<CheckedProgram> checked(programs.size());
    for (std::size_t i = 0; i < programs.size(); ++i) {
        try {
            if (code != 0) throw std::runtime_error("xargs did not run the tools");
            checked[i] = checkedIn(folder / std::to_string(i), programs[i]);
        } catch (const std::exception& error) {
            checked[i].problem = error.what();
        }
    }
    fs::remove_all(folder);
    return checked;
}

std::vector<std::string> beyondDriverLimits(const std::vector<StageResources>& stages) {
    std::vector<std::string> beyond;
    const auto compare = [&](const std::string& limit, int used, int axis = -1) {
        const int least = driverLimit(limit, axis).least();
        if (used > least)
            beyond.push_back(fmt::format("{} is {} where {} are used", limit, least, used));
    };
    StageResources all;
    for (const StageResources& stage : stages) {
        const std::string upper = stage.kind == "comp"   ? "COMPUTE"
                                  : stage.kind == "vert" ? "VERTEX"
                                  : stage.kind == "geom" ? "GEOMETRY"
                                                         : "FRAGMENT";
        compare(fmt::format("MAX_{}_IMAGE_UNIFORMS", upper), stage.images);
        compare(fmt::format("MAX_{}_SHADER_STORAGE_BLOCKS", upper), stage.storageBlocks);
        compare(fmt::format("MAX_{}_UNIFORM_BLOCKS", upper), stage.uniformBlocks);
        compare(stage.kind == "frag" ? std::string("MAX_TEXTURE_IMAGE_UNITS")
                                     : fmt::format("MAX_{}_TEXTURE_IMAGE_UNITS", upper),
                stage.samplers);
        compare(fmt::format("MAX_{}_UNIFORM_COMPONENTS", upper), stage.uniformComponents);
        if (stage.kind == "frag") compare("MAX_DRAW_BUFFERS", stage.outputs);
        if (stage.kind == "comp") {
            for (int axis = 0; axis < 3; ++axis)
                compare("MAX_COMPUTE_WORK_GROUP_SIZE", stage.groupThreads[axis], axis);
            compare("MAX_COMPUTE_WORK_GROUP_INVOCATIONS",
                    stage.groupThreads[0] * stage.groupThreads[1] * stage.groupThreads[2]);
            compare("MAX_COMPUTE_SHARED_MEMORY_SIZE", stage.sharedBytes);
        }
        all.images += stage.images;
        all.storageBlocks += stage.storageBlocks;
        all.uniformBlocks += stage.uniformBlocks;
        all.samplers += stage.samplers;
        all.outputs += stage.outputs;
    }
    // What several stages use counts in each.
    compare("MAX_IMAGE_UNITS", all.images);
    compare("MAX_COMBINED_IMAGE_UNIFORMS", all.images);
    compare("MAX_COMBINED_SHADER_STORAGE_BLOCKS", all.storageBlocks);
    compare("MAX_SHADER_STORAGE_BUFFER_BINDINGS", all.storageBlocks);
    compare("MAX_COMBINED_UNIFORM_BLOCKS", all.uniformBlocks);
    compare("MAX_COMBINED_TEXTURE_IMAGE_UNITS", all.samplers);
    compare("MAX_COMBINED_SHADER_OUTPUT_RESOURCES", all.images + all.storageBlocks + all.outputs);
    return beyond;
}

}  // namespace kaustik::test
