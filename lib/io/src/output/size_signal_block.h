#pragma once

#include <signal.h>

#include <cerrno>
#include <ctime>

namespace bdpt::io {

/// During its lifetime, a write beyond the process's limit of file sizes (ulimit -f) fails with
/// EFBIG instead of ending the process. Affects the calling thread only, so the host's handling of
/// the signal stays as it is.
class SizeSignalBlock {
public:
    SizeSignalBlock()
    {
        ::sigemptyset(&signal_);
        ::sigaddset(&signal_, SIGXFSZ);
        sigset_t pending;
        ::sigpending(&pending);
        was_pending_ = ::sigismember(&pending, SIGXFSZ) == 1;
        ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
    }
    ~SizeSignalBlock()
    {
        const timespec no_time{};
        while (!was_pending_ && ::sigtimedwait(&signal_, nullptr, &no_time) < 0 && errno == EINTR) {
        }
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    SizeSignalBlock(const SizeSignalBlock&) = delete;
    SizeSignalBlock& operator=(const SizeSignalBlock&) = delete;

private:
    sigset_t signal_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

}  // namespace bdpt::io
