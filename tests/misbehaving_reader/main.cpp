// SPDX-License-Identifier: MIT
// A reader that does to itself, on request, what files have made libraries do to theirs. Tests
// start it in place of kaustik_reader; the request's bytes, or the name of its file, say what it
// does.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/reading/service.h"

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0:allocator_may_return_null=1";
}
#endif

namespace {

using namespace kaustik;
using reading::Answer;
using reading::Channel;
using reading::Request;

// Too much for the compiler to see through.
volatile int gEndless = 1;

int recurse(int depth) {
    volatile char frame[4096];
    frame[0] = static_cast<char>(depth);
    return gEndless != 0 ? recurse(depth + 1) + frame[0] : depth;
}

[[noreturn]] void exhaustMemory() {
    static std::vector<std::vector<char>> eaten;
    for (;;)
        eaten.emplace_back(std::size_t{1} << 20, 'x');
}

// As a library that takes running out of memory for a property of the file.
std::string exhaustMemoryAndCatch() {
    try {
        exhaustMemory();
    } catch (const std::bad_alloc&) {
        throw IoError("the file is of no known kind.");
    }
}

void handle(const Request& request, Channel& channel) {
    const std::string wanted = request.bytes.empty() ? request.file.stem().string() : request.bytes;
    const std::string well = "read " + wanted;
    if (wanted == "crash") *reinterpret_cast<volatile int*>(std::size_t(gEndless)) = 1;
    if (wanted == "abort") std::abort();
    if (wanted == "overflow") recurse(0);
    if (wanted == "exit") ::_exit(0);
    if (wanted == "throw") throw std::out_of_range("no library expects this");
    if (wanted == "hang") {
        while (gEndless != 0) {
        }
    }
    if (wanted == "wait") {
        for (;;)
            ::pause();
    }
    if (wanted == "half") {
        put(channel, Answer::done);
        put(channel, std::uint64_t{1000});
        channel.send("only this", 9);
        channel.flush();
        std::abort();
    }
    if (wanted == "lie") {
        put(channel, Answer::done);
        put(channel, UINT64_MAX / 2);
        const std::string piece(std::size_t{1} << 20, 'x');
        for (;;)
            channel.send(piece.data(), piece.size());
    }
    if (wanted == "print") {
        std::cout << "to standard output" << std::endl;
        std::fputs("to standard error\n", stderr);
    }
    answer(channel, [&]() -> std::string {
        if (wanted == "memory") exhaustMemory();
        if (wanted == "catch") return exhaustMemoryAndCatch();
        if (wanted == "refuse") throw ConfigError(request.name + ":3: no such thing.");
        if (wanted == "damaged") throw IoError(request.name + " is cut off.");
        return well;
    });
    if (wanted == "leave") {
        channel.flush();
        ::_exit(reading::kExitNoClient);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return reading::serve(argc, argv, handle);
}
