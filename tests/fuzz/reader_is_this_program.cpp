// SPDX-License-Identifier: MIT
// The reader process of a fuzz target is the target's own program, started again by what starts
// kaustik_reader: the same requests, answers and limits, and what a file does to the library that
// reads it is the reader's end and an error. The fuzzer still learns what code the reader runs:
// both have a piece of memory in common, which libFuzzer counts as its own.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "framework/importers/answer_request.h"
#include "framework/reading/reader_process.h"
#include "framework/reading/service.h"

namespace {

constexpr const char* kCoverageVariable = "KAUSTIK_FUZZ_COVERAGE";
constexpr std::size_t kCoverageBytes = std::size_t{1} << 18;

}  // namespace

extern "C" {
// A counter an edge of the program, by the compiler; it is told not to do so in this file, where it
// would take the two names for itself.
extern std::uint8_t __start___sancov_cntrs[];
extern std::uint8_t __stop___sancov_cntrs[];
// libFuzzer clears it before each input, and looks at it afterwards.
__attribute__((section("__libfuzzer_extra_counters"), used, aligned(4096)))
std::uint8_t gReaderCoverage[kCoverageBytes];
}

namespace kaustik::reading {
namespace {

void shareCoverage(int file) {
    if (::mmap(gReaderCoverage, kCoverageBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED,
               file, 0) == MAP_FAILED)
        std::abort();
}

void answerWithCoverage(const Request& request, Channel& channel) {
    const auto count = std::min(
        static_cast<std::size_t>(__stop___sancov_cntrs - __start___sancov_cntrs), kCoverageBytes);
    std::memset(__start___sancov_cntrs, 0, count);
    scene::answerRequest(request, channel);
    std::memcpy(gReaderCoverage, __start___sancov_cntrs, count);
}

}  // namespace

std::filesystem::path ReaderProcess::defaultProgram() {
    return "/proc/self/exe";
}

}  // namespace kaustik::reading

// libFuzzer calls it before all else.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    using namespace kaustik::reading;
    if (const char* const coverage = std::getenv(kCoverageVariable)) {
        shareCoverage(::open(coverage, O_RDWR));
        ::_exit(serve(*argc, *argv, answerWithCoverage));
    }
    const int file = ::memfd_create("coverage", MFD_CLOEXEC);
    if (::ftruncate(file, kCoverageBytes) != 0) std::abort();
    shareCoverage(file);
    const std::string name = "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(file);
    ::setenv(kCoverageVariable, name.c_str(), 1);
    return 0;
}
