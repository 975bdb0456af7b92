#include "process/reader_program.h"

#include "process/child_process.h"

#include <bdpt/error.h>

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#ifdef BDPT_HAS_SECCOMP
#include <seccomp.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>

namespace bdpt::io {

namespace {

void limit(decltype(RLIMIT_AS) resource, std::uint64_t most)
{
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min<rlim_t>(limits.rlim_max, most);
    setrlimit(resource, &limits);
}

/// Lets the kernel end this process when the thread that started it ends.
void end_with_parent()
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const char* const parent = std::getenv(parent_variable);
    if (parent != nullptr && parent != std::to_string(getppid())) {
        _exit(static_cast<int>(ErrorCode::internal));  // it ended before
    }
}

}  // namespace

void allow(const Allowance& allowance)
{
    limit(RLIMIT_CPU, allowance.seconds);
#ifndef BDPT_SANITIZED
    constexpr std::uint64_t program = std::uint64_t{256} << 20U;
    limit(RLIMIT_AS, std::min(allowance.memory, UINT64_MAX / 2) + program);
#endif
}

void limit_process(const Allowance& allowance)
{
    end_with_parent();
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
        signal(number, SIG_IGN);
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 1U << 20U);  // maximum size of messages
    allow(allowance);
}

#if defined(BDPT_HAS_SECCOMP) && !defined(BDPT_SANITIZED)
void confine(Openable files)
{
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (filter == nullptr) {
        return;
    }
    // Also for threads that libraries have started.
    seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1);
    for (const int call : {SCMP_SYS(read),          SCMP_SYS(readv),
                           SCMP_SYS(pread64),       SCMP_SYS(write),
                           SCMP_SYS(writev),        SCMP_SYS(lseek),
                           SCMP_SYS(_llseek),       SCMP_SYS(fstat),
                           SCMP_SYS(fstat64),       SCMP_SYS(newfstatat),
                           SCMP_SYS(close),         SCMP_SYS(brk),
                           SCMP_SYS(munmap),        SCMP_SYS(mremap),
                           SCMP_SYS(madvise),       SCMP_SYS(futex),
                           SCMP_SYS(rseq),          SCMP_SYS(set_robust_list),
                           SCMP_SYS(sched_yield),   SCMP_SYS(sched_getaffinity),
                           SCMP_SYS(clock_gettime), SCMP_SYS(clock_nanosleep),
                           SCMP_SYS(nanosleep),     SCMP_SYS(gettimeofday),
                           SCMP_SYS(getrandom),     SCMP_SYS(getpid),
                           SCMP_SYS(gettid),        SCMP_SYS(exit),
                           SCMP_SYS(rt_sigaction),  SCMP_SYS(rt_sigprocmask),
                           SCMP_SYS(rt_sigreturn),  SCMP_SYS(exit_group)}) {
        seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
    }
    // The first argument of each: this process, not another.
    const auto first_is = [](pid_t process) {
        return scmp_arg_cmp{.arg = 0,
                            .op = SCMP_CMP_EQ,
                            .datum_a = static_cast<scmp_datum_t>(process),
                            .datum_b = 0};
    };
    seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1, first_is(getpid()));
    seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), 1, first_is(0));
    // Libraries of OpenVDB start threads. The arguments of clone3 cannot be checked, so it is
    // missing.
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
    const scmp_arg_cmp is_thread{
        .arg = 0, .op = SCMP_CMP_MASKED_EQ, .datum_a = CLONE_THREAD, .datum_b = CLONE_THREAD};
    seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(clone), 1, is_thread);
    // The third argument of each: no memory for code, and no files to write.
    const auto third_lacks = [](scmp_datum_t bits) {
        return scmp_arg_cmp{.arg = 2, .op = SCMP_CMP_MASKED_EQ, .datum_a = bits, .datum_b = 0};
    };
    for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mmap2), SCMP_SYS(mprotect)}) {
        seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 1, third_lacks(PROT_EXEC));
    }
    if (files == Openable::to_read) {
        static_assert(O_RDONLY == 0);
        seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(openat), 1,
                         third_lacks(O_ACCMODE | O_CREAT | O_TRUNC));
        for (const int call : {SCMP_SYS(prctl), SCMP_SYS(seccomp)}) {  // for the next filter
            seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
        }
    }
    for (const int call : {SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(socket)}) {
        seccomp_rule_add(filter, SCMP_ACT_KILL_PROCESS, call, 0);
    }
    seccomp_load(filter);
    seccomp_release(filter);
}
#else
void confine(Openable /*files*/) {}
#endif

void write_output(const void* bytes, std::size_t size)
{
    const auto* next = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t count = ::write(STDOUT_FILENO, next, size);
        if (count < 0 && errno != EINTR) {
            throw Error(ErrorCode::output, "its output has no reader");
        }
        next += std::max<ssize_t>(count, 0);
        size -= static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
}

}  // namespace bdpt::io
