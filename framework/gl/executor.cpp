// SPDX-License-Identifier: MIT
#include "framework/gl/executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "framework/core/error.h"
#include "framework/gl/access_counter.h"

namespace kaustik::gl {
namespace {

// Ends with the pass, whatever that throws.
class DebugGroup {
  public:
    DebugGroup(std::size_t number, const std::string& name) {
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, static_cast<GLuint>(number),
                         static_cast<GLsizei>(name.size()), name.c_str());
    }
    ~DebugGroup() { glPopDebugGroup(); }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

// Whose the memory is: "layers 1200 MiB, photons 800 MiB, …", the largest first. A slot counts for
// what lives in it first.
std::string largestShares(const graph::Compiled& compiled) {
    std::map<std::string, std::size_t> bytesOf;
    for (const graph::Slot& slot : compiled.slots)
        bytesOf[slot.firstName.substr(0, slot.firstName.find('.'))] += graph::bytesOf(slot.desc);
    std::vector<std::pair<std::size_t, std::string>> shares;
    for (const auto& [name, bytes] : bytesOf)
        shares.emplace_back(bytes, name);
    std::sort(shares.rbegin(), shares.rend());
    constexpr std::size_t kNamed = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(shares.size(), kNamed); ++i) {
        text += (i > 0 ? ", " : "") + shares[i].second + " " +
                std::to_string(shares[i].first >> 20) + " MiB";
    }
    return text + (shares.size() > kNamed ? ", …" : "");
}

// Of a frame's loops: far beyond what any needs.
constexpr std::size_t kMaxRounds = 1U << 20U;

// A buffer is one storage block of the shaders that it is bound to.
void requireBlock(const graph::Slot& slot, long long allowedBytes) {
    const std::size_t bytes = graph::bytesOf(slot.desc);
    if (bytes <= static_cast<std::size_t>(allowedBytes)) return;
    throw ConfigError(fmt::format(
        "The buffer '{}' would be {:.1f} MiB in one storage block, and this device allows {:.1f}.",
        slot.firstName, static_cast<double>(bytes) / 1048576.0,
        static_cast<double>(allowedBytes) / 1048576.0));
}

}  // namespace

Command PassContext::fullscreen(const std::string& fragmentShader) {
    return {*this, {fragmentShader}};
}

Command PassContext::compute(const std::string& computeShader) {
    return {*this, {computeShader}};
}

Command PassContext::shaders(std::vector<std::string> files) {
    return {*this, std::move(files)};
}

bool PassContext::isListing() const {
    return executor_.listed_ != nullptr;
}

bool PassContext::list(const ProgramKey& key) {
    if (!isListing()) return false;
    std::vector<UsedProgram>& listed = *executor_.listed_;
    const bool isKnown = std::any_of(listed.begin(), listed.end(),
                                     [&](const UsedProgram& used) { return used.key == key; });
    if (!isKnown) listed.push_back({key, step_.name});
    return true;
}

bool PassContext::isKept(const graph::ResourceRef& handle) const {
    return executor_.compiled_.isKept(handle);
}

const Texture& PassContext::texture(const graph::ResourceRef& handle) const {
    const Access update = access(handle, Use::updateTexture);
    order({update});
    if (AccessCounter* const counts = counter())
        counts->addWholeTexture("cleared or copied", textureOf(update).id());
    return textureOf(update);
}

const Buffer& PassContext::buffer(const graph::ResourceRef& handle, Use use) const {
    const Access used = access(handle, use);
    order({used});
    if (AccessCounter* const counts = counter(); counts != nullptr && use == Use::updateBuffer)
        counts->addWholeBuffer("cleared or copied", bufferOf(used).id());
    return bufferOf(used);
}

Access PassContext::access(const graph::ResourceRef& handle, Use use) const {
    using Kind = graph::Compiled::Kind;
    const graph::Compiled& compiled = executor_.compiled_;
    const bool isTexture =
        use == Use::fetch || use == Use::image || use == Use::target || use == Use::updateTexture;
    const Kind kind = isTexture ? Kind::texture : Kind::buffer;
    const bool isStored = use == Use::image || use == Use::storage;
    return {use == Use::target ? compiled.slotToWrite(step_, handle, kind)
                               : compiled.slotToUse(step_, handle, kind),
            use, isStored && compiled.writes(step_, handle)};
}

const Texture& PassContext::textureOf(const Access& access) const {
    return executor_.slots_[access.slot].texture;
}

const Buffer& PassContext::bufferOf(const Access& access) const {
    return executor_.slots_[access.slot].buffer;
}

void PassContext::order(const std::vector<Access>& accesses) const {
    executor_.order(accesses);
}

const Globals& PassContext::globals() const {
    return executor_.globals_;
}

ProgramCache& PassContext::programs() {
    return executor_.programs_;
}

GLuint PassContext::framebuffer(const std::vector<Attachment>& attachments) {
    return executor_.framebuffer(attachments);
}

GLuint PassContext::emptyVertexArray() const {
    return executor_.emptyVertexArray_.id();
}

AccessCounter* PassContext::counter() const {
    return executor_.counter_;
}

Executor::Executor(Context& context, ProgramCache& programs)
    : context_(context), programs_(programs), emptyVertexArray_(makeVertexArray()) {
    // Depth runs from 0 to 1 everywhere, so that reversed z keeps the precision of its floats.
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_DITHER);
}

void Executor::prepare(graph::Compiled compiled) {
    const auto available = static_cast<std::size_t>(context_.info().availableBytes);
    if (available > 0 && compiled.allocatedBytes > available) {
        throw DeviceError("The graph needs " + std::to_string(compiled.allocatedBytes >> 20) +
                          " MiB (" + largestShares(compiled) + ") and the device has " +
                          std::to_string(available >> 20) +
                          " MiB. Use fewer photons, layers or pixels.");
    }
    compiled_ = std::move(compiled);
    framebuffers_.clear();
    std::vector<Physical> old = std::exchange(slots_, {});
    for (const graph::Slot& slot : compiled_.slots) {
        const std::string persistentName = slot.isPersistent ? slot.firstName : "";
        const auto kept = std::find_if(old.begin(), old.end(), [&](const Physical& p) {
            return p.desc == slot.desc && p.persistentName == persistentName;
        });
        if (kept != old.end()) {
            slots_.push_back(std::move(*kept));
            old.erase(kept);
            continue;
        }
        context_.setScope("while allocating '" + slot.firstName + "'");
        Physical physical;
        physical.desc = slot.desc;
        physical.persistentName = persistentName;
        if (const auto* texture = std::get_if<graph::TextureDesc>(&slot.desc)) {
            const DeviceInfo& info = context_.info();
            if (texture->width > info.maxTextureSize || texture->height > info.maxTextureSize ||
                texture->layers > info.maxTextureLayers) {
                throw ConfigError("The texture '" + slot.firstName + "' would be " +
                                  std::to_string(texture->width) + "x" +
                                  std::to_string(texture->height) + "x" +
                                  std::to_string(std::max(texture->layers, 1)) +
                                  " texels, more than this device allows ('kaustik check' prints "
                                  "its limits).");
            }
            physical.texture = Texture(*texture, slot.firstName);
        } else {
            requireBlock(slot, context_.info().maxStorageBlockBytes);
            physical.buffer = Buffer(graph::bytesOf(slot.desc), nullptr, slot.firstName);
        }
        if (slot.isPersistent && physical.texture.id() != 0) physical.texture.clear({0, 0, 0, 0});
        if (slot.isPersistent && physical.buffer.id() != 0) physical.buffer.clear();
        context_.check();
        slots_.push_back(std::move(physical));
    }
    // Slots that were kept have seen another graph's stores.
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    barriers_ = Barriers(slots_.size());
    isFresh_ = true;
}

const Texture& Executor::texture(const graph::ResourceRef& handle) const {
    return slots_[compiled_.slotAfterwards(handle, graph::Compiled::Kind::texture)].texture;
}

const Buffer& Executor::buffer(const graph::ResourceRef& handle) const {
    return slots_[compiled_.slotAfterwards(handle, graph::Compiled::Kind::buffer)].buffer;
}

void Executor::order(const std::vector<Access>& accesses) {
    const GLbitfield bits = barriers_.before(accesses);
    if (bits == 0) return;
    glMemoryBarrier(bits);
    if (counter_ != nullptr) counter_->addBarrier();
}

void Executor::clearSlot(std::size_t slot, const graph::ClearValue& value) {
    if (std::holds_alternative<graph::TextureDesc>(slots_[slot].desc)) {
        order({{slot, Use::updateTexture}});
        slots_[slot].texture.clear(value);
        if (counter_ != nullptr) counter_->addWholeTexture("cleared", slots_[slot].texture.id());
    } else {
        order({{slot, Use::updateBuffer}});
        slots_[slot].buffer.clear();
        if (counter_ != nullptr) counter_->addWholeBuffer("cleared", slots_[slot].buffer.id());
    }
}

void Executor::poison(const graph::Step& step, bool isRepeated) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::uint32_t ones = ~0u;
    for (const std::size_t slot : step.undefinedSlots) {
        if (isRepeated && std::count(step.carriedSlots.begin(), step.carriedSlots.end(), slot) > 0)
            continue;
        if (const auto* texture = std::get_if<graph::TextureDesc>(&slots_[slot].desc)) {
            const bool isDepth = texture->format == graph::Format::depth32f;
            clearSlot(slot, isDepth ? graph::ClearValue{} : graph::ClearValue{nan, nan, nan, nan});
        } else {
            order({{slot, Use::updateBuffer}});
            glClearNamedBufferData(slots_[slot].buffer.id(), GL_R32UI, GL_RED_INTEGER,
                                   GL_UNSIGNED_INT, &ones);
        }
    }
}

bool Executor::isLoopRepeated(const graph::Loop& loop) {
    order({{loop.slot, Use::updateBuffer}});
    if (counter_ != nullptr) counter_->addReadBack();
    std::uint32_t word = 0;
    glGetNamedBufferSubData(slots_[loop.slot].buffer.id(),
                            static_cast<GLintptr>(loop.word * sizeof(word)), sizeof(word), &word);
    return word != 0;
}

// In a graph's first frame the last of as many runs as in the frame before is not taken on trust:
// so there is none in vain where little changes, and where a loop has become shorter it is found a
// run a frame. The frames that follow have the same input.
const graph::Loop* Executor::repeatedLoop(std::size_t step, std::vector<LoopRuns>& runs) {
    for (std::size_t i = 0; i < compiled_.loops.size(); ++i) {
        const graph::Loop& loop = compiled_.loops[i];
        if (loop.last != step) continue;
        ++runs[i].current;
        std::size_t before = 0;  // how often it ran here in the last frame
        if (loop.mayRunIdle && loopRuns_.size() == runs.size()) {
            const std::vector<std::size_t>& finished = loopRuns_[i].finished;
            if (runs[i].finished.size() < finished.size())
                before = finished[runs[i].finished.size()];
        }
        if (trustsLoops_ && before > 0) {
            if (runs[i].current < before) return &loop;
            order({{loop.slot, Use::updateBuffer}});
            loopWords_.copy(slots_[loop.slot].buffer, loop.word);
        } else if (runs[i].current + 1 < before || isLoopRepeated(loop)) {
            return &loop;
        }
        runs[i].finished.push_back(runs[i].current);
        runs[i].current = 0;
    }
    return nullptr;
}

bool Executor::runFrame(PassTimer& timer, const std::function<bool(std::size_t)>& shouldContinue) {
    const bool debugs = context_.info().debugs;
    const std::size_t count = compiled_.steps.size();
    timer.beginFrame(count);
    context_.setScope("in a frame");
    noteCutShort(false);
    trustsLoops_ = !isFresh_ && !std::exchange(waitsNext_, false);
    std::vector<bool> hasRun(count, false);
    std::vector<bool> isDone(count, false);  // since a loop has come round that it depends on
    std::size_t rounds = 0;
    std::vector<LoopRuns> loopRuns(compiled_.loops.size());
    for (std::size_t i = 0; i < count;) {
        const graph::Step& step = compiled_.steps[i];
        if (shouldContinue && !shouldContinue(i))
            return false;  // the timer begins this frame again
        if (!isDone[i]) {
            if (debugs) context_.setScope("in pass '" + step.name + "'");
            PassContext context(*this, step, hasRun[i]);
            const DebugGroup group(i, step.name);
            // What is cleared for the pass counts as its own.
            if (counter_ != nullptr) counter_->beginPass(step.name);
            if (isFresh_ && !hasRun[i]) {
                for (const std::size_t slot : step.keptSlots)
                    clearSlot(slot, {});
            }
            if (poison_) poison(step, hasRun[i]);
            timer.beginPass(i);
            for (const graph::Step::Clear& clear : step.clears)
                clearSlot(clear.slot, clear.value);
            if (step.execute) step.execute(context);
            timer.endPass(i);
            if (counter_ != nullptr) counter_->endPass();
            if (debugs) context_.check();
            hasRun[i] = true;
            isDone[i] = true;
        }
        std::size_t next = i + 1;
        if (const graph::Loop* const loop = repeatedLoop(i, loopRuns)) {
            if (++rounds > kMaxRounds)
                throw GraphError("A loop around pass '" + step.name +
                                 "' does not come to its end.");
            for (std::size_t s = loop->first; s <= loop->last; ++s)
                isDone[s] = loop->invariant.contains(s);
            next = loop->first;
        }
        i = next;
    }
    loopWords_.endFrame();
    timer.endFrame();
    isFresh_ = false;
    loopRuns_ = std::move(loopRuns);
    context_.check();
    return true;
}

void Executor::noteCutShort(bool waits) {
    const std::size_t cutShort = loopWords_.takeCutShort(waits);
    cutShort_ += cutShort;
    waitsNext_ = waitsNext_ || cutShort > 0;
}

std::size_t Executor::takeCutShort(bool waits) {
    noteCutShort(waits);
    return std::exchange(cutShort_, 0);
}

std::vector<UsedProgram> Executor::listPrograms() {
    std::vector<UsedProgram> listed;
    const struct Listing {
        Executor& executor;
        ~Listing() { executor.listed_ = nullptr; }
    } listing{*this};
    listed_ = &listed;
    // Whatever a pass throws, a frame of it says in its own words.
    const auto list = [&](const graph::Step& step, bool isRepeated) {
        try {
            if (context_.info().debugs) context_.setScope("in pass '" + step.name + "'");
            PassContext context(*this, step, isRepeated);
            if (step.execute) step.execute(context);
        } catch (const Error&) {
        }
    };
    for (std::size_t i = 0; i < compiled_.steps.size(); ++i) {
        list(compiled_.steps[i], false);
        const bool isInLoop =
            std::any_of(compiled_.loops.begin(), compiled_.loops.end(),
                        [&](const graph::Loop& loop) { return loop.first <= i && i <= loop.last; });
        if (isInLoop) list(compiled_.steps[i], true);
    }
    // As for OpenGL's errors, where they do not come by a pass' name. A lost device has no end of
    // them.
    constexpr int kMaxErrors = 64;
    for (int i = 0; i < kMaxErrors && glGetError() != GL_NO_ERROR;)
        ++i;
    return listed;
}

GLuint Executor::framebuffer(const std::vector<Attachment>& attachments) {
    std::vector<std::tuple<GLuint, int, bool>> key;
    for (const Attachment& attachment : attachments) {
        key.emplace_back(attachment.texture->id(), attachment.layer, attachment.isDepth);
    }
    const auto known = framebuffers_.find(key);
    if (known != framebuffers_.end()) return known->second.id();

    FramebufferObject framebuffer = makeFramebuffer();
    if (attachments.empty()) {
        // Nothing is drawn to it, but it has to be complete.
        glNamedFramebufferParameteri(framebuffer.id(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
        glNamedFramebufferParameteri(framebuffer.id(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    }
    std::vector<GLenum> drawBuffers;
    for (const Attachment& attachment : attachments) {
        GLenum point = GL_DEPTH_ATTACHMENT;
        if (!attachment.isDepth) {
            point = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawBuffers.size());
            drawBuffers.push_back(point);
        }
        if (attachment.texture->desc().layers > 0 && attachment.layer != Command::kAllLayers) {
            glNamedFramebufferTextureLayer(framebuffer.id(), point, attachment.texture->id(), 0,
                                           attachment.layer);
        } else {
            glNamedFramebufferTexture(framebuffer.id(), point, attachment.texture->id(), 0);
        }
    }
    glNamedFramebufferDrawBuffers(framebuffer.id(), static_cast<GLsizei>(drawBuffers.size()),
                                  drawBuffers.data());
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw DeviceError("The device cannot render into this combination of textures (status " +
                              std::to_string(status) + ").",
                          kExitFailed);
    }
    return framebuffers_.emplace(std::move(key), std::move(framebuffer)).first->second.id();
}

}  // namespace kaustik::gl
