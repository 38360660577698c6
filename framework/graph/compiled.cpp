// SPDX-License-Identifier: MIT
// What a compiled graph tells those who execute and read it: the memory behind a handle, and that a
// pass uses only what it has declared. What it has not declared may be another's memory by then.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/core/error.h"
#include "framework/graph/graph.h"

namespace kaustik::graph {
namespace {

constexpr std::size_t kNoSlot = std::numeric_limits<std::size_t>::max();

bool contains(const std::vector<ResourceRef>& handles, const ResourceRef& handle) {
    return std::find(handles.begin(), handles.end(), handle) != handles.end();
}

}  // namespace

bool Compiled::isKnown(const ResourceRef& handle) const {
    return handle.valid() && handle.index < home_.size() &&
           handle.version < home_[handle.index].size();
}

std::size_t Compiled::slotOf(const ResourceRef& handle) const {
    return isKnown(handle) ? slotOfResource[home_[handle.index][handle.version]] : kNoSlot;
}

std::size_t Compiled::slotOfKind(const ResourceRef& handle, Kind kind,
                                 const std::string& user) const {
    const std::size_t slot = slotOf(handle);
    const bool isTexture = std::holds_alternative<TextureDesc>(slots[slot].desc);
    if (isTexture != (kind == Kind::texture)) {
        throw GraphError(fmt::format("{} uses the {} '{}' as a {}.", user,
                                     isTexture ? "texture" : "buffer", names_[handle.index],
                                     isTexture ? "buffer" : "texture"));
    }
    return slot;
}

std::size_t Compiled::slotToUse(const Step& step, const ResourceRef& handle, Kind kind) const {
    if (!isKnown(handle)) {
        throw GraphError(fmt::format("Pass '{}' uses a handle that no pass has made.", step.name));
    }
    if (!contains(step.reads, handle) && !contains(step.outputs, handle)) {
        throw GraphError(fmt::format(
            "Pass '{}' uses '{}' (version {}) without having declared it; its setup must read, "
            "write or create it.",
            step.name, names_[handle.index], handle.version));
    }
    return slotOfKind(handle, kind, fmt::format("Pass '{}'", step.name));
}

std::size_t Compiled::slotToWrite(const Step& step, const ResourceRef& handle, Kind kind) const {
    const std::size_t slot = slotToUse(step, handle, kind);
    if (!writes(step, handle)) {
        throw GraphError(fmt::format(
            "Pass '{}' draws to '{}', which it has declared only to read; its setup must write or "
            "create it.",
            step.name, names_[handle.index]));
    }
    return slot;
}

bool Compiled::writes(const Step& step, const ResourceRef& handle) const {
    return std::any_of(step.outputs.begin(), step.outputs.end(),
                       [&](const ResourceRef& output) { return output.index == handle.index; });
}

bool Compiled::isKept(const ResourceRef& handle) const {
    return isKnown(handle) && isKept_[home_[handle.index][handle.version]];
}

std::size_t Compiled::slotAfterwards(const ResourceRef& handle, Kind kind) const {
    if (!isKnown(handle)) {
        throw GraphError("What is read after the frame is a handle that no pass has made.");
    }
    if (!isKept(handle)) {
        throw GraphError(fmt::format(
            "'{}' is read after the frame, but nothing has asked to keep it until then.",
            names_[handle.index]));
    }
    return slotOfKind(handle, kind, "Who reads after the frame");
}

}  // namespace kaustik::graph
