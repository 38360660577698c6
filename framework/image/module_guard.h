// SPDX-License-Identifier: MIT
// What the modules for images share behind their C boundary.
#pragma once

#include <exception>
#include <new>

#include "framework/image/module_interface.h"

namespace kaustik {

// Runs `body`: whatever it throws goes to the sink as a message.
template <class Body>
bool guarded(const KaustikImageSink* sink, Body body) noexcept {
    try {
        body();
        return true;
    } catch (const std::bad_alloc&) {
        sink->fail(sink->context, "out of memory");
    } catch (const std::exception& exception) {
        sink->fail(sink->context, exception.what());
    } catch (...) {
        sink->fail(sink->context, "it failed without a reason");
    }
    return false;
}

}  // namespace kaustik
