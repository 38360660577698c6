// SPDX-License-Identifier: MIT
#include "framework/gl/access_counter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>

#include "framework/core/error.h"

namespace kaustik::gl {
namespace {

constexpr std::size_t kTotalWords = 4 * kCountedShards;
constexpr glm::uvec2 kNoWords{~0u};

CountingStage stageOf(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".vert") return CountingStage::vertex;
    if (extension == ".geom") return CountingStage::geometry;
    return extension == ".frag" ? CountingStage::fragment : CountingStage::compute;
}

// Of a scalar, vector or matrix in a std430 block whose columns lie `matrixStride` apart.
int bytesOfType(GLint type, GLint matrixStride) {
    switch (type) {
        case GL_FLOAT_VEC2:
        case GL_INT_VEC2:
        case GL_UNSIGNED_INT_VEC2:
            return 8;
        case GL_FLOAT_VEC3:
        case GL_INT_VEC3:
        case GL_UNSIGNED_INT_VEC3:
            return 12;
        case GL_FLOAT_VEC4:
        case GL_INT_VEC4:
        case GL_UNSIGNED_INT_VEC4:
            return 16;
        case GL_FLOAT_MAT2:
            return 2 * matrixStride;
        case GL_FLOAT_MAT3:
            return 3 * matrixStride;
        case GL_FLOAT_MAT4:
            return 4 * matrixStride;
        default:
            return 4;
    }
}

// All storage blocks of a program.
BlockLayout layoutOf(GLuint program) {
    BlockLayout layout;
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_BUFFER_VARIABLE, GL_ACTIVE_RESOURCES, &count);
    GLint longest = 0;
    glGetProgramInterfaceiv(program, GL_BUFFER_VARIABLE, GL_MAX_NAME_LENGTH, &longest);
    std::string text(static_cast<std::size_t>(std::max(longest, 256)), '\0');
    const auto capacity = static_cast<GLsizei>(text.size());
    for (GLint i = 0; i < count; ++i) {
        constexpr std::array<GLenum, 7> kAsked = {GL_TYPE,          GL_OFFSET,
                                                  GL_ARRAY_SIZE,    GL_ARRAY_STRIDE,
                                                  GL_MATRIX_STRIDE, GL_TOP_LEVEL_ARRAY_STRIDE,
                                                  GL_BLOCK_INDEX};
        std::array<GLint, kAsked.size()> values{};
        glGetProgramResourceiv(program, GL_BUFFER_VARIABLE, static_cast<GLuint>(i),
                               static_cast<GLsizei>(kAsked.size()), kAsked.data(),
                               static_cast<GLsizei>(values.size()), nullptr, values.data());
        GLsizei length = 0;
        glGetProgramResourceName(program, GL_BUFFER_VARIABLE, static_cast<GLuint>(i), capacity,
                                 &length, text.data());
        BlockVariable variable;
        const std::string name(text.data(), static_cast<std::size_t>(length));
        glGetProgramResourceName(program, GL_SHADER_STORAGE_BLOCK, static_cast<GLuint>(values[6]),
                                 capacity, &length, text.data());
        variable.block.assign(text.data(), static_cast<std::size_t>(length));
        variable.bytes = bytesOfType(values[0], values[4]);
        variable.offset = values[1];
        variable.elements = values[2];
        variable.stride = values[3];
        variable.topLevelStride = values[5];
        layout.emplace(name, variable);
    }
    return layout;
}

struct TextureShape {
    glm::uvec3 size{0};
    unsigned bytesPerTexel = 0;
};
TextureShape shapeOf(GLuint texture) {
    const auto parameter = [&](GLenum name) {
        GLint value = 0;
        glGetTextureLevelParameteriv(texture, 0, name, &value);
        return static_cast<unsigned>(value);
    };
    unsigned bits = 0;
    for (const GLenum name : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                              GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_DEPTH_SIZE})
        bits += parameter(name);
    return {{parameter(GL_TEXTURE_WIDTH), parameter(GL_TEXTURE_HEIGHT),
             std::max(parameter(GL_TEXTURE_DEPTH), 1u)},
            bits / 8};
}

std::uint64_t bytesOfBuffer(GLuint buffer) {
    GLint64 bytes = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &bytes);
    return static_cast<std::uint64_t>(bytes);
}

std::uint64_t countBits(const std::vector<GLuint>& words, std::size_t first, std::size_t count) {
    std::uint64_t sum = 0;
    for (std::size_t i = first; i < first + count; ++i)
        sum += static_cast<std::uint64_t>(std::popcount(words[i]));
    return sum;
}

}  // namespace

AccessCounter::AccessCounter(ProgramCache& programs) : programs_(programs) {}

void AccessCounter::reserve(std::size_t words) {
    const std::size_t bytes = (kTotalWords + words) * sizeof(GLuint);
    if (buffer_.bytes() >= bytes) return;
    Buffer larger(std::max(2 * bytes, std::size_t{1} << 22U), nullptr, "counted accesses");
    larger.clear();
    if (buffer_.bytes() > 0) {
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        buffer_.copyTo(larger);
    }
    buffer_ = std::move(larger);
}

void AccessCounter::beginPass(const std::string& name) {
    here_ = {};
    here_.name = name;
    used_.clear();
    usedWords_ = 0;
    current_ = nullptr;
    reserve(0);
    buffer_.clear();
}

void AccessCounter::endPass() {
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    std::vector<GLuint> words(kTotalWords + usedWords_);
    glGetNamedBufferSubData(buffer_.id(), 0, static_cast<GLsizeiptr>(words.size() * sizeof(GLuint)),
                            words.data());
    for (std::size_t shard = 0; shard < kTotalWords; shard += 4) {
        here_.requestedReadBytes += words[shard];
        here_.requestedWrittenBytes += words[shard + 1];
        here_.atomics += words[shard + 2];
        here_.threads += words[shard + 3];
    }
    for (const auto& entry : used_) {
        const auto& used = entry.second;  // what a lambda takes may be no structured binding
        const std::size_t length = (used.elements + 31) / 32;
        const auto bytesMarked = [&](GLuint first) {
            return first == ~0u
                       ? 0
                       : used.bytesPerElement * countBits(words, kTotalWords + first, length);
        };
        PassAccesses::Resource resource{used.name, used.elements * used.bytesPerElement,
                                        bytesMarked(used.firstWord.x),
                                        bytesMarked(used.firstWord.y)};
        if (used.isWrittenWhole) resource.writtenBytes = resource.bytes;
        resource.writtenBytes = std::min(resource.writtenBytes, resource.bytes);
        here_.readBytes += resource.readBytes;
        here_.writtenBytes += resource.writtenBytes;
        here_.resources.push_back(resource);
    }
    lastEnded_ = indexOf(here_.name);
    PassAccesses& all = passes_[*lastEnded_];
    all.readBytes += here_.readBytes;
    all.writtenBytes += here_.writtenBytes;
    all.requestedReadBytes += here_.requestedReadBytes;
    all.requestedWrittenBytes += here_.requestedWrittenBytes;
    all.atomics += here_.atomics;
    all.threads += here_.threads;
    all.workGroups += here_.workGroups;
    all.commands += here_.commands;
    all.barriers += here_.barriers;
    all.readBacks += here_.readBacks;
    for (const PassAccesses::Resource& resource : here_.resources) {
        const auto same =
            std::find_if(all.resources.begin(), all.resources.end(),
                         [&](const auto& other) { return other.name == resource.name; });
        if (same == all.resources.end()) {
            all.resources.push_back(resource);
        } else {
            same->bytes += resource.bytes;
            same->readBytes += resource.readBytes;
            same->writtenBytes += resource.writtenBytes;
        }
    }
    here_ = {};
}

std::size_t AccessCounter::indexOf(const std::string& name) {
    const auto known = std::find_if(passes_.begin(), passes_.end(),
                                    [&](const PassAccesses& pass) { return pass.name == name; });
    const auto index = static_cast<std::size_t>(known - passes_.begin());
    if (known == passes_.end()) passes_.emplace_back().name = name;
    return index;
}

std::vector<PassAccesses> AccessCounter::take() {
    lastEnded_.reset();
    return std::exchange(passes_, {});
}

void AccessCounter::addBarrier() {
    ++here_.barriers;
}

// After the pass that ends a loop. In a later round that is not the last one that passes_ has.
void AccessCounter::addReadBack() {
    if (lastEnded_) ++passes_[*lastEnded_].readBacks;
}

Program& AccessCounter::program(const ProgramKey& key) {
    auto known = counting_.find(key);
    if (known == counting_.end()) {
        const BlockLayout layout = layoutOf(programs_.get(key).id());
        std::vector<std::string> names;
        Program program(key, programs_.folders(),
                        [&](const std::string& file, const std::string& text) {
                            return countingText(text, stageOf(file), layout, names);
                        });
        known = counting_.emplace(key, Counting{std::move(program), std::move(names)}).first;
    }
    current_ = &known->second;
    shapes_.assign(kCountedNumbers, glm::uvec4(0));
    firsts_.assign(kCountedNumbers, kNoWords);
    targetLayer_ = 0;
    blends_ = false;
    return current_->program;
}

AccessCounter::Used& AccessCounter::use(const std::string& name, Key key) {
    const auto known = used_.find(key);
    if (known != used_.end()) return known->second;
    Used used{};
    used.name = name;
    if (key.first) {
        const TextureShape shape = shapeOf(key.second);
        used.elements = std::uint64_t{shape.size.x} * shape.size.y * shape.size.z;
        used.bytesPerElement = shape.bytesPerTexel;
        used.shape = glm::uvec4(shape.size, shape.bytesPerTexel);
    } else {
        const std::uint64_t bytes = bytesOfBuffer(key.second);
        used.bytesPerElement = kCountedPiece;
        used.elements = (bytes + kCountedPiece - 1) / kCountedPiece;
        used.shape = glm::uvec4(static_cast<unsigned>(bytes), 0, 0, 0);
    }
    // What lies across the end of a word ends there.
    const std::size_t words = (used.elements + 31) / 32;
    used.firstWord =
        glm::uvec2(static_cast<unsigned>(usedWords_), static_cast<unsigned>(usedWords_ + words));
    usedWords_ += 2 * words;
    reserve(usedWords_);
    return used_.emplace(key, std::move(used)).first->second;
}

void AccessCounter::number(std::size_t number, const Used& used) {
    shapes_[number] = used.shape;
    firsts_[number] = used.firstWord;
}

void AccessCounter::bindTexture(const std::string& name, GLuint texture) {
    const auto& names = current_->names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end())
        number(static_cast<std::size_t>(at - names.begin()), use(name, {true, texture}));
}

void AccessCounter::bindBuffer(const std::string& block, GLuint buffer) {
    const auto& names = current_->names;
    const auto at = std::find(names.begin(), names.end(), block);
    if (at != names.end())
        number(static_cast<std::size_t>(at - names.begin()), use(block, {false, buffer}));
}

void AccessCounter::bindTexels(const std::string& name, GLuint buffer, GLuint texture) {
    const auto& names = current_->names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) return;
    const auto index = static_cast<std::size_t>(at - names.begin());
    number(index, use(name, {false, buffer}));
    shapes_[index].y = shapeOf(texture).bytesPerTexel;
}

void AccessCounter::bindTargets(const std::vector<GLuint>& colors, GLuint depth, int layer,
                                bool blends) {
    for (std::size_t i = 0; i < colors.size(); ++i)
        number(kCountedTargets + i, use("target " + std::to_string(i), {true, colors[i]}));
    if (depth != 0) number(kCountedDepth, use("depth", {true, depth}));
    targetLayer_ = layer;
    blends_ = blends;
}

void AccessCounter::bindVertices(std::uint64_t indexBytes) {
    GLint buffer = 0;
    GLint stride = 0;
    glGetIntegeri_v(GL_VERTEX_BINDING_BUFFER, 0, &buffer);
    glGetIntegeri_v(GL_VERTEX_BINDING_STRIDE, 0, &stride);
    Used& vertices = use("vertices", {false, static_cast<GLuint>(buffer)});
    number(kCountedVertices, vertices);
    shapes_[kCountedVertices].y = static_cast<unsigned>(stride);
    here_.readBytes += indexBytes;
    here_.requestedReadBytes += indexBytes;
}

void AccessCounter::apply(GLuint unit) {
    const GLuint id = current_->program.id();
    const auto location = [&](const char* name) { return glGetUniformLocation(id, name); };
    if (const GLint at = location("countedShape"); at >= 0)
        glProgramUniform4uiv(id, at, kCountedNumbers, &shapes_.front().x);
    if (const GLint at = location("countedFirst"); at >= 0)
        glProgramUniform2uiv(id, at, kCountedNumbers, &firsts_.front().x);
    if (const GLint at = location("countedTargetLayer"); at >= 0)
        glProgramUniform1i(id, at, targetLayer_);
    if (const GLint at = location("countedTargetUse"); at >= 0)
        glProgramUniform1i(id, at, blends_ ? 3 : 2);
    const GLuint block = glGetProgramResourceIndex(id, GL_SHADER_STORAGE_BLOCK, "CountedAccesses");
    if (block == GL_INVALID_INDEX) return;
    glShaderStorageBlockBinding(id, block, unit);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, unit, buffer_.id());
}

void AccessCounter::addWholeTexture(const std::string& name, GLuint texture) {
    use(name, {true, texture}).isWrittenWhole = true;
}

// Its bits, rounded out to whole words.
void AccessCounter::addLayer(const std::string& name, GLuint texture, int layer) {
    const Used& used = use(name, {true, texture});
    const std::uint64_t texels = std::uint64_t{used.shape.x} * used.shape.y;
    const std::uint64_t first = texels * static_cast<std::uint64_t>(layer) / 32;
    const std::uint64_t end = (texels * (static_cast<std::uint64_t>(layer) + 1) + 31) / 32;
    const GLuint ones = ~0U;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferSubData(
        buffer_.id(), GL_R32UI,
        static_cast<GLintptr>((kTotalWords + used.firstWord.y + first) * sizeof(GLuint)),
        static_cast<GLsizeiptr>((end - first) * sizeof(GLuint)), GL_RED_INTEGER, GL_UNSIGNED_INT,
        &ones);
}

void AccessCounter::addWholeBuffer(const std::string& name, GLuint buffer) {
    use(name, {false, buffer}).isWrittenWhole = true;
}

}  // namespace kaustik::gl
