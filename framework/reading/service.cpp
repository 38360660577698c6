// SPDX-License-Identifier: MIT
#include "framework/reading/service.h"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>

namespace kaustik::reading {
namespace {

// A reader whose program does something else for so long is not needed any more; the next request
// starts another.
constexpr std::chrono::seconds kAnswerTimeout{10};

void setLimit(decltype(RLIMIT_AS) resource, rlim_t soft) {
    rlimit limit{};
    ::getrlimit(resource, &limit);
    limit.rlim_cur = std::min(soft, limit.rlim_max);
    ::setrlimit(resource, &limit);
}

// Memory is taken in large steps and given back after the request: page by page it would cost as
// much time as the process itself.
void keepMemory() {
    constexpr int kMebibyte = 1 << 20;
    ::mallopt(M_TOP_PAD, 64 * kMebibyte);
    ::mallopt(M_TRIM_THRESHOLD, 1024 * kMebibyte);
    ::mallopt(M_MMAP_THRESHOLD, 32 * kMebibyte);  // the most that glibc takes
    // An arena a thread would take 64 MiB of address space each.
    ::mallopt(M_ARENA_MAX, 1);
}

// Each request has all of the time.
void allowSeconds(rlim_t seconds) {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto soFar = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
    setLimit(RLIMIT_CPU, soFar + seconds + 1);
}

void limitMemory([[maybe_unused]] rlim_t mebibytes) {
#ifndef __SANITIZE_ADDRESS__
    setLimit(RLIMIT_AS, mebibytes << 20);
#endif
    // At once: a library that catches it would go on with half of the file, or say something else.
    std::set_new_handler([] { ::_exit(kExitOutOfMemory); });
}

bool isSocket(int file) {
    struct stat status {};
    return ::fstat(file, &status) == 0 && S_ISSOCK(status.st_mode);
}

}  // namespace

int serve(int argc, const char* const* argv,
          const std::function<void(const Request&, Channel&)>& handle) {
    if (argc != 3 || !isSocket(STDIN_FILENO)) {
        std::fputs("kaustik_reader: reads files for kaustik, which starts it.\n", stderr);
        return kExitStartedByHand;
    }
    setLimit(RLIMIT_CORE, 0);
    keepMemory();
    limitMemory(std::strtoull(argv[2], nullptr, 10));
    const rlim_t seconds = std::strtoull(argv[1], nullptr, 10);
    Channel channel(STDIN_FILENO);
    try {
        for (;;) {
            channel.limit(Channel::Clock::now() + kAnswerTimeout, UINT64_MAX);
            if (!channel.waitForBytes()) return kExitNoClient;
            channel.limit(std::nullopt, UINT64_MAX);
            allowSeconds(seconds);
            Request request;
            take(channel, request);
            handle(request, channel);
            channel.flush();
            ::malloc_trim(0);
        }
    } catch (const ChannelEnd&) {
        return kExitNoClient;  // in the middle of a request
    }
}

}  // namespace kaustik::reading
