// SPDX-License-Identifier: MIT
#include "techniques/thread_lists/thread_list.h"

#include <algorithm>

#include "framework/gl/executor.h"

namespace kaustik {
namespace {

constexpr std::size_t kHeaderWords = sizeof(ThreadListHeader) / sizeof(std::uint32_t);

}  // namespace

ThreadList ThreadList::create(graph::PassSetup& setup, const char* block, const std::string& name,
                              std::size_t capacity) {
    ThreadList made;
    made.list_ =
        setup.storage(block, setup.createBuffer<std::uint32_t>(name, kHeaderWords + capacity));
    setup.bypass(made.list_, {0, 0, 0, 0});
    return made;
}

void ThreadList::countGroups(gl::PassContext& context, int isListed) const {
    context.compute("thread_lists/groups.comp")
        .storage("ListedThreads", list_)
        .set("isListed", isListed)
        .dispatch(1);
}

void ThreadList::clear(gl::PassContext& context) const {
    countGroups(context, 0);
}

void ThreadList::close(gl::PassContext& context) const {
    countGroups(context, 1);
}

void ThreadList::dispatchOver(gl::Command command) const {
    command.dispatchIndirect(list_, offsetof(ThreadListHeader, groupsX));
}

std::span<const std::uint32_t> ThreadList::listedIn(std::span<const std::uint32_t> buffer) {
    const std::span<const std::uint32_t> all = buffer.subspan(kHeaderWords);
    return all.first(std::min<std::size_t>(buffer[0], all.size()));
}

}  // namespace kaustik
