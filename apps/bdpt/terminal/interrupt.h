#pragma once

#include <signal.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace bdpt::app {

/// Asks a render to stop.
class Interrupt {
public:
    Interrupt() = default;
    virtual ~Interrupt() = default;
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    /// Replaces the files that are removed if the process ends early.
    virtual void set_temporaries(std::vector<std::filesystem::path> temporaries) = 0;
    /// Allows stops: from now on there is a result worth finishing.
    virtual void allow_stop() = 0;
    [[nodiscard]] virtual std::stop_token stop_token() const = 0;
    /// Returns what requested the stop, such as "SIGINT"; none if nothing did.
    [[nodiscard]] virtual std::optional<std::string> stopped_by() const = 0;
    /// Returns whether a checkpoint was requested since the last call.
    [[nodiscard]] virtual bool take_checkpoint_request() = 0;
};

/// Turns SIGINT, SIGTERM and SIGHUP into a stop request during its lifetime: the first one requests
/// a stop if `allow_stop()` was called; any other removes `temporaries` and ends the process with
/// 128 + the signal's number. Only SIGTERM and SIGHUP wait for a stop that one of them requested,
/// as schedulers and closing terminals send them twice. SIGUSR1 requests a checkpoint, and does
/// nothing if there are none. Create it before any other thread, so that threads inherit the
/// blocked signals.
class SignalInterrupt final : public Interrupt {
public:
    /// `on_stop` is called on another thread when a stop is requested.
    SignalInterrupt(std::vector<std::filesystem::path> temporaries, std::function<void()> on_stop);
    ~SignalInterrupt() override;

    void set_temporaries(std::vector<std::filesystem::path> temporaries) override;
    void allow_stop() override { stop_allowed_ = true; }
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
    std::vector<std::filesystem::path> temporaries_;  // guarded by the mutex
    std::function<void()> on_stop_;
    sigset_t signals_{};
    sigset_t previous_{};
    std::stop_source stop_;
    std::atomic<bool> stop_allowed_{false};
    std::atomic<int> signal_{0};
    std::atomic<bool> checkpoint_{false};
    std::jthread watcher_;  // last: uses all of the above
};

/// Returns "SIGINT", "SIGTERM" or "SIGHUP".
[[nodiscard]] const char* signal_name(int signal_number);

}  // namespace bdpt::app
