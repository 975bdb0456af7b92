#pragma once

#include <signal.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "terminal/console.h"

namespace bdpt::app {

/// Turns SIGINT, SIGTERM and SIGHUP into a stop request during its lifetime: the first one requests
/// a stop if that is allowed; any other removes the temporary files and ends the process with 128 +
/// the signal's number. SIGTERM and SIGHUP wait for a stop that one of them requested, as
/// schedulers and closing terminals send them twice; but not where the process waits, or may have
/// to wait, for somebody to read what it writes. SIGUSR1 requests a checkpoint, and does nothing if
/// there are none. Create it before any other thread, so that threads inherit the blocked signals.
class SignalInterrupt final : public Interrupt {
public:
    /// `on_stop` is called on another thread when a stop is requested. It may wait for a reader.
    SignalInterrupt(PendingOutputs outputs, std::function<void()> on_stop);
    ~SignalInterrupt() override;

    void set_outputs(PendingOutputs outputs) override;
    void allow_stop() override;
    void forbid_stop() override;
    [[nodiscard]] std::stop_token stop_token() const override { return stop_.get_token(); }
    /// Returns "SIGINT", "SIGTERM" or "SIGHUP".
    [[nodiscard]] std::optional<std::string> stopped_by() const override;
    [[nodiscard]] bool take_checkpoint_request() override { return checkpoint_.exchange(false); }
    /// Returns the signal that requested the stop.
    [[nodiscard]] std::optional<int> signal() const;

private:
    void watch(const std::stop_token& finished);
    void handle(int signal_number);

    std::mutex mutex_;
    PendingOutputs outputs_;  // guarded by the mutex, as the next two
    bool stop_allowed_ = false;
    std::jthread announcer_;  // calls on_stop_
    std::function<void()> on_stop_;
    sigset_t signals_{};
    sigset_t previous_{};
    std::stop_source stop_;
    std::atomic<int> signal_{0};
    std::atomic<bool> checkpoint_{false};
    std::jthread watcher_;  // last: uses all of the above
};

/// Returns "SIGINT", "SIGTERM" or "SIGHUP".
[[nodiscard]] const char* signal_name(int signal_number);

}  // namespace bdpt::app
