#include "process/limited_process.h"

#include <bdpt/error.h>

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace bdpt::io {

namespace {

void limit(decltype(RLIMIT_AS) resource, std::uint64_t most)
{
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min<rlim_t>(limits.rlim_max, most);
    setrlimit(resource, &limits);
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
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
        signal(number, SIG_IGN);
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 1U << 20U);  // maximum size of messages
    allow(allowance);
}

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
