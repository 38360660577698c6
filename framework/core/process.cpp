// SPDX-License-Identifier: MIT
#include "framework/core/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace kaustik {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

// All memory that starting takes: after a fork nothing but system calls is safe.
struct Prepared {
    explicit Prepared(const ProcessPlan& of)
        : plan(of),
          program(of.program.string()),
          folder(of.folder.string()),
          words(of.words),
          environment(of.environment ? *of.environment : processEnvironment()),
          wordPointers(pointersTo(words)),
          environmentPointers(pointersTo(environment)) {}
    const ProcessPlan& plan;
    std::string program;
    std::string folder;
    std::vector<std::string> words;
    std::vector<std::string> environment;
    std::vector<char*> wordPointers;
    std::vector<char*> environmentPointers;
};

bool setStandard(const std::array<int, 3>& wanted) {
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int target = 0; target < 3; ++target) {
        int source = wanted[static_cast<std::size_t>(target)];
        if (source == kSharedDescriptor) continue;
        if (source == kNoDescriptor) source = nowhere;
        if (source == target ? ::fcntl(target, F_SETFD, 0) != 0 : ::dup2(source, target) != target)
            return false;
    }
    return true;
}

void useDefaultSignals() {
    for (int signal = 1; signal < NSIG; ++signal)
        ::signal(signal, SIG_DFL);  // fails for those that cannot be handled
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

// In the child. Returns only where it fails.
void execProgram(const Prepared& prepared, pid_t parent, int problems) {
    const ProcessPlan& plan = prepared.plan;
    if (plan.hasOwnGroup) ::setpgid(0, 0);
    if (plan.signalWithParent != 0) {
        ::prctl(PR_SET_PDEATHSIG, plan.signalWithParent);
        if (::getppid() != parent) ::_exit(1);
    }
    if (plan.hasDefaultSignals) useDefaultSignals();
    if (!prepared.folder.empty() && ::chdir(prepared.folder.c_str()) != 0) return;
    if (plan.maxFileBytes) {
        const rlimit limit{*plan.maxFileBytes, *plan.maxFileBytes};
        if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return;
    }
    if (!setStandard(plan.standard)) return;
    if (plan.inherited && ::fcntl(*plan.inherited, F_SETFD, 0) != 0) return;
    if (plan.closesOthers) {
        // What tells the parent of a failure has to stay, and is closed by the program's start.
        const int kept = STDERR_FILENO + 1;
        if (problems != kept && ::dup3(problems, kept, O_CLOEXEC) != kept) return;
        ::closefrom(kept + 1);
    }
    char* const* const words = prepared.wordPointers.data();
    char* const* const environment = prepared.environmentPointers.data();
    if (prepared.program.find('/') == std::string::npos) {
        ::execvpe(prepared.program.c_str(), words, environment);
    } else {
        ::execve(prepared.program.c_str(), words, environment);
    }
}

}  // namespace

std::vector<std::string> processEnvironment() {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
        variables.emplace_back(*variable);
    return variables;
}

Process::~Process() {
    if (!hasStarted()) return;
    send(SIGKILL);
    static_cast<void>(wait());
}

int Process::start(const ProcessPlan& plan) {
    const Prepared prepared(plan);
    std::array<int, 2> ends{};  // a pipe that the child says through why it fails
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return errno;
    const pid_t parent = ::getpid();
    id_ = ::fork();
    int problem = id_ < 0 ? errno : 0;
    if (id_ == 0) {
        execProgram(prepared, parent, ends[1]);
        problem = errno;
        const int kept = plan.closesOthers ? STDERR_FILENO + 1 : ends[1];
        static_cast<void>(!::write(kept, &problem, sizeof(problem)));
        ::_exit(127);
    }
    ::close(ends[1]);
    if (problem == 0) {
        ssize_t count = 0;
        do {
            count = ::read(ends[0], &problem, sizeof(problem));
        } while (count < 0 && errno == EINTR);
        if (count == 0) problem = 0;
        if (problem != 0) static_cast<void>(wait());
    }
    ::close(ends[0]);
    return problem;
}

void Process::send(int signal) const {
    ::kill(id_, signal);
}

std::optional<ProcessEnd> Process::endWithin(std::chrono::milliseconds time) const {
    const Clock::time_point end = Clock::now() + time;
    // By its number: glibc 2.36 declares its wrapper for C alone.
    const int handle = static_cast<int>(::syscall(SYS_pidfd_open, id_, 0));
    pollfd ended{handle, POLLIN, 0};
    std::chrono::milliseconds left = time;
    while (::poll(&ended, 1, static_cast<int>(left.count())) < 0 && errno == EINTR) {
        left = std::max(std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()),
                        std::chrono::milliseconds(0));
    }
    ::close(handle);
    siginfo_t found{};
    ::waitid(P_PID, static_cast<id_t>(id_), &found, WEXITED | WNOHANG | WNOWAIT);
    if (found.si_pid != id_) return std::nullopt;
    if (found.si_code == CLD_EXITED) return ProcessEnd{found.si_status, 0};
    return ProcessEnd{-1, found.si_status};
}

ProcessEnd Process::wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    if (WIFEXITED(status)) return {WEXITSTATUS(status), 0};
    return {-1, WTERMSIG(status)};
}

}  // namespace kaustik
