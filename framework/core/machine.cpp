// SPDX-License-Identifier: MIT
#include "framework/core/machine.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace kaustik {

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

std::optional<ProcessorTimes> processorTimes() {
    std::ifstream file("/proc/stat");
    std::string name;
    double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, waiting = 0.0;
    double interrupts = 0.0, soft = 0.0, stolen = 0.0;
    file >> name >> user >> nice >> system >> idle >> waiting >> interrupts >> soft >> stolen;
    timespec own{};
    if (!file || name != "cpu" || ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &own) != 0) return {};
    const double ticks = user + nice + system + interrupts + soft + stolen;
    return ProcessorTimes{ticks / static_cast<double>(::sysconf(_SC_CLK_TCK)),
                          static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec),
                          std::chrono::steady_clock::now()};
}

std::optional<double> otherProcessors(const std::optional<ProcessorTimes>& begin,
                                      const std::optional<ProcessorTimes>& end) {
    if (!begin || !end) return {};
    const double seconds = std::chrono::duration<double>(end->when - begin->when).count();
    if (seconds < 0.1) return {};
    const double others =
        end->machineSeconds - begin->machineSeconds - (end->ownSeconds - begin->ownSeconds);
    return std::max(others, 0.0) / seconds;
}

}  // namespace kaustik
