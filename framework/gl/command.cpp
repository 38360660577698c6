// SPDX-License-Identifier: MIT
#include "framework/gl/command.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/gl/executor.h"

namespace kaustik::gl {
namespace {

std::string shaderName(std::string scopedName) {
    std::replace(scopedName.begin(), scopedName.end(), '.', '_');
    return scopedName;
}

}  // namespace

Command::Command(PassContext& context, std::vector<std::string> files) : context_(context) {
    key_.files = std::move(files);
    offers_ = true;
    const Globals& globals = context.globals();
    for (const auto& [name, buffer] : globals.uniforms)
        uniforms(name, *buffer);
    for (const auto& [name, buffer] : globals.storage)
        storage(name, *buffer);
    for (const auto& [name, texture] : globals.textures)
        this->texture(name, *texture);
    for (const auto& [name, value] : globals.values)
        set(name, value);
    for (const std::string& name : globals.defines)
        define(name);
    for (const graph::Binding& binding : context.bindings()) {
        switch (binding.as) {
            case graph::BindAs::sampler:
                texture(binding.name, binding.handle);
                break;
            case graph::BindAs::image:
                image(binding.name, binding.handle);
                break;
            case graph::BindAs::storage:
                storage(binding.name, binding.handle);
                break;
        }
    }
    offers_ = false;
    for (const std::string& name : context.defines())
        define(name);
}

const Texture& Command::textureToDrawTo(const graph::ResourceRef& handle) {
    accesses_.push_back(context_.access(handle, Use::target));
    return context_.textureOf(accesses_.back());
}

Command& Command::texture(const std::string& name, const graph::ResourceRef& handle) {
    const Access access = context_.access(handle, Use::fetch);
    textures_.push_back({name, context_.textureOf(access).id(), access, offers_});
    return *this;
}

Command& Command::texture(const std::string& name, const Texture& texture) {
    textures_.push_back({name, texture.id(), {}, offers_});
    return *this;
}

Command& Command::image(const std::string& name, const graph::ResourceRef& handle) {
    const Access access = context_.access(handle, Use::image);
    images_.push_back({name, &context_.textureOf(access), access, offers_});
    return *this;
}

Command& Command::storage(const std::string& block, const graph::ResourceRef& handle) {
    const Access access = context_.access(handle, Use::storage);
    storage_.push_back({block, context_.bufferOf(access).id(), access, offers_});
    return *this;
}

Command& Command::storage(const std::string& block, const Buffer& buffer) {
    storage_.push_back({block, buffer.id(), {}, offers_});
    return *this;
}

Command& Command::texels(const std::string& name, const graph::ResourceRef& handle,
                         graph::Format format) {
    // A buffer that is fetched from as textures are.
    const Access access{context_.access(handle, Use::storage).slot, Use::fetch};
    const Buffer& buffer = context_.bufferOf(access);
    textures_.push_back({name, buffer.texels(format), access, offers_, buffer.id()});
    return *this;
}

Command& Command::texels(const std::string& name, const Buffer& buffer, graph::Format format) {
    textures_.push_back({name, buffer.texels(format), {}, offers_, buffer.id()});
    return *this;
}

Command& Command::offer(const std::string& block, const Buffer& buffer) {
    uniformBlocks_.push_back({block, buffer.id(), {}, true});
    return *this;
}

Command& Command::offer(const std::string& name, Value value) {
    offers_ = true;
    set(name, std::move(value));
    offers_ = false;
    return *this;
}

Command& Command::uniforms(const std::string& block, const Buffer& buffer) {
    uniformBlocks_.push_back({block, buffer.id(), {}, offers_});
    return *this;
}

Command& Command::set(const std::string& name, Value value) {
    // A command that draws more than once may set a value anew each time.
    for (Uniform& uniform : uniforms_) {
        if (uniform.name != name) continue;
        uniform.value = value;
        uniform.isOffered = offers_;
        return *this;
    }
    uniforms_.push_back({name, value, offers_});
    return *this;
}

Command& Command::fields(const std::string& scope, const std::vector<params::Field>& fields) {
    for (const params::Field& field : fields) {
        const std::string name = shaderName(scope + "." + field.name);
        const std::string declared = [&] {
            struct TypeName {
                const char* operator()(const bool*) const { return "bool"; }
                const char* operator()(const int*) const { return "int"; }
                const char* operator()(const float*) const { return "float"; }
                const char* operator()(const params::Extent*) const { return "ivec2"; }
                const char* operator()(params::ChoiceRef) const { return "int"; }
            };
            return fmt::format("uniform {} {};\n", std::visit(TypeName{}, field.target), name);
        }();
        key_.declarations += declared;
        for (std::size_t i = 0; i < field.choices.size(); ++i) {
            key_.declarations +=
                fmt::format("const int {}_{} = {};\n", name, shaderName(field.choices[i]), i);
        }
        struct ToValue {
            Value operator()(const bool* v) const { return *v ? 1 : 0; }
            Value operator()(const int* v) const { return *v; }
            Value operator()(const float* v) const { return *v; }
            Value operator()(const params::Extent* v) const {
                return glm::ivec2(v->width, v->height);
            }
            Value operator()(params::ChoiceRef v) const { return *v.index; }
        };
        uniforms_.push_back({name, std::visit(ToValue{}, field.target)});
    }
    return *this;
}

Command& Command::define(const std::string& name) {
    key_.declarations += "#define " + name + "\n";
    return *this;
}

Command& Command::target(const graph::ResourceRef& handle, int layer) {
    targets_.push_back({&textureToDrawTo(handle), layer, false, {}});
    lastIsDepth_ = false;
    return *this;
}

Command& Command::depth(const graph::ResourceRef& handle, DepthTest test, int layer) {
    depth_ = {&textureToDrawTo(handle), layer, false, {}};
    depthTest_ = test;
    lastIsDepth_ = true;
    return *this;
}

Command& Command::clear(graph::ClearValue value) {
    if (!lastIsDepth_ && targets_.empty()) {
        throw GraphError(
            fmt::format("Pass '{}' clears before it has named what: target() or "
                        "depth() comes first.",
                        context_.passName()));
    }
    Target& last = lastIsDepth_ ? depth_ : targets_.back();
    last.clear = true;
    last.value = value;
    return *this;
}

Command& Command::blend(Blend blend) {
    blend_ = blend;
    return *this;
}

Command& Command::viewport(int x, int y, int width, int height) {
    viewport_ = {x, y, width, height};
    return *this;
}

Command& Command::scissor(glm::ivec2 first, glm::ivec2 end) {
    scissor_ = glm::ivec4(first, end - first);
    return *this;
}

Command& Command::bounds(glm::ivec2 first, glm::ivec2 end) {
    clearsInScissor_ = true;
    return scissor(first, end);
}

}  // namespace kaustik::gl
