// SPDX-License-Identifier: MIT
#include "framework/gui/priority.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>

namespace kaustik::gui {
namespace {

std::atomic<bool>& isKept() {
    static std::atomic<bool> kept = false;
    return kept;
}

}  // namespace

void lowerPriority(int niceness) {
    if (isKept()) return;
    static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness));
}

void keepPriority() {
    isKept() = true;
}

}  // namespace kaustik::gui
