#include "terminal/console.h"

#include <poll.h>
#include <unistd.h>

#include <system_error>
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

const char* signal_name(int signal_number)
{
    return signal_number == SIGTERM ? "SIGTERM" : signal_number == SIGHUP ? "SIGHUP" : "SIGINT";
}

/// Tests whether a message to this stream would have to wait for its reader.
bool is_full(int stream)
{
    pollfd state{.fd = stream, .events = POLLOUT, .revents = 0};
    return ::poll(&state, 1, 0) == 0;
}

}  // namespace

SignalInterrupt::SignalInterrupt(PendingOutputs outputs, std::function<void()> on_stop)
    : outputs_(std::move(outputs)), on_stop_(std::move(on_stop)), signals_(signals_to_watch())
{
    pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
    watcher_ = std::jthread([this](const std::stop_token& finished) { watch(finished); });
}

SignalInterrupt::~SignalInterrupt()
{
    // First, as only signals end its wait for a reader.
    std::unique_lock lock(mutex_);
    std::jthread announcer = std::move(announcer_);
    lock.unlock();
    if (announcer.joinable()) {
        announcer.join();
    }
    watcher_.request_stop();
    watcher_.join();
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

void SignalInterrupt::set_outputs(PendingOutputs outputs)
{
    const std::lock_guard lock(mutex_);
    outputs_ = std::move(outputs);
}

void SignalInterrupt::allow_stop()
{
    const std::lock_guard lock(mutex_);
    stop_allowed_ = true;
}

void SignalInterrupt::forbid_stop()
{
    const std::lock_guard lock(mutex_);
    stop_allowed_ = false;
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
    const std::lock_guard lock(mutex_);
    const bool waits_for_reader =
        outputs_.have_readers || is_full(STDOUT_FILENO) || is_full(STDERR_FILENO);
    if (signal_number != SIGINT && signal_ != 0 && signal_ != SIGINT && !waits_for_reader) {
        return;
    }
    if (stop_allowed_ && signal_ == 0) {
        signal_ = signal_number;
        stop_.request_stop();
        try {
            announcer_ = std::jthread(on_stop_);
        } catch (const std::system_error&) {  // no thread can be started
        }
        return;
    }
    for (const std::filesystem::path& temporary : outputs_.temporaries) {
        ::unlink(temporary.c_str());
    }
    ::_exit(128 + signal_number);
}

}  // namespace bdpt::app
