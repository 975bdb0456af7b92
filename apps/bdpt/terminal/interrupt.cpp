#include "terminal/interrupt.h"

#include <unistd.h>

#include <ctime>
#include <utility>

namespace bdpt::app {
namespace {

/// Returns the handled signals, except those that the parent process had ignored (as nohup and
/// background jobs do).
sigset_t signals_to_watch()
{
    sigset_t result;
    sigemptyset(&result);
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
        struct sigaction action {};
        sigaction(signal_number, nullptr, &action);
        if (action.sa_handler != SIG_IGN) {
            sigaddset(&result, signal_number);
        }
    }
    return result;
}

}  // namespace

SignalInterrupt::SignalInterrupt(std::vector<std::filesystem::path> temporaries,
                                 std::function<void()> on_stop)
    : temporaries_(std::move(temporaries)),
      on_stop_(std::move(on_stop)),
      signals_(signals_to_watch())
{
    pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
    watcher_ = std::jthread([this](const std::stop_token& finished) { watch(finished); });
}

SignalInterrupt::~SignalInterrupt()
{
    watcher_.request_stop();
    watcher_.join();
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

void SignalInterrupt::set_temporaries(std::vector<std::filesystem::path> temporaries)
{
    const std::lock_guard lock(mutex_);
    temporaries_ = std::move(temporaries);
}

std::optional<int> SignalInterrupt::signal() const
{
    const int signal_number = signal_;
    return signal_number != 0 ? std::optional(signal_number) : std::nullopt;
}

std::optional<std::string> SignalInterrupt::stopped_by() const
{
    const std::optional<int> by = signal();
    return by ? std::optional<std::string>(signal_name(*by)) : std::nullopt;
}

void SignalInterrupt::watch(const std::stop_token& finished)
{
    // Long enough to cost nothing, short enough that joining the thread is quick.
    constexpr timespec interval{0, 20'000'000};
    while (!finished.stop_requested()) {
        const int signal_number = sigtimedwait(&signals_, nullptr, &interval);
        if (signal_number > 0) {
            handle(signal_number);
        }
    }
}

void SignalInterrupt::handle(int signal_number)
{
    if (signal_number == SIGUSR1) {
        checkpoint_ = true;
        return;
    }
    if (signal_number != SIGINT && signal_ != 0 && signal_ != SIGINT) {
        return;
    }
    if (stop_allowed_ && signal_ == 0) {
        signal_ = signal_number;
        stop_.request_stop();
        on_stop_();
        return;
    }
    const std::lock_guard lock(mutex_);
    for (const std::filesystem::path& temporary : temporaries_) {
        ::unlink(temporary.c_str());
    }
    ::_exit(128 + signal_number);
}

const char* signal_name(int signal_number)
{
    return signal_number == SIGTERM ? "SIGTERM" : signal_number == SIGHUP ? "SIGHUP" : "SIGINT";
}

}  // namespace bdpt::app
